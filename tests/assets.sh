#!/usr/bin/env bash
# Regenerates the committed assets and compares: meshes byte by byte, pictures by pixels (PNG compression may differ).
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
    echo "$name differs from the output of make_assets: regenerate it, or fix make_assets"
    bad=1
done
exit $bad
