#!/usr/bin/env bash
# Checks the report in a real browser: writes reports of each kind and runs report.mjs on them.
# report.sh TEST_TUTOR FOLDER: exit 0 all checks pass, 1 a check fails, 77 there is no browser.
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
