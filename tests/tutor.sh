#!/usr/bin/env bash
# Checks a learner's session with the tutor, from start to undo, on the real steps and in a temporary workshop; and the
# errors for wrong arguments.
# tutor.sh TUTOR PROJECT: exit 0 if all checks pass.
set -u

tutor=$1
project=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
workshop="$folder/my workshop" # a blank in the path reveals missing quotes
bad=0

wrong() {
    echo "WRONG: $1"
    bad=1
}

run() { # sets $said, $erred and $code
    said=$("$tutor" --root "$project" --workshop "$workshop" "$@" 2>"$folder/erred")
    code=$?
    erred=$(cat "$folder/erred")
}

says() { # $1: a part of the output; the rest: the arguments
    local part=$1
    shift
    run "$@"
    [ $code = 0 ] || wrong "$*: exit $code and: $erred"
    [[ $said == *"$part"* ]] || wrong "$*: expected '$part', got: $said"
    [[ $said != *$'\x1b'* ]] || wrong "$*: colours without a terminal"
}

refuses() { # $1: a part of the line; the rest: the arguments
    local part=$1
    shift
    run "$@"
    if [ $code != 2 ] || [ -n "$said" ] || [ "$(wc -l <"$folder/erred")" -ne 1 ] || [[ $erred != *"$part"* ]]; then
        wrong "$*: expected exit 2 and one line with '$part', got exit $code, '$said' and: $erred"
    fi
}

# A learner's session.
says "next: ./learn start 01" status
[ ! -e "$workshop" ] || wrong "showing the status creates a folder"
says "Write 3 functions" start 03
gap=$(grep -n "TODO: where does the reflected ray start" "$workshop/03_mirror/mirror.h" | cut -d: -f1)
[[ $said == *"mirror.h:$gap  reflected_ray"* ]] || wrong "start 03: expected 'mirror.h:$gap  reflected_ray', got: $said"
says "mirror.h already exists" start 3
says "next: write shade in" status
says "Hint 1 of 3" hint 03 reflected_ray
says "Hint 2 of 3" hint 03 reflected_ray
says "Hint 2 of 3" hint 03 reflected_ray --again
says "Hint 3 of 3" hint 03 reflected_ray
says "no more hints" hint 03 reflected_ray
says "Hint 1 of 3" hint 03 reflected_ray --all
says "3 of 3  reflected_ray" hint 03
says "start again with the first" hint 03 reflected_ray --reset
says "-    return spawn_ray(hit, reflect(ray.direction, hit.shading_normal));" diff 03 mirror.h
grep -v '^ *//[<>]' "$project/steps/03_mirror/mirror.h" >"$workshop/03_mirror/mirror.h"
says "mirror.h: same as the reference" diff 03 mirror.h
says "2 of 3 functions started" status
says "to restore it: mv '" undo 03 mirror.h
[ ! -e "$workshop/03_mirror/mirror.h" ] || wrong "undo does not move the file"
back=$(printf '%s\n' "$said" | sed -n 's/^ *to restore it: //p')
eval "$back" || wrong "the command that undoes undo does not work: $back"
says "same as the reference" diff 03 mirror.h
says "moved" undo 03
says "03_mirror       not started" status
refuses "you have no files of 03_mirror" undo 03

# Every step can be started, in any order, and every exercise has its hints.
for step in 08 01 07 02 06 03 05 04; do
    says "Write " start $step
    for name in $(printf '%s\n' "$said" | sed -n 's/^  .*\.h:[0-9]*  //p'); do
        says "Hint 3 of 3" hint $step "$name" --all
    done
done

# clangd finds the learner's headers before those of steps/.
[ "$(grep -m1 '^-I' "$workshop/compile_flags.txt")" = -I. ] || wrong "compile_flags.txt does not begin with the workshop"

# Scenes of one's own.
says "./learn run 08 --scene lamp" scene lamp
grep -q '"08_indirect/scene.h"' "$workshop/scenes/lamp.cpp" || wrong "the example does not include the step's scene"
says "./learn run 07 --scene chart" scene chart 7
refuses "lamp.cpp exists already" scene lamp
refuses "only letters, digits and _" scene a/b
refuses "from 05 on" scene early 04
refuses "from 05 on" run 04 --scene lamp
refuses "there is no" run 06 --scene=none
refuses 'must have #include "06_textures/scene.h"' run 06 --scene lamp

# A machine without a debugger.
said=$(PATH=$folder/none "$tutor" --root "$project" --workshop "$workshop" debug 03 2>&1)
[ $? = 2 ] && [[ $said == *"there is no gdb and no lldb here"* ]] || wrong "debug without a debugger: $said"

# Wrong arguments.
refuses "there is no step '9'" start 9
refuses "there is no step '03/..'" hint 03/..
refuses "03_mirror has no function 'mirror' to write; it has shade, reflected_ray" hint 03 mirror
refuses "there is no file 'mirror' in" diff 03 mirror
refuses "there is no file '../../x' in" undo 03 ../../x
refuses "STEP is required" start
refuses "not expected" status now
refuses "excludes" hint 03 reflected_ray --again --all
run start 9 --help
[ $code = 0 ] || wrong "start --help: exit $code"

# No partial files: a folder that is a file, and a full disk.
workshop=$folder/erred
refuses "cannot create the folder" start 03
workshop=$folder/full
(
    ulimit -f 0
    "$tutor" --root "$project" --workshop "$workshop" start 03
) >/dev/null 2>"/dev/null"
[ $? = 2 ] || wrong "a full disk is not an error"
left=$(find "$workshop" -type f)
[ -z "$left" ] || wrong "a full disk leaves $left"

for word in start status hint diff undo scene debug; do
    "$project/learn" --help | grep -q "learn $word" || wrong "./learn --help does not name $word"
done
exit $bad
