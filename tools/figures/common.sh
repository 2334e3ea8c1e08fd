# What the scripts of the chapters share; ./learn figures runs them with ROOT and BUILD set.
# shellcheck shell=bash
set -euo pipefail

figures=$ROOT/docs/figures
made=$BUILD/figures # what is made on the way
mkdir -p "$figures" "$made"

# picture NAME STEP FLAGS...: renders docs/figures/NAME.png with the step's program, and prints how.
picture() {
    local name=$1 step=$2
    shift 2
    echo "docs/figures/$name.png: $step $*"
    "$BUILD/bin/$step" --quiet --out "$made/$name" "$@" >"$made/said.txt"
    cp "$made/$name.png" "$figures/$name.png"
}

plot() { # plot NAME FILE: docs/figures/NAME.svg from a text of curves (tools/figures/plot.cpp says which)
    echo "docs/figures/$1.svg: from $(basename "$2")"
    "$BUILD/bin/plot" "$2" "$figures/$1.svg"
}
