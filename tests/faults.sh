#!/usr/bin/env bash
# Facts about programs under external faults: full disks, too little memory, signals, closed streams, missing folders.
# Prints one line per fact. faults.sh BIN SCRATCH: exit 0 if all of them hold.
# shellcheck disable=SC2317 # fact calls the functions
set -u

# A small tmpfs, mounted in a private namespace, serves as the full disk and vanishes with this script.
if [ -z "${RAYSTEPS_OWN_MOUNTS-}" ] && unshare -m true 2>/dev/null; then
    export RAYSTEPS_OWN_MOUNTS=1
    exec unshare -m bash "$0" "$@"
fi

bin=$(cd -- "$1" >/dev/null && pwd -P) || exit 2
mkdir -p "$2" && cd -- "$2" >/dev/null || exit 2
scratch=$(mktemp -d "$(pwd -P)/faults.XXXXXX") && cd -- "$scratch" || exit 2
owner=$BASHPID # a child that receives a signal before its exec runs this trap too
trap '[ "$BASHPID" != "$owner" ] || { cd /; rm -rf "$scratch"; }' EXIT
chmod 755 "$scratch"
mkdir tmp home
export TMPDIR=$scratch/tmp HOME=$scratch/home
failed=0
begin=$SECONDS

fact() { # $1: the fact as a sentence; the rest: a command that succeeds if it holds
    local sentence=$1
    shift
    if "$@"; then
        echo "holds    $sentence"
    else
        echo "FAILED   $sentence"
        echo "         exit code ${code-none}; stdout: $(shown out); stderr: $(shown err)"
        failed=1
    fi
}

shown() { # prints the text of file $1 on one line
    head -c 600 "$1" | tr '\n' '|' | LC_ALL=C tr -c '[:print:]' '?'
}

skip() { # $1: what was not tested, $2: why
    echo "skipped  $1 ($2)"
}

run() { # renders a picture; $1: its width in units of 8 pixels; the rest: further options
    "$bin/01_spheres" --width $(($1 * 8)) --height $(($1 * 5)) --samples 1 "${@:2}" >out 2>err
    code=$?
}

same_as() { # $1, $2: files
    cmp -s "$1" "$2"
}

is_whole() { # $1: a picture
    "$bin/compare" "$1" "$1" >/dev/null 2>&1
}

no_part() { # succeeds if no unfinished file is left in folder $1
    [ -z "$(find "$1" -name '*.part')" ]
}

rescued() { # the picture is in the temporary folder, stderr reports it, and the exit code is 2
    local place
    place=$(sed -n 's/.*; the new picture is \(.*\)$/\1/p' err | head -n 1)
    [ "$code" = 2 ] && [ "$(dirname -- "$place")" = "$TMPDIR" ] && is_whole "$place" && grep -qxF "wrote $place" out
}

# --- disks -----------------------------------------------------------------------------------------------------------

full_disk() {
    mkdir small
    if ! mount -t tmpfs -o size=16k raysteps small 2>/dev/null; then
        skip "a full disk" "mounting is not permitted here"
        return
    fi
    run 6 --out small/a.png
    cp small/a.png old.png
    run 50 --out small/a.png
    fact "on a full disk the old picture is kept" same_as small/a.png old.png
    fact "on a full disk no unfinished file is left" no_part small
    fact "on a full disk the new picture is saved in the temporary folder with exit code 2" rescued
    fact "on a full disk the reason is reported" grep -q "No space left on device" err
    umount small
}

short_files() { # with the size of all files limited, by `ulimit -f`
    run 6 --out a.png
    cp a.png old.png
    (ulimit -f 4 && "$bin/01_spheres" --width 400 --height 250 --samples 1 --out a.png >out 2>err)
    code=$?
    fact "with a limit on file sizes the old picture is kept" same_as a.png old.png
    fact "with a limit on file sizes no unfinished file is left" no_part .
    fact "with a limit on file sizes the loss is reported with exit code 2" said_lost
}

said_lost() {
    [ "$code" = 2 ] && grep -q "File too large.*is lost" err
}

vanishing_folder() {
    mkdir gone
    : >out
    "$bin/01_spheres" --width 200 --height 120 --samples 100 --threads 1 --out gone/a.hdr >out 2>err &
    until grep -q sample out || ! kill -0 $! 2>/dev/null; do sleep 0.01; done
    rm -r gone
    wait $!
    code=$?
    fact "a folder that is deleted while a picture is rendered does not cost the picture" rescued
}

read_only_folder() {
    mkdir locked
    chmod 555 locked
    if [ "$(id -u)" != 0 ]; then
        run 6 --out locked/a.png
    elif setpriv --reuid 65534 --clear-groups "$bin/01_spheres" --help >out 2>err &&
        setpriv --reuid 65534 --clear-groups test -r locked; then
        setpriv --reuid 65534 --clear-groups "$bin/01_spheres" --out locked/a.png >out 2>err
        code=$?
    else
        skip "a folder without permission" "root can write everywhere, and other users cannot reach this folder"
        return
    fi
    fact "a folder without permission is rejected before rendering with the reason" refused "Permission denied"
}

refused() { # $1: a part of the reason
    [ "$code" = 2 ] && [ ! -s out ] && [ "$(wc -l <err)" -eq 1 ] && grep -q "$1" err
}

long_names() {
    local name
    name=$(printf 'n%.0s' {1..251}).png
    run 6 --out "$name"
    fact "a name of 255 bytes is written" is_whole "$name"
    run 6 --out "n$name"
    fact "a name of 256 bytes is rejected before rendering with the reason" refused "File name too long"
}

two_at_once() {
    local i codes=""
    for i in 1 2 3 4 5; do
        "$bin/01_spheres" --width 160 --height 100 --samples 1 --out both >out 2>err &
        "$bin/01_spheres" --width 120 --height 75 --samples 1 --out both >out2 2>err2
        codes+=$?
        wait $!
        codes+=$?
    done
    code=$codes
    fact "two programs that write the same files simultaneously both succeed" [ "$codes" = 0000000000 ]
    fact "two programs that write the same .png simultaneously leave a complete one" is_whole both.png
    fact "two programs that write the same .hdr simultaneously leave a complete one" is_whole both.hdr
    fact "two programs that write the same files simultaneously leave no unfinished file" no_part .
}

# --- memory ----------------------------------------------------------------------------------------------------------

short_memory() {
    local megabytes outcomes="" wrong=""
    for megabytes in 20 35 40 45 50 55 60 65 70 200; do
        rm -f m.png
        (ulimit -v $((megabytes * 1024)) && exec "$bin/01_spheres" --width 800 --height 600 --samples 1 --threads 2 \
            --out m.png >out 2>err)
        code=$?
        if [ $code = 0 ] && is_whole m.png; then
            outcomes+=w
        elif [ $code != 0 ] && ! grep -q '^time' out && [ ! -e m.png ]; then
            outcomes+=r
        else
            wrong+=" $megabytes MB (exit code $code: $(tail -n 1 err))"
        fi
    done
    fact "with any amount of memory a picture is written or rejected before rendering${wrong:+; not with$wrong}" \
        [ -z "$wrong" ]
    (ulimit -v 200000 && exec "$bin/01_spheres" --width 8000 --height 8000 --out m.png >out 2>err)
    code=$?
    fact "with 200 MB of memory a picture of 2.6 GB is rejected with both numbers" refused "2.6 GB .* 0.2 GB"
    fact "with 20 MB of memory a picture is rejected and with 200 MB it is written" \
        [ "${outcomes:0:1}${outcomes: -1}" = rw ]
}

# --- signals ---------------------------------------------------------------------------------------------------------

signals() {
    local i signal delay begun whole names=(INT TERM HUP KILL) codes=(130 143 129 137) wrong="" stopped=0
    RANDOM=13
    run 6 --out s
    cp s.png old.png
    cp s.hdr old.hdr
    begun=$(date +%s%N)
    run 50 --out new
    whole=$((($(date +%s%N) - begun) / 1000000)) # milliseconds
    for i in {0..15}; do
        signal=${names[i % 4]}
        "$bin/01_spheres" --width 400 --height 250 --samples 1 --out s >out 2>err &
        delay=$((RANDOM % (whole + whole / 4 + 1)))
        sleep "$((delay / 1000)).$(printf %03d $((delay % 1000)))"
        kill -s "$signal" $! 2>/dev/null
        { wait $!; } 2>/dev/null
        code=$?
        [ $code != 0 ] && stopped=$((stopped + 1))
        [ $code = 0 ] || [ $code = "${codes[i % 4]}" ] || wrong+=" exit code $code after $signal;"
        same_as s.png old.png || same_as s.png new.png || wrong+=" a broken .png after $signal;"
        same_as s.hdr old.hdr || same_as s.hdr new.hdr || wrong+=" a broken .hdr after $signal;"
        [ "$signal" = KILL ] || no_part . || wrong+=" a .part left by $signal;"
        rm -f ./*.part
        cp old.png s.png
        cp old.hdr s.hdr
    done
    fact "INT, TERM, HUP and KILL leave each file old or new and none unfinished${wrong:+; but:$wrong}" \
        [ -z "$wrong" ]
    fact "at least one of the signals arrived in time ($stopped of 16)" [ $stopped -gt 0 ]
}

# --- streams and environment -----------------------------------------------------------------------------------------

# Runs a command with closed or full streams, and checks its exit code and that its picture is complete.
stream() { # $1: the fact; $2: the exit code; the rest: the command
    local sentence=$1 expected=$2
    shift 2
    rm -f st.png
    : >out
    : >err
    "$@"
    code=$?
    fact "$sentence" ends_with "$expected" st.png
}

ends_with() { # $1: the exit code, $2: the picture
    [ "$code" = "$1" ] && is_whole "$2"
}

small=(--width 48 --height 30 --samples 1 --out st.png)
no_streams() { "$bin/01_spheres" "${small[@]}" <&- >&- 2>&-; }
no_stdout() { "$bin/01_spheres" "${small[@]}" >&- 2>err; }
no_stderr() { "$bin/01_spheres" "${small[@]}" >out 2>&-; }
full_stdout() { "$bin/01_spheres" "${small[@]}" >/dev/full 2>err; }
full_stderr() { "$bin/01_spheres" "${small[@]}" >out 2>/dev/full; }
early_reader() {
    local codes
    "$bin/01_spheres" "${small[@]}" 2>err | head -n 1 >out
    codes=${PIPESTATUS[0]}
    [ "$codes" = 2 ] && codes=0 # the reader may have closed the pipe before or after the last line
    return "$codes"
}
no_surroundings() { env -i "$bin/01_spheres" "${small[@]}" >out 2>err; }

streams() {
    stream "closed streams do not cost the picture" 0 no_streams
    stream "a closed stdout does not cost the picture" 0 no_stdout
    stream "a closed stderr does not cost the picture" 0 no_stderr
    stream "a full stdout does not cost the picture and is reported" 2 full_stdout
    stream "a full stderr does not cost the picture" 0 full_stderr
    stream "a reader that closes the pipe early does not cost the picture" 0 early_reader
    stream "without environment variables such as HOME or TERM a picture is rendered" 0 no_surroundings
}

escapes() {
    local escape
    escape=$(printf '\033[2J\033]0;OWNED\007\302\233')
    {
        echo "mtllib $escape.mtl"
        echo "mtllib real.mtl"
        echo "usemtl a$escape"
        printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl b\nf 1 3 2\n'
    } >escape.obj
    printf 'newmtl b\nmap_Kd x%s.png\n' "$escape" >real.mtl
    "$bin/05_mesh_bvh" --width 8 --height 8 --mesh escape.obj --out "$escape.png" >out 2>err
    code=$?
    fact "no escape sequence of a model reaches the terminal" no_control out err
    fact "a file name with escape sequences is valid" is_whole "$escape.png"
    cp escape.obj "$escape.obj"
    "$bin/06_textures" --width 8 --height 8 --mesh "$escape.obj" --out t.png >out 2>err
    code=$?
    fact "no escape sequence of a texture's name reaches the terminal" no_control out err
    "$bin/compare" "$escape" "$escape.obj" >out 2>err
    fact "compare prints no escape sequence of a file's name" no_control out err
}

no_control() { # the files $@ contain text without control characters other than line ends
    [ -s "${*: -1}" ] && ! LC_ALL=C grep -q "$(printf '[\001-\011\013-\037\177]\|\302[\200-\237]')" "$@"
}

cores() {
    if ! taskset -c 0 true 2>/dev/null; then
        skip "a program that may use one core" "taskset does not work here"
        return
    fi
    taskset -c 0 "$bin/01_spheres" "${small[@]}" >out 2>err
    code=$?
    fact "a program that may use one core renders with one thread" grep -q " 1 thread$" out
}

# Two rays at each boundary: the work grows exponentially with the depth.
deepest_glass() {
    local deepest
    deepest=$("$bin/04_refraction" --help | tr -s ' \n' ' ' | sed 's/.*--depth N[^[]*\[0 to \([0-9]*\);.*/\1/')
    timeout 20 "$bin/04_refraction" --depth "$deepest" --width 80 --height 50 --samples 1 --out g.png >out 2>err
    code=$?
    fact "the largest depth of 04_refraction, $deepest, ends within seconds" ends_with 0 g.png
}

# Not a fault, but timing errors would break it.
same_bits() {
    local accel threads wrong=""
    for accel in brute bvh wide; do
        for threads in 1 2 3 7; do
            "$bin/05_mesh_bvh" --width 24 --height 15 --samples 1 --accel $accel --threads $threads \
                --out t$threads.hdr >out 2>err
            same_as t1.hdr t$threads.hdr || wrong+=" $accel with $threads threads;"
        done
    done
    code=0
    fact "a mesh gives the same bits on 1, 2, 3 and 7 threads in each tree${wrong:+; not:$wrong}" [ -z "$wrong" ]
}

full_disk
short_files
vanishing_folder
read_only_folder
long_names
two_at_once
short_memory
signals
streams
escapes
cores
deepest_glass
same_bits
echo "took $((SECONDS - begin)) s"
exit $failed
