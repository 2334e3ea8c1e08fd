// ./learn watch: checks a step again at each save.
// Polls the learner's files five times per second, which is cheap and works on every file system.
#include "tools/tutor/commands.h"

#include "common/util/report_error.h"
#include "tools/tutor/system.h"

#include <chrono>
#include <exception>
#include <optional>

namespace rt::tutor {

namespace {

int check_once(const Project& project, const CheckOptions& options, std::ostream& out) {
    const auto begin = std::chrono::steady_clock::now();
    int code = 1;
    try {
        code = check_step(project, options, out);
    } catch (const std::exception& problem) { // a file may be missing for a moment while an editor saves it
        out << printable(problem.what()) << "\n";
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    out << "\n" << int(took.count() * 10) / 10.0 << " s; waiting for the next save (q quits)\n" << std::flush;
    return code;
}

/// Returns the fingerprint of the learner's files; nothing if a file is just being replaced.
std::optional<std::string> fingerprint_now(const Project& project, const std::string& step) {
    try {
        return fingerprint(project, step);
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

} // namespace

int watch_step(const Project& project, const CheckOptions& options, std::ostream& out) {
    const Keys keys;
    std::string seen;
    for (int code = 0;;) {
        const auto now = fingerprint_now(project, options.step);
        if (now && *now != seen) {
            if (is_terminal(1)) out << "\x1b[2J\x1b[H";
            code = check_once(project, options, out);
            seen = *now;
        }
        const auto key = keys.next(200);
        if (key == 'q' || key == 'Q') return code;
    }
}

} // namespace rt::tutor
