#!/usr/bin/env bash
# Checks that vcpkg.json, CITATION.cff, the newest entry of CHANGELOG.md, and --version of ./learn and of the given
# programs state the version of CMakeLists.txt. version.sh ROOT PROGRAM ...
set -u

cd "$1" || exit 2
shift
version=$(sed -n 's/^project(raysteps VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
bad=0

expect() { # $1: where, $2: the version there
    [ "$2" = "$version" ] && return
    echo "$1 says '$2', CMakeLists.txt '$version': state the same version in both"
    bad=1
}

expect vcpkg.json "$(sed -n 's/^ *"version": "\(.*\)",$/\1/p' vcpkg.json)"
expect CITATION.cff "$(sed -n 's/^version: *//p' CITATION.cff)"
expect CHANGELOG.md "$(sed -n 's/^## \([0-9][0-9.]*\).*/\1/p' CHANGELOG.md | head -n 1)"
for program in ./learn "$@"; do
    expect "$program --version" "$("$program" --version | sed 's/^Raysteps //')"
done
[ -n "$version" ] && exit $bad
echo "CMakeLists.txt states no version: project(raysteps VERSION 1.0.0 ...)"
exit 1
