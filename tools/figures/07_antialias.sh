# Creates the figures of docs/07_antialias.md.
# They show one sample at the centre of each pixel, the variance, a lens focused on the far lamps, and a plot of the
# error against samples for the three samplers.
# shellcheck shell=bash
source "$ROOT/tools/figures/common.sh"

picture 07_middle 07_antialias --samples 1 --filter-width 0 --aperture 0 --width 480 --height 300
picture 07_focus 07_antialias --focus 20 --samples 256 --width 480 --height 300

# Four random samples per pixel, with the variance of their mean beside it.
four=(--sampler random --samples 4 --width 480 --height 300)
echo "docs/figures/07_variance.png: 07_antialias ${four[*]}; left: the picture, right: the file of --variance"
"$BUILD/bin/07_antialias" --quiet "${four[@]}" --out "$made/four samples" --variance "$made/their variance.hdr"
"$BUILD/bin/contact_sheet" "$figures/07_variance.png" "$made/four samples.hdr" "$made/their variance.hdr"

# RMS error against a converged picture, for each sampler and number of samples.
small=(--quiet --width 200 --height 125)
"$BUILD/bin/07_antialias" "${small[@]}" --samples 2048 --seed 99 --out "$made/07_truth"
rmse() { # rmse NAME: prints the RMS error of that picture
    { "$BUILD/bin/compare" "$made/$1.hdr" "$made/07_truth.hdr" --json - || true; } | sed -n 's/.*"rmse": *\([-0-9.e]*\).*/\1/p' | xargs printf '%.6g'
}
{
    echo "# Measured by tools/figures/07_antialias.sh: 200 x 125 pixels of step 07 against 2048 samples per pixel."
    echo 'kind = "curves"'
    echo 'title = "Error against samples, by sampler"'
    echo 'x_label = "samples per pixel"'
    echo 'y_label = "error (RMSE of linear radiance)"'
    echo 'styles = "1 2 3"'
    # shellcheck disable=SC2016 # $data is for gnuplot
    echo '$data << END'
    for sampler in random stratified sobol; do
        [ $sampler = random ] || printf '\n\n'
        echo "\"$sampler\""
        for samples in 1 2 4 8 16 32 64 128 256; do
            "$BUILD/bin/07_antialias" "${small[@]}" --sampler $sampler --samples $samples --out "$made/07_noise" >"$made/said.txt"
            echo "$samples $(rmse 07_noise)"
        done
    done
    echo END
} >"$made/07_errors.txt"
cp "$made/07_errors.txt" "$figures/07_noise.txt"
plot 07_noise
