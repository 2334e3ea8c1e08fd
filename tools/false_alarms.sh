#!/usr/bin/env bash
# Measures how often compare calls a correct render wrong.
# false_alarms.sh [BUILD [SEEDS [SAMPLES]]] renders 07 and 08 with other seeds, as ctest does or with SAMPLES
# per pixel, compares each with its reference, and prints a table. Defaults: build/release and 20 seeds.
set -eu

project=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-$project/build/release}
seeds=${2:-20}
samples=${3-}
references=$project/assets/reference
[ -x "$build/bin/compare" ] || { echo "false_alarms: $build/bin/compare does not exist; build it first" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Prints "verdict outliers largest_z mean_flip" for one render.
one() { # $1: the step, $2: the seed
    local flags=${samples:+--samples $samples}
    [ -n "$flags" ] || flags=$(sed -n 's/^test flags: *//p' "$references/$1.txt")
    # shellcheck disable=SC2086 # splits the flags
    "$build/bin/$1" --quiet --seed "$2" --out "$work/a.hdr" --variance "$work/v.hdr" $flags >"$work/said"
    "$build/bin/compare" "$work/a.hdr" "$references/$1.hdr" --variance-a "$work/v.hdr" \
        --variance-b "$references/$1.variance.hdr" --json "$work/json" >"$work/words" || true
    echo "$(sed -E 's/.*"verdict": *"([a-z]*)".*/\1/' "$work/json")" \
        "$(sed -E 's/.*"tiles_over_4": *([0-9]*).*/\1/' "$work/json")" \
        "$(sed -n -E '1s/.*largest z (-?[0-9.a-z]+).*/\1/p' "$work/words")" \
        "$(sed -E 's/.*"mean": *([0-9.e-]*).*/\1/' "$work/json")"
}

printf '%-14s %6s %6s %13s %12s %10s\n' step seeds wrong "tiles over 4" "largest |z|" "mean FLIP"
for step in 07_antialias 08_indirect; do
    for seed in $(seq 101 $((100 + seeds))); do
        one "$step" "$seed"
    done | awk -v step="$step" '
        { if ($1 != "noise") wrong++; alarms += $2; z = $3 < 0 ? -$3 : $3; if (z > largest) largest = z; flip += $4 }
        END { printf "%-14s %6d %6d %13d %12.2f %10.4f\n", step, NR, wrong, alarms, largest, flip / NR }'
done
