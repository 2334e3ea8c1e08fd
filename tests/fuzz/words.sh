#!/usr/bin/env bash
# Checks that ./learn fuzz rejects wrong arguments with one line and exit code 2 before anything is built.
# words.sh LEARN: exit 0 if it does.
set -u

learn=$1
bad=0

refuses() { # $1: a part of the line; the rest: the arguments
    local part=$1 said code
    shift
    said=$("$learn" fuzz "$@" 2>&1)
    code=$?
    if [ $code != 2 ] || [ "$(printf '%s\n' "$said" | wc -l)" -ne 1 ] || [[ $said != *"$part"* ]]; then
        echo "./learn fuzz $*: expected exit 2 and one line with '$part', got exit $code and: $said"
        bad=1
    fi
}

refuses "the targets are bmp catalogue" bitmaps
refuses "there is no target '..'" ..
refuses "not expected: hdr" obj hdr
refuses "not expected: --fast" --fast
refuses "--minutes: 1 required" --minutes
refuses "--minutes: Value 1.5 not in range" obj --minutes 1.5
refuses "--seconds: Value 0 not in range" --seconds 0
refuses "--seed: Value -1 not in range" --seed -1
# Without a compiler that has libFuzzer.
PATH_WITHOUT=$(mktemp -d)
trap 'rm -rf "$PATH_WITHOUT"' EXIT
printf '#!/bin/sh\nexit 1\n' >"$PATH_WITHOUT/clang++"
chmod +x "$PATH_WITHOUT/clang++"
PATH=$PATH_WITHOUT:$PATH refuses "fuzz needs clang++ with libFuzzer" hdr
"$learn" fuzz --help | grep -q "^Targets: bmp catalogue" || {
    echo "./learn fuzz --help does not name the targets"
    bad=1
}
exit $bad
