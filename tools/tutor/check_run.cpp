// Runs the executable again from the check behind the one that broke it off.
#include "tools/tutor/check_run.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/build_lock.h"
#include "tools/tutor/process.h"

#include <csignal>

namespace rt {

namespace {

std::string reason(const Ended& ended, int seconds) {
    if (ended.too_long)
        return "stopped after " + std::to_string(seconds) +
               " s: it does not end (a loop or a recursion without end?)";
    switch (ended.code - 128) {
    case SIGSEGV:
        return "crashed: memory that is not its own (an index out of range, or a recursion without end)";
    case SIGABRT: return "aborted: something inside found a rule broken";
    case SIGFPE: return "crashed: a division of an integer by zero";
    case SIGILL: return "crashed: it came to code that must not be reached (a function without return?)";
    case SIGBUS: return "crashed: memory that is not there";
    default: return "ended with code " + std::to_string(ended.code) + " in the middle of it";
    }
}

CheckResult not_run() {
    CheckResult rest;
    rest.name = "all checks after that one";
    rest.failures = {
        {"", "", "not run, since " + std::to_string(most_endless) + " before them did not end", {}}};
    return rest;
}

} // namespace

std::vector<CheckResult> run_all_checks(const std::filesystem::path& program,
                                        const std::filesystem::path& said, int seconds) {
    const RunLimits limits{.seconds = seconds, .memory = std::uint64_t(8) << 30};
    std::vector<CheckResult> all;
    await_program(program);
    for (int endless = 0;;) {
        const Ended ended =
            run_process({program.string(), "--reporters=lines", "--first=" + std::to_string(all.size() + 1)},
                        said, limits);
        std::vector<CheckResult> some = parse_results(read_file(said.string()));
        const bool broken_off = !some.empty() && some.back().state == CheckState::unfinished;
        if (broken_off) {
            some.back().failures = {{program.filename().string(), "", reason(ended, seconds), {}}};
            if (ended.too_long) some.back().state = CheckState::endless;
        }
        all.insert(all.end(), some.begin(), some.end());
        if (!broken_off) break;
        if (ended.too_long && ++endless == most_endless) {
            all.push_back(not_run());
            break;
        }
    }
    if (all.empty()) throw Error(program.string() + " ran no check: build it anew");
    return all;
}

} // namespace rt
