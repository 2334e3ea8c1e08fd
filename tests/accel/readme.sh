#!/usr/bin/env bash
# readme.sh PROJECT FOLDER COMPILER: builds the example of accel/README.md as a separate project, first from the source
# folder and then from an installation; it must print what the README shows. Exit code 77 if the system has no GLM.
set -eu
project=$1 folder=$2 compiler=$3

rm -rf "$folder"
mkdir -p "$folder/installed_example"
cd "$folder"
ln -s "$project" raysteps

block() { # prints the README's code block of language $1
    awk -v begin="\`\`\`$1" '$0 == "```" { inside = 0 } inside { print } $0 == begin { inside = 1 }' raysteps/accel/README.md
}
block cpp >main.cpp
block cmake >CMakeLists.txt
block text >expected.txt

try() { # $1: the example's folder; the rest: flags for CMake
    local source=$1
    shift
    if ! cmake -S "$source" -B "$source/build" -D CMAKE_CXX_COMPILER="$compiler" "$@" >log 2>&1; then
        grep -q 'glmConfig.cmake' log && exit 77
        cat log
        exit 1
    fi
    cmake --build "$source/build" >log 2>&1 || { cat log; exit 1; }
    "$source/build/example" | diff expected.txt - || { echo "the output differs from accel/README.md"; exit 1; }
}

try .
cmake --install build --prefix "$folder/installed" >log
cp main.cpp installed_example/
sed 's/^add_subdirectory.*/find_package(raysteps_accel REQUIRED)/' CMakeLists.txt >installed_example/CMakeLists.txt
try installed_example -D CMAKE_PREFIX_PATH="$folder/installed"
echo "the example runs, from the source folder and from the installation"
