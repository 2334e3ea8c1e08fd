# Renders the pictures of docs/03_mirror.md: the same view with a depth of 0, 1, 2 and 100 mirrors.
# shellcheck shell=bash
source "$ROOT/tools/figures/common.sh"

picture 03_depth_0 03_mirror --depth 0 --width 480 --height 300
picture 03_depth_1 03_mirror --depth 1 --width 480 --height 300
picture 03_depth_2 03_mirror --depth 2 --width 480 --height 300
picture 03_depth_100 03_mirror --depth 100 --width 480 --height 300
