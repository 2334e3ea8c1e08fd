# Makes the rendered pictures of chapter 06: texture coordinates, a close look at texels, and a card that repeats.
# shellcheck shell=bash
# shellcheck source=tools/figures/common.sh
source "$ROOT/tools/figures/common.sh"

picture 06_uv 06_textures --view uv --width 480 --height 300 --samples 4
picture 06_near 06_textures --from 1.94,0.545,1.6 --at 1.934,0.525,1.15 --fov 6 --width 360 --height 225 --samples 4
picture 06_tiles 06_textures --tiles 50 --samples 1 --width 480 --height 300
