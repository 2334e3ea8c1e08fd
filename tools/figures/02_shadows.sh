# Renders the pictures of docs/02_shadows.md: the scene lit by each light alone, and the sky.
# shellcheck shell=bash
source "$ROOT/tools/figures/common.sh"

picture 02_warm 02_shadows --cool 0 --width 480 --height 300
picture 02_cool 02_shadows --warm 0 --width 480 --height 300
