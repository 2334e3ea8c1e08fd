#!/usr/bin/env bash
# Measures how long a learner waits from saving a file to the result of its checks, and to that of its picture.
# loop.sh ROOT BUILD [JSON]: runs ./learn check on each file with exercises, without the results of earlier checks.
set -u

root=$1 build=$2 json=${3-}
now() { perl -MTime::HiRes=time -e 'printf "%.6f\n", time'; } # date has no fractions on macOS
since() { awk "BEGIN { printf \"%.1f\", $(now) - $1 }"; }

waited() { # sets $checks and $picture, the seconds until their lines are there
    local begin tutor
    checks="" picture=""
    : >"$build/said_loop.txt"
    rm -rf "$build/check/cache" && mkdir -p "$build/check/cache" || exit 1
    begin=$(now)
    "$build/bin/tutor" --root "$root" --workshop "$build/loop" check "$step" --build "$build" >"$build/said_loop.txt" 2>&1 &
    tutor=$!
    while [ -z "$picture" ] && kill -0 $tutor 2>/dev/null; do
        sleep 0.05
        [ -n "$checks" ] || ! grep -q '^saved' "$build/said_loop.txt" || checks=$(since "$begin")
        ! grep -qE '^(picture|preview)' "$build/said_loop.txt" || picture=$(since "$begin")
    done
    kill $tutor 2>/dev/null # the step's other checks are not waited for
    wait $tutor 2>/dev/null
    [ -n "$checks" ] && [ -n "$picture" ] && return
    cat "$build/said_loop.txt" >&2
    exit 1
}

"${CMAKE:-cmake}" --build "$build" --target tutor test_main models raysteps_accel common >"$build/said_loop.txt" 2>&1 || {
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
