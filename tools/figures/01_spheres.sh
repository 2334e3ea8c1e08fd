# Renders the pictures of docs/01_spheres.md: the normals, and a wide field of view from close by.
# shellcheck shell=bash
source "$ROOT/tools/figures/common.sh"

picture 01_normals 01_spheres --view normal --width 480 --height 300
picture 01_wide 01_spheres --from 0.3,1.1,2.6 --fov 100 --width 480 --height 300
