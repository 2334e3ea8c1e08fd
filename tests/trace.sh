#!/usr/bin/env bash
# The rays of one pixel are told as a tree: what the lamp's light meets, where mirrors send it, and what comes back.
# trace.sh PROGRAM OUT: the traced program of step 03; exit 0 if all is told.
set -eu

program=$1 out=$2
mkdir -p "$out"
crop() { "$program" --crop "$1" --threads 1 --quiet --out "$out/traced"; }

fail() {
    echo "wrong: $1" >&2
    exit 1
}

# Somewhere in the middle row of the picture stands a mirror; its ray goes on one level deeper.
for ((x = 0; x < 640; x += 20)); do
    told=$(crop $x,200,$((x + 1)),201)
    if grep -q 'Mirror' <<<"$told" && grep -q 'unoccluded' <<<"$told"; then break; fi
done
grep -q 'hits material [0-9]*, a Mirror' <<<"$told" || fail "no mirror is met"
grep -q '^    ray from ' <<<"$told" || fail "no ray goes on from it"
grep -q '^    returns (' <<<"$told" || fail "nothing comes back from there"
grep -q 'shadow ray from .*: unoccluded' <<<"$told" || fail "no shadow ray is free"

# One sample of sixteen, unless another is asked for; there is no seventeenth.
one=$(crop 320,240,321,241 | grep -c '^  returns')
[ "$one" = 1 ] || fail "$one samples are told, not one"
second=$(RAYSTEPS_TRACE_SAMPLE=2 crop 320,240,321,241 | grep -v '^wrote ')
first=$(crop 320,240,321,241 | grep -v '^wrote ')
[ "$first" != "$second" ] || fail "the second sample is the first one"
none=$(RAYSTEPS_TRACE_SAMPLE=17 crop 320,240,321,241 | grep -c 'returns' || true)
[ "$none" = 0 ] || fail "there is a seventeenth sample"
