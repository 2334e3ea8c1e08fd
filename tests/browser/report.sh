#!/usr/bin/env bash
# The report in a real browser: writes reports of each kind, then clicks, drags, zooms and types in them.
# report.sh TEST_TUTOR FOLDER: exit 0 all is well, 1 something is wrong, 77 there is no browser to try it in.
set -eu

here=$(cd "$(dirname "$0")" && pwd)
skip() {
    echo "[skipped] $1"
    exit 77
}
command -v node >/dev/null || skip "no node"
CHROMIUM=$(command -v chromium || command -v chromium-browser || command -v google-chrome) || skip "no chromium"
[ -d "$here/node_modules/playwright-core" ] || skip "no playwright-core (npm install --prefix tests/browser)"
"$1" --test-case="reports of each kind are written*" --minimal
CHROMIUM=$CHROMIUM node "$here/report.mjs" "$2"
