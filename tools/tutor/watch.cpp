// ./learn watch: checks a step again at each save, and drops a check that is still running then.
// Polls the learner's files five times per second, which is cheap and works on every file system.
#include "tools/tutor/commands.h"

#include "common/util/report_error.h"
#include "tools/tutor/system.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <optional>
#include <string>
#include <thread>

namespace rt::tutor {

namespace {

/// Returns the fingerprint of the learner's files; nothing if a file is just being replaced.
std::optional<std::string> fingerprint_now(const Project& project, const std::string& step) {
    try {
        return fingerprint(project, step);
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

/// Says whether a file is saved while it exists, from a thread of its own.
class SaveWatcher {
  public:
    SaveWatcher(const Project& project, const std::string& step, const std::string& seen)
        : thread([this, project, step, seen] {
              while (!is_over && !is_saved) {
                  std::this_thread::sleep_for(std::chrono::milliseconds(200));
                  const auto now = fingerprint_now(project, step);
                  if (now && *now != seen) is_saved = true;
              }
          }) {
        cancel_if([this] { return is_saved.load(); });
    }
    ~SaveWatcher() {
        is_over = true;
        thread.join();
        cancel_if({});
    }
    SaveWatcher(const SaveWatcher&) = delete;
    SaveWatcher& operator=(const SaveWatcher&) = delete;

  private:
    std::atomic<bool> is_over = false, is_saved = false;
    std::thread thread; // the last member: it uses the others
};

/// Returns the exit code of the check; nothing if it was dropped.
std::optional<int> check_once(const Project& project, const CheckOptions& options, const std::string& seen,
                              std::ostream& out) {
    const SaveWatcher watcher(project, options.step, seen);
    int code = 1;
    try {
        code = check_step(project, options, out);
    } catch (const Cancelled&) {
        return std::nullopt;
    } catch (const std::exception& problem) { // a file may be missing for a moment while an editor saves it
        out << printable(problem.what()) << "\n";
    }
    out << "\nwaiting for the next save (q quits)\n" << std::flush;
    return code;
}

} // namespace

int watch_step(const Project& project, const CheckOptions& options, std::ostream& out) {
    const Keys keys;
    CheckOptions next = options;
    std::string seen;
    for (int code = 0;;) {
        const auto now = fingerprint_now(project, options.step);
        if (now && *now != seen) {
            if (is_terminal(1)) out << "\x1b[2J\x1b[H";
            seen = *now;
            code = check_once(project, next, seen, out).value_or(code);
            next.open = false; // the open page loads itself again
        }
        const auto key = keys.next(200);
        if (key == 'q' || key == 'Q') return code;
    }
}

} // namespace rt::tutor
