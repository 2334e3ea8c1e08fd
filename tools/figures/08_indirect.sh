# Creates the figures of docs/08_indirect.md.
# They show the room without indirect light, the furnace with depth 0 and 1, three ways to sample the light
# with equal samples, the cover, and a plot of the error against time, measured by `./learn bench convergence`.
# shellcheck shell=bash
source "$ROOT/tools/figures/common.sh"

picture 08_cover 08_indirect --scene cover --width 960 --height 540 --samples 256
picture 08_no_indirect 08_indirect --no-indirect --width 360 --height 360
for way in bounces lights mis; do
    picture 08_$way 08_indirect --direct $way --samples 8 --width 240 --height 240
done

echo "docs/figures/08_furnace.png: 08_indirect --scene furnace --width 300 --height 300 --samples 4, with --depth 0 and 1"
for depth in 0 1; do
    "$BUILD/bin/08_indirect" --quiet --scene furnace --depth $depth --width 300 --height 300 --samples 4 \
        --out "$made/depth $depth.png"
done
"$BUILD/bin/contact_sheet" "$figures/08_furnace.png" "$made/depth 0.png" "$made/depth 1.png"

# `./learn bench` builds the benchmark. Without it the plot is drawn from the existing data.
bench=$ROOT/build/bench/bin/bench_convergence
[ -x "$BUILD/bin/bench_convergence" ] && bench=$BUILD/bin/bench_convergence
flags=(--scenes room --size 64 --most 128 --truth 4096 --repeats 2)
# The relative error excludes the worst 0.1 % of the pixels; otherwise the rim of the light and rare bright
# dots would dominate.
curve() { # curve ESTIMATOR SAMPLER
    printf '"%s, %s"\n' "$1" "$2"
    tr -d '\n' <"$made/08_noise.json" | tr '{' '\n' | grep "\"$1\"" | grep "\"$2\"" |
        sed -n 's/.*"seconds": *\([-0-9.e]*\),.*"relative_mse": *\([-0-9.e]*\).*/\1 \2/p' |
        awk '{ printf "%.6g %.6g\n", $1, sqrt($2) }'
}
if [ -x "$bench" ]; then
    "$bench" "${flags[@]}" --json "$made/08_noise.json" >"$made/08_noise.md"
    {
        echo "# Measured by tools/figures/08_indirect.sh: bench_convergence ${flags[*]}"
        grep '^|' "$made/08_noise.md" | sed 's/^/# /'
        echo 'kind = "curves"'
        echo 'title = "Error against time in the room, for each way to sample light"'
        echo 'x_label = "processor seconds"'
        echo 'y_label = "relative error, without the worst 0.1 %"'
        echo 'styles = "1 11 13 15 12"'
        # shellcheck disable=SC2016 # $data is for gnuplot
        echo '$data << END'
        curve MIS sobol
        for estimator in MIS lights bounces book; do
            printf '\n\n'
            curve $estimator random
        done
        echo END
    } >"$made/08_errors.txt"
    cp "$made/08_errors.txt" "$figures/08_noise.txt"
fi
plot 08_noise
