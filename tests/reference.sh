#!/usr/bin/env bash
# Renders a step with its program's default settings and compares the picture with the step's reference.
# reference.sh NAME PROGRAM COMPARE REFERENCES OUT: exit 0 same, 1 different, 2 error, 77 no reference yet.
set -eu

name=$1 program=$2 compare=$3 references=$4 out=$5
facts=$references/$name.txt
if [ ! -f "$facts" ]; then
    echo "skipped: $facts does not exist; run ./learn references"
    exit 77
fi

# The facts file lists the flags for a comparable picture; usually there are none, and the defaults apply.
flags=$(sed -n 's/^test flags: *//p' "$facts")
arguments=()
variances=()
if [ -f "$references/$name.variance.hdr" ]; then # a noisy step: compare with the variances of both
    arguments=(--variance "$out/$name.variance.hdr")
    variances=(--variance-a "$out/$name.variance.hdr" --variance-b "$references/$name.variance.hdr")
fi

mkdir -p "$out"
# shellcheck disable=SC2086 # the flags are words
"$program" --quiet --out "$out/$name" ${arguments[@]+"${arguments[@]}"} $flags
"$compare" "$out/$name.hdr" "$references/$name.hdr" ${variances[@]+"${variances[@]}"}
