# Functions shared by the scripts of the chapters. ./learn figures runs them with ROOT and BUILD set.
# shellcheck shell=bash
set -euo pipefail

figures=$ROOT/docs/figures
made=$BUILD/figures # intermediate files
mkdir -p "$figures" "$made"

# picture NAME STEP FLAGS...: renders docs/figures/NAME.png with the step's program, and prints the command.
picture() {
    local name=$1 step=$2
    shift 2
    echo "docs/figures/$name.png: $step $*"
    "$BUILD/bin/$step" --quiet --out "$made/$name" "$@" >"$made/said.txt"
    cp "$made/$name.png" "$figures/$name.png"
}

# plot NAME: draws docs/figures/NAME.svg from docs/figures/NAME.txt (tools/figures/plot.gp
# describes its format).
plot() {
    echo "docs/figures/$1.svg: from $1.txt"
    command -v gnuplot >/dev/null || {
        echo "figures: gnuplot is needed for the plots; on Debian: apt-get install gnuplot-nox" >&2
        exit 1
    }
    (cd "$figures" && gnuplot -c "$ROOT/tools/figures/plot.gp" "$1.txt" "$1.svg")
}
