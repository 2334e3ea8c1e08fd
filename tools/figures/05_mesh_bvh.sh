# Renders the pictures of docs/05_mesh_bvh.md.
# They show depth complexity, normals, traversal cost, and shading at the terminator of coarse
# and fine spheres.
# shellcheck shell=bash
# shellcheck source=tools/figures/common.sh
source "$ROOT/tools/figures/common.sh"

picture 05_hits 05_mesh_bvh --view hits --width 480 --height 300 --samples 4
picture 05_normals 05_mesh_bvh --view normal --width 480 --height 300 --samples 4
picture 05_work_bvh 05_mesh_bvh --view work --accel bvh --width 480 --height 300 --samples 1
picture 05_work_wide 05_mesh_bvh --view work --accel wide --width 480 --height 300 --samples 1

# ball ROWS COLUMNS: prints the OBJ of a sphere of radius 1, without normals, with this many faces from pole
# to pole and around the axis.
ball() {
    awk -v rows="$1" -v columns="$2" 'BEGIN {
        pi = atan2(0, -1)
        for (i = 0; i <= rows; ++i)
            for (j = 0; j < columns; ++j) {
                r = sin(pi * i / rows)
                printf "v %.7f %.7f %.7f\n", r * sin(2 * pi * j / columns), cos(pi * i / rows), r * cos(2 * pi * j / columns)
            }
        for (i = 0; i < rows; ++i)
            for (j = 0; j < columns; ++j) {
                a = i * columns + j + 1
                b = i * columns + (j + 1) % columns + 1
                print "f", a, a + columns, (i < rows - 1 ? b + columns : ""), (i > 0 ? b : "")
            }
    }'
}

ball 8 12 >"$made/ball_coarse.obj"
ball 64 96 >"$made/ball_fine.obj"
for kind in coarse fine; do
    picture "05_terminator_$kind" 05_mesh_bvh --mesh "$made/ball_$kind.obj" --crease 180 --from 4,0.8,2.2 --at 0,0,0 \
        --fov 32 --width 360 --height 300 --samples 16
done
