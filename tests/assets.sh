#!/usr/bin/env bash
# Makes the committed assets anew and compares: meshes byte by byte, pictures as pictures (another stb packs PNG otherwise).
# assets.sh MAKE_ASSETS COMPARE ASSETS OUT: exit 0 the same, 1 different.
set -eu

make_assets=$1 compare=$2 assets=$3 out=$4
rm -rf "$out"
mkdir -p "$out"
"$make_assets" all --out "$out"
bad=0
for made in "$out"/*; do
    name=$(basename "$made")
    cmp -s "$made" "$assets/$name" && continue
    case $name in
        *.png) "$compare" "$made" "$assets/$name" && continue ;;
    esac
    echo "$name is not what make_assets writes: make it anew, or mend make_assets"
    bad=1
done
exit $bad
