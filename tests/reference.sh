#!/usr/bin/env bash
# Renders a step with its program's own settings and compares the picture with the step's reference.
# reference.sh NAME PROGRAM COMPARE REFERENCES OUT: exit 0 agrees, 1 differs, 2 error, 77 no reference yet.
set -eu

name=$1 program=$2 compare=$3 references=$4 out=$5
facts=$references/$name.txt
if [ ! -f "$facts" ]; then
    echo "skipped: $facts is not there yet; ./learn references makes it"
    exit 77
fi

# The facts name the flags that a picture needs to be comparable: usually none, the program's own defaults.
flags=$(sed -n 's/^test flags: *//p' "$facts")
arguments=()
variances=()
if [ -f "$references/$name.variance.hdr" ]; then # a noisy step: how sure each picture is of its pixels
    arguments=(--variance "$out/$name.variance.hdr")
    variances=(--variance-a "$out/$name.variance.hdr" --variance-b "$references/$name.variance.hdr")
fi

mkdir -p "$out"
# shellcheck disable=SC2086 # the flags are words
"$program" --quiet --out "$out/$name" ${arguments[@]+"${arguments[@]}"} $flags
"$compare" "$out/$name.hdr" "$references/$name.hdr" ${variances[@]+"${variances[@]}"}
