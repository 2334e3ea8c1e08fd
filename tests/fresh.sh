#!/usr/bin/env bash
# Checks that every command of ./learn works as the first one in a fresh clone, however it is called; that simultaneous
# builds wait for each other; and that broken files are repaired or reported. Nothing is compiled: cmake, ctest and apt
# are stubs, whose programs write the files that their options name, or fail.
# fresh.sh PROJECT TUTOR: exit 0 if all checks pass; TUTOR is the real tutor.
set -u

project=$1 tutor=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
clone="$folder/a clone" # a blank in the path reveals missing quotes
stubs=$folder/stubs
bad=0

mkdir -p "$clone" "$stubs"
tar -C "$project" --exclude=./build --exclude=./renders --exclude=./workshop --exclude=./.git -cf - . | tar -C "$clone" -xf -

# The stub of every program. It creates every file that an option names, and fails if its folder is missing.
cat >"$stubs/program" <<'END'
#!/usr/bin/env bash
name=$(basename "$0") flag=""
root=$(cd "$(dirname "$0")/../../.." && pwd)
if [ "$name" = program ]; then # made by the stub of the compiler
    root=$(cd "$(dirname "$0")" && until [ -e learn ]; do cd ..; done && pwd)
    case "$*" in
        *--reporters=lines*) name=test_ ;;
        *) name=$(printf '%s\n' "$@" | grep -A1 '^--out' | tail -1) && name=${name##*/} ;;
    esac
fi
write() { # $1: the file, $2: a file to copy, optional
    cat "${2:-/dev/null}" >"$1" || exit 2
    [ -n "${2-}" ] || echo '{"a": 1}' >"$1"
}
for word in "$@"; do
    case $flag in
        --out)
            case $word in *.png | *.hdr) word=${word%.*} ;; esac
            for kind in png hdr; do write "$word.$kind" "$root/assets/reference/${name#trace_}.$kind"; done
            ;;
        --variance) write "$word" "$root/assets/reference/$name.variance.hdr" ;;
        --json) write "$word" ;;
    esac
    case $word in --benchmark_out=*) write "${word#*=}" ;; esac
    flag=$word
done
[ -z "${STOP-}" ] || kill -s "$STOP" $PPID
case $name in
    bench_report) echo report >"$1/report.md" || exit 2 ;;
    contact_sheet) write "$1" ;;
    test_*) printf 'case\ta\nend\ta\tok\t.1\n' ;;
    trace_*) echo "returns (1 1 1)" ;;
    compare) echo "same picture" ;;
    [0-9]*) printf '4 x 4, 1 samples a pixel, seed 1, 1 threads\ntime 1.00 s, 1 rays, 1.00 million rays a second\n' ;;
esac
END

# The stub of the compiler, which ./learn check runs itself.
cat >"$stubs/compiler" <<'END'
#!/usr/bin/env bash
while [ $# -gt 1 ]; do
    [ "$1" != -o ] || { rm -f "$2" && cp "$(dirname "$0")/program" "$2"; }
    shift
done
END

cat >"$stubs/cmake" <<'END'
#!/usr/bin/env bash
stubs=$(dirname "$0")
make() { # $1: the build, $2: a program
    mkdir -p "$1/bin" && rm -f "$1/bin/$2" && cp "$stubs/program" "$1/bin/$2"
    [ "$2" != tutor ] || cp "$stubs/tutor" "$1/bin/"
}
if [ "$1" = --preset ]; then
    [ "${3-}" != -S ] || cd "$4" || exit 1
    mkdir -p "build/$2/Testing/Temporary"
    printf 'CMAKE_HOME_DIRECTORY:INTERNAL=%s\nCMAKE_CXX_COMPILER:FILEPATH=c++\n' "$(pwd -P)" >"build/$2/CMakeCache.txt"
    mkdir -p "build/$2/prove"
    printf 'compiler %s\ntest_main %s\nlibrary %s\n' "$stubs/compiler" "$stubs/program" "$stubs/program" \
        >"build/$2/prove/toolchain.txt"
    printf 'build bench_%s: phony\n' traversal obj_loading renders convergence kernels >"build/$2/build.ninja"
    exit
fi
build=$2
grep -q '^build' "$build/build.ninja" || exit 1
[ -z "${SLOW-}" ] || { echo begin && sleep 1.5 && echo end; } >>"$SLOW"
shift 2
for target in "$@"; do
    case $target in
        programs | checks*)
            for program in compare contact_sheet make_assets $(ls "$build/../../steps"); do
                make "$build" "$program"
            done
            ;;
        -*) ;;
        *) make "$build" "$target" ;;
    esac
    # Imitates the output of the build tool.
    echo "[1/1] Linking CXX executable bin/$target"
done
END

# The stub of the compiler that ./learn calls for the guide, which is compiled in earnest once.
cat >"$stubs/c++" <<'END'
#!/usr/bin/env bash
stubs=$(dirname "$0")
[ "$1" = -x ] || exec echo "c++ 1.0" # asked for its version
[ -e "$stubs/guide" ] || PATH=${PATH#*:} c++ "$@" || exit
while [ "$1" != -o ]; do shift; done
[ -e "$stubs/guide" ] && cp "$stubs/guide" "$2" || cp "$2" "$stubs/guide"
END

printf '#!/bin/sh\necho "Total Tests: 1"\n' >"$stubs/ctest"
# shellcheck disable=SC2016 # expanded in the stub
printf '#!/bin/sh\nshift 2\nprintf "%%s=installed " "$@"\n' >"$stubs/dpkg-query"
printf '#!/bin/sh\necho "nothing is missing: no need for apt"\nexit 1\n' >"$stubs/apt-get"
cp "$stubs/apt-get" "$stubs/ninja"
chmod +x "$stubs"/*
cp "$tutor" "$stubs/tutor"

here=$clone learn=./learn # the current folder and the command
first() { # $1: a part of the output; the rest: the arguments
    local part=$1 said code
    shift
    rm -rf "$clone"/{build,renders,workshop}
    said=$(cd "$here" && PATH=$stubs:$PATH "$learn" "$@" 2>&1 </dev/null)
    code=$?
    if [ "${1-}" = start ]; then # it leaves a build in the background
        for _ in {1..200}; do compgen -G "$clone/build/tutor.*[0-9]" >/dev/null && break || sleep 0.1; done
    fi
    if [ $code != 0 ] || [[ $said != *"$part"* ]]; then
        printf '%s\n' "WRONG: $learn $*: expected exit 0 and '$part', got exit $code and: $said"
        bad=1
    fi
}

first "The commands of this script"
first "" setup
first "contact sheet: renders/contact_sheet.png" run
first "renders/03_mirror.png" run 03
first "matches" run 08 --threads 2
first "renders/05_mesh_bvh.png" run 05 --samples 4
first "" test
first "" test 03
first "" test bench
first "report: build/bench/report/report.md" bench
for name in traversal scaling renders convergence obj kernels; do
    first "report.md" bench $name --json "$folder/numbers.json"
done
first "report: $folder/report/report.md" bench traversal --quick --out "$folder/report"
first "" prove --step 03 --no-pictures
first "" weave --check
first "" figures 01
first "look at every one of them" references 03
first "returns" trace 03 120 80
first "same picture" compare a.png b.png
first "workshop/03_mirror/mirror.h" start 03
first "Step 03: what does the mirror see?" check 03 --no-picture
first "picture   " check 08
first "waiting for the next save" watch 03 --no-picture
first "next: ./learn start 01" status
first "Hint 1 of 3" hint 03 reflected_ray
first "reference is used again" undo --help
first "render it: ./learn run 08 --scene lamp" scene lamp
first "building build/debugger/03_mirror" debug 03 --only-build

# By a link to the project, by a link to the script, and with CDPATH, which makes cd print.
ln -s "$clone" "$folder/linked"
here=$folder/linked
first "report.md" bench traversal --json "$folder/numbers.json"
touch "$clone/build/bench/MARK"
(cd "$clone" && PATH=$stubs:$PATH ./learn bench traversal >/dev/null 2>&1)
[ -e "$clone/build/bench/MARK" ] || { echo "WRONG: another path to the project loses its build" && bad=1; }
here=$folder
ln -s "a clone/learn" "$folder/learn"
first "renders/03_mirror.png" run 03
ln -s ../learn "$folder/stubs/to_learn"
learn=stubs/to_learn
first "renders/03_mirror.png" run 03
learn="a clone/learn"
export CDPATH=$folder:.
first "renders/03_mirror.png" run 03
unset CDPATH

here=$clone learn=./learn

# The tutor stays when the folder is moved, and libraries are built again; a change of its sources builds it again.
rm -rf "$clone"/{build,workshop}
check_says() { # $1: whether the tutor is built (0 or 1), $2: when
    said=$(cd "$here" && PATH=$stubs:$PATH ./learn check 03 --no-picture 2>&1)
    [[ $said == *"pass"* ]] && [ "$(grep -c "^building the tutor" <<<"$said")" = "$1" ] ||
        { echo "WRONG: check $2: $said" && bad=1; }
}
check_says 1 "in a fresh clone"
mv "$clone" "$folder/moved"
here=$folder/moved
check_says 0 "in a folder that was moved"
check_says 0 "for the second time in a folder that was moved"
echo "// changed" >>"$here/tools/tutor/util.h"
check_says 1 "after a change of the tutor"
mv "$here" "$clone"
here=$clone

# Two simultaneous builds: one builds, the other reports that it waits. The lock of a killed process blocks nothing.
rm -rf "$clone/build"
export SLOW=$folder/order
(cd "$clone" && PATH=$stubs:$PATH ./learn run 03 >"$folder/said.1" 2>&1) &
(cd "$clone" && PATH=$stubs:$PATH ./learn check 03 --no-picture >"$folder/said.2" 2>&1)
wait
awk 'NR % 2 ? $0 != "begin" : $0 != "end" { exit 1 }' "$SLOW" ||
    { echo "WRONG: two build simultaneously:" && cat "$SLOW" && bad=1; }
grep -qs "another ./learn is building in this folder; waiting until it is done" "$folder"/said.[12] ||
    { echo "WRONG: a waiting ./learn does not report it" && bad=1; }
[ "$(grep -l -e 'renders/03_mirror.png' -e 'of [0-9]* pass' "$folder"/said.[12] | wc -l)" = 2 ] ||
    { echo "WRONG: one of two simultaneous builds fails" && cat "$folder"/said.[12] && bad=1; }
(cd "$clone" && PATH=$stubs:$PATH exec ./learn run 03 >/dev/null 2>&1) &
sleep 0.5
kill -KILL $!
wait 2>/dev/null
unset SLOW
(cd "$clone" && PATH=$stubs:$PATH timeout 20 ./learn run 03 >/dev/null 2>&1) || { echo "WRONG: a killed ./learn still blocks" && bad=1; }
for _ in {1..100}; do # what it had started goes on in this folder, which is moved below
    pgrep -f "$stubs/cmake" >/dev/null || break
    sleep 0.1
done

# The exit code names the signal that ended it.
rm -rf "$clone/build"
for signal in INT:130 TERM:143 HUP:129; do
    (cd "$clone" && export STOP=${signal%:*} && PATH=$stubs:$PATH ./learn run 03 >/dev/null 2>&1)
    code=$?
    [ $code = "${signal#*:}" ] || { echo "WRONG: ${signal%:*} ends with code $code" && bad=1; }
done
[ -z "$(find "$clone/build" -name 'learn.??????')" ] || { echo "WRONG: a scratch folder is left" && bad=1; }

# Broken build files are regenerated; if nothing can be built, one line reports it.
for file in build.ninja CMakeCache.txt; do
    echo garbage >"$clone/build/release/$file"
    (cd "$clone" && PATH=$stubs:$PATH ./learn run 03 >/dev/null 2>&1) || { echo "WRONG: a broken $file is not repaired" && bad=1; }
done
refuses() { # $1: a part of the line; the rest: the arguments
    local part=$1 said code
    shift
    said=$(cd "$here" && PATH=$stubs:$PATH ./learn "$@" 2>&1)
    code=$?
    if [ $code != 2 ] || [ "$(printf '%s\n' "$said" | wc -l)" -ne 1 ] || [[ $said != *"$part"* ]]; then
        printf '%s\n' "WRONG: in $here, ./learn $*: expected exit 2 and one line with '$part', got exit $code and: $said"
        bad=1
    fi
}
rm -rf "$clone/build"
refuses "there is no step '99'" hint 99
[ ! -e "$clone/build" ] || { echo "WRONG: a wrong argument builds something" && bad=1; }
touch "$clone/build"
refuses "is there a file of that name" run 03
refuses "is there a file of that name" status
rm "$clone/build"
for name in 'C#' 'a;b' 'a"b' $'a\nb'; do
    mv "$clone" "$folder/$name"
    here=$folder/$name
    refuses "CMake cannot build in a folder with" run 03
    mv "$folder/$name" "$clone"
done
for name in "it's" "a & (b)" 'US$ 5'; do # which need no special treatment
    mv "$clone" "$folder/$name"
    here=$folder/$name clone=$folder/$name
    first "renders/03_mirror.png" run 03
    first "Hint 1 of 3" hint 03 reflected_ray
done
here=$clone

# The benchmark of the edit loop, with a single step, because it saves and checks each file.
rm -r "$clone"/steps/0[2-8]*
first "checks, s" bench loop --json "$folder/loop.json"
exit $bad
