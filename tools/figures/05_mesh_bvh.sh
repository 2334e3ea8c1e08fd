# Makes the rendered pictures of chapter 05: surfaces crossed, normals, and the map of the work that
# a ray does (an SVG: boxes and triangles tested, tile by tile, as the step's program counts them).
# shellcheck shell=bash
# shellcheck source=tools/figures/common.sh
source "$ROOT/tools/figures/common.sh"

picture 05_hits 05_mesh_bvh --view hits --width 480 --height 300 --samples 4
picture 05_normals 05_mesh_bvh --view normal --width 480 --height 300 --samples 4

# The work: the teapot alone, 640 x 400, one ray a pixel, tiles of 10 x 10 pixels; the stronger the colour, the more.
tile=10 width=640 height=400
for ((y = 0; y < height; y += tile)); do
    for ((x = 0; x < width; x += tile)); do
        "$BUILD/bin/05_mesh_bvh" --mesh "$ROOT/assets/teapot.obj" --bare --view depth --samples 1 --threads 1 \
            --width $width --height $height --crop "$x,$y,$((x + tile)),$((y + tile))" --out "$made/05_tile.png" |
            awk -v x="$x" -v y="$y" '/^box tests a ray/ { print x, y, $5 + $10 }' # the comma stays out of the sum
    done
done >"$made/05_work.txt"
awk -v tile=$tile -v width=$width -v height=$height '
    { x[NR] = $1; y[NR] = $2; work[NR] = $3; if ($3 > most) most = $3 }
    END {
        printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" role=\"img\">", width, height + 48
        print "<title>Boxes and triangles tested a ray</title>"
        print "<style>text{font:16px system-ui,sans-serif;fill:var(--ink)} :root{--ink:#1f2328;--soft:#656d76;" \
            "--ray:#c2410c} @media (prefers-color-scheme:dark){:root{--ink:#e6edf3;--soft:#9198a1;--ray:#fb923c}}" \
            " rect{fill:var(--ray)} .frame{fill:none;stroke:var(--soft)}</style>"
        for (i = 1; i <= NR; ++i)
            if (work[i] > 1.05) # the box of the root is all that the others ask
                printf "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" opacity=\"%.2f\"/>\n", x[i], y[i], tile, tile,
                    work[i] / most
        printf "<rect class=\"frame\" x=\".5\" y=\".5\" width=\"%d\" height=\"%d\"/>\n", width - 1, height - 1
        for (k = 0; k <= 4; ++k) {
            left = 20 + 140 * k
            printf "<rect x=\"%d\" y=\"%d\" width=\"22\" height=\"22\" opacity=\"%.2f\"/>", left, height + 16, k / 4
            printf "<text x=\"%d\" y=\"%d\">%.0f</text>\n", left + 30, height + 33, k / 4 * most
        }
        print "</svg>"
    }' "$made/05_work.txt" >"$figures/05_work.svg"
echo "docs/figures/05_work.svg: from $(wc -l <"$made/05_work.txt") runs of 05_mesh_bvh"
