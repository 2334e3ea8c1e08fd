#!/usr/bin/env bash
# How long a learner waits: for each step, from saving a file to the verdict of its checks, and with the picture.
# loop.sh ROOT BUILD [JSON]: saves each file with exercises anew (as it is) and lets ./learn check run; the slowest
# file of a step counts.
set -u

root=$1 build=$2 json=${3-}
now() { date +%s.%N; }
since() { awk "BEGIN { printf \"%.1f\", $(now) - $1 }"; }
larger() { awk "BEGIN { print ($1 > $2) ? $1 : $2 }"; }

waited() { # $1: the file that is saved; the rest: flags for check
    local begin file=$1
    shift
    touch "$file" || exit 1
    begin=$(now)
    "$build/bin/tutor" --root "$root" --workshop "$build/loop" check "$step" --build "$build" "$@" >"$build/said_loop.txt" || {
        cat "$build/said_loop.txt" >&2
        exit 1
    }
    since "$begin"
}

"${CMAKE:-cmake}" --build "$build" --target tutor checks >"$build/said_loop.txt" 2>&1 || {
    cat "$build/said_loop.txt" >&2
    exit 1
}
printf '%-15s %-12s %10s %13s\n' step "slowest file" "checks, s" "+ picture, s"
comma="" steps=""
for folder in "$root"/steps/*/; do
    step=$(basename "$folder")
    checks=0 picture=0 slowest=""
    for file in "$folder"*.h; do
        grep -q '//>' "$file" || continue
        seconds=$(waited "$file" --no-picture) || exit 1
        if [ "$(larger "$seconds" "$checks")" = "$seconds" ]; then
            checks=$seconds slowest=$file
        fi
    done
    picture=$(waited "$slowest") || exit 1
    printf '%-15s %-12s %10s %13s\n' "$step" "$(basename "$slowest")" "$checks" "$picture"
    steps="$steps$comma{\"step\": \"$step\", \"file\": \"$(basename "$slowest")\", \"checks_seconds\": $checks, \"picture_seconds\": $picture}"
    comma=", "
done
[ -z "$json" ] || echo "{\"steps\": [$steps]}" >"$json"
