# Renders the pictures of docs/04_refraction.md: the same view with a depth of 1, 2, 4 and 10 interfaces.
# shellcheck shell=bash
source "$ROOT/tools/figures/common.sh"

picture 04_depth_1 04_refraction --depth 1 --width 480 --height 300 --samples 4
picture 04_depth_2 04_refraction --depth 2 --width 480 --height 300 --samples 4
picture 04_depth_4 04_refraction --depth 4 --width 480 --height 300 --samples 4
picture 04_depth_10 04_refraction --depth 10 --width 480 --height 300 --samples 4
