#!/usr/bin/env bash
# Checks that ./learn bench rejects wrong arguments with one line and exit code 2 before anything is built or written.
# bench.sh LEARN: exit 0 if it does.
set -u

learn=$1
bad=0

refuses() { # $1: a part of the line; the rest: the arguments
    local part=$1 said code
    shift
    said=$("$learn" bench "$@" 2>&1)
    code=$?
    if [ $code != 2 ] || [ "$(printf '%s\n' "$said" | wc -l)" -ne 1 ] || [[ $said != *"$part"* ]]; then
        echo "./learn bench $*: expected exit 2 and one line with '$part', got exit $code and: $said"
        bad=1
    fi
}

refuses "there is no benchmark 'travelsal'" travelsal
refuses "unknown argument '--fast'" --fast
refuses "unknown argument 'extra'" all extra
refuses "--json: 1 required" traversal --json
refuses "--out: 1 required" --out
refuses "does not exist" --json /nowhere/at/all.json
refuses "is a folder" --json /
refuses "cannot create the folder" --out /dev/null/report
"$learn" --help | grep -q "learn bench" || {
    echo "./learn --help does not name bench"
    bad=1
}
exit $bad
