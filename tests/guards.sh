#!/usr/bin/env bash
# Checks the rules of the folders by reading the #include lines. Exits with 1 and prints one line per violation.
# guards.sh [FOLDER] checks a copy of the project; guards.sh --self-test plants violations and expects a report of each.
set -u

project=$(cd "$(dirname "$0")/.." && pwd)
rooms="common accel steps assets tests tools site"

# Prints the include lines of the files in $1 as "file:line:<header>" or "file:line:"header"".
includes() {
    find "$1" -type f \( -name '*.h' -o -name '*.cpp' \) -exec \
        grep -nHE '^[[:space:]]*#[[:space:]]*include' {} + 2>/dev/null |
        sed -E 's/^(.*:[0-9]+):[[:space:]]*#[[:space:]]*include[[:space:]]*([<"][^>"]*[>"]).*/\1:\2/'
}

report() { # $1: the rule; stdin: the lines that break it
    sed "s|^|$1: |"
}

# 1: a step includes only common, accel, itself and earlier steps.
guard_order() {
    includes steps | awk -F'"' '
        NF < 3 || $2 ~ /^(common|accel)\// { next }
        $2 ~ /^[0-9][0-9]_[^\/]*\// && substr($2, 1, 2) <= substr($1, 7, 2) { next } # $1 is steps/03_mirror/...
        { print }' | report "a step includes only common, accel, itself and earlier steps"
}

# 2: common includes only common.
guard_common() {
    includes common | grep '"' | grep -v ':"common/' | report "common includes nothing but common"
}

# 2a: accel includes common and accel, but not its own benchmark, which may also use the frame of the other benchmarks.
guard_accel() {
    includes accel | grep '"' | grep -v '^accel/bench/' | grep -vE ':"(common|accel)/' |
        report "accel includes nothing but common and accel"
    includes accel | grep ':"accel/bench/' | grep -v '^accel/bench/' | report "accel does not include its benchmark"
    includes accel | grep '"' | grep '^accel/bench/' | grep -vE ':"(common|accel|tools/bench)/' |
        report "accel/bench includes nothing but common, accel and tools/bench"
}

# 2b: the folders of common are ordered: each includes only itself and folders to its left.
guard_rooms() {
    includes common | awk -F'"' '
        BEGIN { split("util math image model render cli", names, " "); for (i in names) level[names[i]] = i }
        { split($1, from, "/"); split($2, to, "/") }
        $2 !~ /^common\/.*\// || !(from[2] in level) || from[2] == to[2] || level[to[2]] < level[from[2]] { next }
        { print }' | report "a folder of common includes only those before it: util math image model render cli"
}

# 2c: lesson headers do not depend on the command line: options and scenes of the
# programs are in steps/NN_name/program/.
guard_lessons() {
    includes steps | grep -v -e '^steps/[^/]*/main.cpp:' -e '^steps/[^/]*/program/' |
        grep -E '"([0-9][0-9]_[a-z_]*/program/|common/cli/)' |
        report "a lesson header includes no program/ and no command line"
}

# 2d: the web edition stands around the programs: nothing includes it, and nothing in a step knows of it.
guard_site() {
    local room
    for room in $rooms; do
        [ "$room" = site ] || includes "$room"
    done | grep -F ':"site/' | report "nothing outside site includes site"
    grep -rn --include='*.h' --include='*.cpp' '__wasm' steps | report "a step knows nothing of the web edition"
}

# 3: steps are pure computation: no threads, files or streams.
guard_pure() {
    local forbidden="thread|jthread|stop_token|atomic|mutex|shared_mutex|condition_variable|future|semaphore|latch|barrier"
    forbidden="$forbidden|fstream|iostream|istream|ostream|sstream|iosfwd|syncstream|streambuf|print|filesystem|cstdio|csignal"
    includes steps | grep -E ":<($forbidden)>" |
        report "a step uses no threads, files or streams"
    # Headers of the standard library contain neither a slash nor a dot.
    includes steps | grep ':<' | grep -vE ':<([a-z_0-9]+|glm/[^>]*)>$' |
        report "a step includes no foreign header but glm's"
}

# 4: includes are rooted: they contain the folder.
guard_rooted() {
    local room
    for room in $rooms; do
        includes "$room"
    done | grep '"' | grep -vE ':"([0-9][0-9]_[a-z_]+|common|accel|assets|tests|tools|site)/[^"]*"$' |
        report "an include names its folder, as in \"03_mirror/mirror.h\""
    for room in $rooms; do
        includes "$room"
    done | grep -F '../' | report "an include has no .. in it"
}

# 5: each file says in its first line what it is for; each header has #pragma once.
guard_opening() {
    local existing=() room
    for room in $rooms; do
        [ -d "$room" ] && existing+=("$room")
    done
    {
        find "${existing[@]}" -type f \( -name '*.h' -o -name '*.cpp' \) -size 0
        find "${existing[@]}" -type f \( -name '*.h' -o -name '*.cpp' \) -exec \
            awk 'FNR == 1 && !/^\/\/ .*[A-Za-z]/ { print FILENAME }' {} +
    } | report "a file's first line says what it is for (// ...)"
    find "${existing[@]}" -type f -name '*.h' -exec grep -L '^#pragma once' {} + | report "a header says #pragma once"
}

# 6: text reaches a terminal only through common/util/report_error.h.
guard_printable() {
    local program
    for program in common accel assets tools; do
        [ -d "$program" ] && grep -rnE --include='*.h' --include='*.cpp' \
            'std::cerr|std::clog|std::fputs|fprintf *\( *stderr|"wrote "' "$program"
    done | grep -v -e '^common/util/report_error.cpp:' -e 'printable(' |
        report "text goes to stderr, and names of files to stdout, through printable() of common/util/report_error.h"
}

# 7: the system is asked in one place: system_posix.cpp and system_windows.cpp, of common and of the tutor.
guard_system() {
    local headers='unistd|sys/[a-z_]*|termios|poll|fcntl|sched|malloc|dlfcn|pthread|spawn|windows|shellapi|io|conio|direct|process'
    local room
    for room in $rooms; do
        includes "$room"
    done | grep -E ":<($headers)\.h>$" |
        grep -vE '^((common/util|tools/tutor)/system_(posix|windows)\.cpp|tests/posix\.h):' |
        report "only common/util/system_*.cpp, tools/tutor/system_*.cpp and tests/posix.h include the system's headers"
}

# 8: the text of a path is UTF-8 on every system: through path_of() and text_of() of common/util/paths.h. The compiler
# also turns text into a path unasked; that is found only where it is written out.
guard_paths() {
    local existing=() room
    for room in $rooms; do
        [ -d "$room" ] && existing+=("$room")
    done
    {
        grep -rnE --include='*.h' --include='*.cpp' '\.(generic_)?string\(\)' "${existing[@]}"
        grep -rnE --include='*.h' --include='*.cpp' '(fs|filesystem)::path[({][^")}]' "${existing[@]}" | grep -v '^tests/'
    } | grep -v '^common/util/paths.h:' | report "text becomes a path by path_of(), and a path text by text_of()"
}

check() { # $1: the folder
    cd "$1" || exit 2
    local found
    found=$(guard_order; guard_common; guard_accel; guard_rooms; guard_lessons; guard_site; guard_pure; guard_rooted; guard_opening; guard_printable; guard_system; guard_paths)
    [ -z "$found" ] && return 0
    printf '%s\n' "$found"
    return 1
}

# Plants one file in a copy of the project and expects the guards to report it with the given rule.
plant() { # $1: the expected rule, $2: the file, $3: its content
    mkdir -p "$copy/$(dirname "$2")"
    printf '%b' "$3" >"$copy/$2"
    local said
    said=$(check "$copy")
    rm "$copy/$2"
    case $said in
        *"$1"*"$2"*) echo "reported: $2: $1" ;;
        *)
            echo "NOT REPORTED: $2: $1 (the guards said: ${said:-nothing})"
            missed=1
            ;;
    esac
}

self_test() {
    copy=$(mktemp -d)
    trap 'rm -rf "$copy"' EXIT
    missed=0
    local ok='// A planted file.\n#pragma once\n' header
    # A blameless file in each room is not reported, so that what is planted next is the only violation.
    mkdir -p "$copy/steps/03_mirror" "$copy/common" "$copy/accel/bench" "$copy/tests" "$copy/assets" "$copy/tools" "$copy/site"
    printf '%b' "$ok#include \"01_spheres/ray.h\"\n#include \"03_mirror/b.h\"\n#include \"common/math/vec.h\"\n#include \"accel/a.h\"\n#include <cmath>\n#include <glm/glm.hpp>\n" \
        >"$copy/steps/03_mirror/a.h"
    printf '%b' "$ok#include \"common/math/vec.h\"\n#include <thread>\n" >"$copy/common/a.h"
    printf '%b' "$ok#include \"common/math/vec.h\"\n#include <immintrin.h>\n" >"$copy/accel/a.h"
    printf '%b' "$ok#include \"accel/a.h\"\n#include \"tools/bench/numbers.h\"\n" >"$copy/accel/bench/a.h"
    printf '%b' "$ok#include \"03_mirror/a.h\"\n#include <doctest/doctest.h>\n" >"$copy/tests/a.h"
    local blameless
    blameless=$(check "$copy") || { echo "WRONGLY REPORTED: $blameless"; missed=1; }

    local order="a step includes only common, accel"
    plant "$order" steps/03_mirror/later.h "$ok#include \"04_refraction/dielectric.h\"\n"
    plant "$order" steps/03_mirror/main.cpp "// A planted file.\n  #  include \"08_indirect/hemisphere.h\"\n"
    plant "$order" steps/03_mirror/other.h "$ok#include \"assets/mesh.h\"\n"
    plant "common includes nothing but common" common/step.h "$ok#include \"01_spheres/ray.h\"\n"
    plant "common includes nothing but common" common/image/tests.cpp "// A planted file.\n#include \"tests/check.h\"\n"
    plant "common includes nothing but common" common/math/tree.h "$ok#include \"accel/accel.h\"\n"
    plant "accel includes nothing but common and accel" accel/step.h "$ok#include \"01_spheres/ray.h\"\n"
    plant "accel includes nothing but common and accel" accel/mesh.cpp "// A planted file.\n#include \"assets/mesh.h\"\n"
    plant "accel includes nothing but common and accel" accel/clock.h "$ok#include \"tools/bench/numbers.h\"\n"
    plant "accel does not include its benchmark" accel/scene.h "$ok#include \"accel/bench/scenes.h\"\n"
    plant "accel/bench includes nothing but" accel/bench/step.h "$ok#include \"01_spheres/ray.h\"\n"
    plant "a folder of common includes only" common/render/option.h "$ok#include \"common/cli/options.h\"\n"
    plant "a folder of common includes only" common/util/up.h "$ok#include \"common/image/image.h\"\n"
    plant "a lesson header includes no program/" steps/03_mirror/cli.h "$ok#include \"common/cli/options.h\"\n"
    plant "a lesson header includes no program/" steps/03_mirror/scenes.h "$ok#include \"01_spheres/program/options.h\"\n"
    for header in thread atomic mutex fstream iostream sstream filesystem cstdio future; do
        plant "a step uses no threads" "steps/03_mirror/$header.h" "$ok#include <$header>\n"
    done
    for header in stb_image.h CLI/CLI.hpp stdio.h unistd.h; do
        plant "no foreign header but glm's" "steps/03_mirror/foreign.h" "$ok#include <$header>\n"
    done
    plant "an include names its folder" steps/03_mirror/bare.h "$ok#include \"mirror.h\"\n"
    plant "an include names its folder" tests/bare.cpp "// A planted file.\n#include \"check.h\"\n"
    plant "an include names its folder" common/steps.h "$ok#include \"steps/03_mirror/mirror.h\"\n"
    plant "no .. in it" tools/up.cpp "// A planted file.\n#include \"common/../common/math/vec.h\"\n"
    plant "an include names its folder" accel/bare.h "$ok#include \"simd.h\"\n"
    plant "says #pragma once" accel/twice.h "// A planted file.\nint x;\n"
    plant "first line says what it is for" assets/silent.cpp "#include <cmath>\n"
    plant "nothing outside site includes site" tools/twin.h "$ok#include \"site/twins/page.h\"\n"
    plant "a step knows nothing of the web edition" steps/03_mirror/web.h "$ok#ifdef __wasm__\n#endif\n"
    plant "first line says what it is for" common/empty.cpp ""
    plant "says #pragma once" common/twice.h "// A planted file.\nint x;\n"
    plant "through printable()" tools/loud.cpp "// A planted file.\nvoid f() { std::cerr << \"x\"; }\n"
    plant "through printable()" common/loud.cpp "// A planted file.\nvoid f() { std::cout << \"wrote \" << path; }\n"
    plant "through printable()" assets/loud.cpp "// A planted file.\nvoid f() { std::fprintf(stderr, text); }\n"
    for header in unistd.h sys/wait.h termios.h windows.h io.h; do
        plant "include the system's headers" tools/tutor/own.cpp "// A planted file.\n#include <$header>\n"
    done
    plant "include the system's headers" tests/own.cpp "// A planted file.\n#include <poll.h>\n"
    plant "include the system's headers" common/util/own.cpp "// A planted file.\n# include <fcntl.h>\n"
    plant "text becomes a path by path_of()" common/own.cpp "// A planted file.\nauto f(auto p) { return p.string(); }\n"
    plant "text becomes a path by path_of()" tools/own.cpp "// A planted file.\nauto p = std::filesystem::path(text);\n"
    [ "$missed" = 0 ]
}

case ${1-} in
    --self-test) self_test ;;
    *) check "${1:-$project}" && echo "the folders keep their rules" ;;
esac
