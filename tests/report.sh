#!/usr/bin/env bash
# The report in a real browser: writes reports of each kind, then clicks, drags, zooms and types in them.
# report.sh TEST_TUTOR FOLDER: exit 0 all is well, 1 something is wrong, 77 there is no browser to try it in.
set -eu

for tool in python3 chromedriver; do
    if ! command -v "$tool" >/dev/null 2>&1; then
        echo "[skipped] no $tool"
        exit 77
    fi
done
"$1" --test-case="reports of each kind are written*" --minimal
python3 "$(dirname "$0")/report.py" "$2"
