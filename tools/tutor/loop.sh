#!/usr/bin/env bash
# Measures how long a learner waits from saving a file to the result of its checks, and to that of its picture.
# loop.sh ROOT BUILD [JSON]: runs ./learn check on each file with exercises, without the results of earlier checks.
set -u

root=$1 build=$2 json=${3-}
now() { date +%s.%N; }
since() { awk "BEGIN { printf \"%.1f\", $(now) - $1 }"; }

waited() { # sets $checks and $picture, the seconds until their lines are there
    local begin line
    checks="" picture=""
    rm -rf "$build/check/cache" && mkdir -p "$build/check/cache" || exit 1
    begin=$(now)
    while IFS= read -r line; do
        case $line in
            saved*) checks=$(since "$begin") ;;
            picture*) [ -n "$picture" ] || picture=$(since "$begin") ;;
        esac
    done < <("$build/bin/tutor" --root "$root" --workshop "$build/loop" check "$step" --build "$build" |
        tee "$build/said_loop.txt")
    [ -n "$checks" ] && [ -n "$picture" ] && return
    cat "$build/said_loop.txt" >&2
    exit 1
}

"${CMAKE:-cmake}" --build "$build" --target tutor test_main raysteps_accel common >"$build/said_loop.txt" 2>&1 || {
    cat "$build/said_loop.txt" >&2
    exit 1
}
printf '%-15s %-14s %10s %13s\n' step file "checks, s" "+ picture, s"
comma="" steps=""
for folder in "$root"/steps/*/; do
    step=$(basename "$folder")
    for file in "$folder"*.h; do
        grep -q '//>' "$file" || continue
        mkdir -p "$build/loop/$step" # the tutor sees there what was saved; the compiler sees steps/
        cp "$file" "$build/loop/$step/"
        waited
        rm -r "${build:?}/loop/$step"
        printf '%-15s %-14s %10s %13s\n' "$step" "$(basename "$file")" "$checks" "$picture"
        steps="$steps$comma{\"step\": \"$step\", \"file\": \"$(basename "$file")\", \"checks_seconds\": $checks, \"picture_seconds\": $picture}"
        comma=", "
    done
done
[ -z "$json" ] || echo "{\"steps\": [$steps]}" >"$json"
