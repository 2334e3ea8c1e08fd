# Makes the rendered pictures of chapter 05: surfaces crossed, normals, and the work that a ray is.
# shellcheck shell=bash
# shellcheck source=tools/figures/common.sh
source "$ROOT/tools/figures/common.sh"

picture 05_hits 05_mesh_bvh --view hits --width 480 --height 300 --samples 4
picture 05_normals 05_mesh_bvh --view normal --width 480 --height 300 --samples 4
picture 05_work_bvh 05_mesh_bvh --view work --accel bvh --width 480 --height 300 --samples 1
picture 05_work_wide 05_mesh_bvh --view work --accel wide --width 480 --height 300 --samples 1
