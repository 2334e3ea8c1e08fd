# Renders the pictures of docs/06_textures.md.
# They show texture coordinates, a card with holes, a close-up of texels, and a repeated card.
# shellcheck shell=bash
# shellcheck source=tools/figures/common.sh
source "$ROOT/tools/figures/common.sh"

picture 06_uv 06_textures --view uv --width 480 --height 300 --samples 4
# The card in the section on holes. The chapter shows the same lines, with files in renders/.
cp "$ROOT/assets/test_card.png" "$made"
printf '%s\n' 'newmtl card' 'map_Kd test_card.png' 'map_d test_card.png' >"$made/card.mtl"
printf '%s\n' 'mtllib card.mtl' 'v -3 0 0' 'v 3 0 0' 'v 3 3 -2.6' 'v -3 3 -2.6' >"$made/card.obj"
printf '%s\n' 'vt 0 0' 'vt 1 0' 'vt 1 1' 'vt 0 1' 'usemtl card' 'f 1/1 2/2 3/3 4/4' >>"$made/card.obj"
picture 06_holes 06_textures --mesh "$made/card.obj" --width 480 --height 300

picture 06_near 06_textures --from 1.94,0.545,1.6 --at 1.934,0.525,1.15 --fov 6 --width 360 --height 225 --samples 4
picture 06_tiles 06_textures --tiles 50 --samples 1 --width 480 --height 300
