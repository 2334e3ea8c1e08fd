#!/usr/bin/env bash
# Checks the trace of one pixel's rays, a tree: shadow rays, reflections and the radiance that returns.
# trace.sh PROGRAM OUT: PROGRAM is the traced program of step 03; exit 0 if the trace is complete.
set -eu

program=$1 out=$2
mkdir -p "$out"
crop() { "$program" --crop "$1" --threads 1 --quiet --out "$out/traced"; }

fail() {
    echo "wrong: $1" >&2
    exit 1
}

# The middle row of the picture contains a mirror; its reflected ray is one level deeper.
for ((x = 0; x < 640; x += 20)); do
    told=$(crop $x,200,$((x + 1)),201)
    if grep -q 'Mirror' <<<"$told" && grep -q 'unoccluded' <<<"$told"; then break; fi
done
grep -q 'hits material [0-9]*, a Mirror' <<<"$told" || fail "no ray hits a mirror"
grep -q '^    ray from ' <<<"$told" || fail "no ray is reflected from it"
grep -q '^    returns (' <<<"$told" || fail "the reflected ray returns nothing"
grep -q 'shadow ray from .*: unoccluded' <<<"$told" || fail "no shadow ray is unoccluded"

# The first of sixteen samples is traced unless another one is requested; there is no seventeenth.
one=$(crop 320,240,321,241 | grep -c '^  returns')
[ "$one" = 1 ] || fail "$one samples are traced, not one"
second=$(RAYSTEPS_TRACE_SAMPLE=2 crop 320,240,321,241 | grep -v '^wrote ')
first=$(crop 320,240,321,241 | grep -v '^wrote ')
[ "$first" != "$second" ] || fail "the second sample is the first one"
none=$(RAYSTEPS_TRACE_SAMPLE=17 crop 320,240,321,241 | grep -c 'returns' || true)
[ "$none" = 0 ] || fail "there is a seventeenth sample"
