#!/usr/bin/env bash
# ./learn fuzz: searches for inputs that break a parser, with clang's libFuzzer. Sourced by ./learn.
# shellcheck disable=SC2154 # root, build and preset are learn's

fuzz_usage() {
    cat <<END
./learn fuzz [target] [--minutes N | --seconds N] [--seed N]

Feeds our parsers with inputs from clang's libFuzzer, under AddressSanitizer and UndefinedBehaviorSanitizer: first past
findings and seeds (tests/fuzz/findings, tests/fuzz/corpus), then new inputs, one minute per target by default, two
targets in parallel. A target stops at its first finding, which is kept in build/fuzz/found/TARGET. Exit code: 0 nothing
was found, 1 something was found, 2 the command is wrong.

targets: $(fuzz_targets)
END
}

fuzz_targets() {
    (cd "$root/tests/fuzz/corpus" && echo *)
}

# Sets $chosen, $seconds and $seed.
read_fuzz_words() {
    chosen="" seconds=60 seed=0
    while [ $# -gt 0 ]; do
        case $1 in
            -h | --help)
                fuzz_usage
                exit 0
                ;;
            --minutes | --seconds | --seed)
                case ${2-} in
                    "" | *[!0-9]* | ??????* | 0*) fail 2 "fuzz: $1 wants a whole number of at least 1, not '${2-}'" ;;
                esac
                case $1 in
                    --minutes) seconds=$((60 * $2)) ;;
                    --seconds) seconds=$2 ;;
                    --seed) seed=$2 ;;
                esac
                shift
                ;;
            -*) fail 2 "fuzz does not know '$1'; see ./learn fuzz --help" ;;
            *)
                [ -z "$chosen" ] || fail 2 "fuzz takes one target, or none for all of them"
                [[ " $(fuzz_targets) " = *" $1 "* ]] || fail 2 "there is no target '$1'; the targets are $(fuzz_targets)"
                chosen=$1
                ;;
        esac
        shift
    done
}

has_libfuzzer() {
    echo 'extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }' |
        clang++ -x c++ -fsanitize=fuzzer,address -o "$TMPDIR/has_libfuzzer" - 2>/dev/null
}

fuzz_row() { # target, executions, CPU seconds, findings
    printf '%-12s %11s %8s  %s\n' "$1" "$2" "$3" "$4"
}

# Replays known inputs, then searches. Prints a row of the table; returns 1 if there is a finding. $1: the target
fuzz_one() {
    local past=() log=$build/$1.log corpus=$build/corpus/$1 found=$build/found/$1 file bad=0 note=0
    mkdir -p "$corpus" "$found"
    for file in "$root/tests/fuzz"/{findings,corpus}/"$1"/*; do
        [ ! -f "$file" ] || past+=("$file")
    done
    if ! "$build/bin/fuzz" "--target=$1" "${past[@]}" >"$log" 2>&1; then
        fuzz_row "$1" - - "known: $(sed -n 's/^Running: //p' "$log" | tail -n 1), see $log"
        return 1
    fi
    cp "${past[@]}" "$corpus"
    TIMEFORMAT='%U %S'
    { time "$build/bin/fuzz" "--target=$1" -max_total_time="$seconds" -seed="$seed" -timeout=20 -rss_limit_mb=3000 \
        -max_len=4096 -print_final_stats=1 -artifact_prefix="$found/" "$corpus" \
        >"$log" 2>&1 || bad=1; } 2>"$log.time"
    [ $bad = 0 ] || note="$(sed -n 's/.*Test unit written to //p' "$log" | tail -n 1), see $log"
    fuzz_row "$1" "$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")" \
        "$(awk '{ printf "%.0f", $1 + $2 }' "$log.time")" "$note"
    return $bad
}

fuzz() {
    local chosen seconds seed target pids=() pid bad=0
    read_fuzz_words "$@"
    preset=fuzz
    build=$root/build/$preset
    TMPDIR=$(mktemp -d -p /dev/shm 2>/dev/null || mktemp -d) || fail 2 "cannot make a temporary folder"
    export TMPDIR
    trap 'rm -rf "$TMPDIR" ${scratch:+"$scratch"}' EXIT
    has_libfuzzer || fail 2 "fuzz needs clang++ and its libFuzzer; on Debian: apt-get install clang libclang-rt-14-dev"
    setup
    build fuzz
    fuzz_row target executions "CPU s" findings
    for target in ${chosen:-$("$build/bin/fuzz" --list)}; do
        while [ "$(jobs -rp | wc -l)" -ge 2 ]; do sleep 0.2; done
        fuzz_one "$target" &
        pids+=($!)
    done
    for pid in "${pids[@]}"; do wait "$pid" || bad=1; done
    exit $bad
}
