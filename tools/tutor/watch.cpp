// Looks at the learner's files five times a second: that costs nothing, and works on every kind of disk.
#include "tools/tutor/watch.h"

#include "common/util/report_error.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <exception>
#include <optional>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace rt {

namespace {

/// How the terminal was, and how it is while somebody watches: all that a signal handler needs.
termios as_it_was, as_we_want;

void leave_terminal() {
    tcsetattr(0, TCSANOW, &as_it_was);
}

/// A signal that ends the program leaves the terminal as it was, and then does what it does.
extern "C" void end_by(int signal) {
    leave_terminal();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

/// Ctrl-Z: the shell's terminal while this program is stopped; ours again when it goes on, unless in the background.
extern "C" void stop(int) {
    leave_terminal();
    std::raise(SIGSTOP);
}
extern "C" void go_on(int) {
    const int error = errno;
    if (tcgetpgrp(0) == getpgrp()) tcsetattr(0, TCSANOW, &as_we_want);
    errno = error;
}

/// A terminal that hands over each key at once, for as long as this lives.
class Keys {
  public:
    Keys() {
        if (isatty(0) != 1 || tcgetattr(0, &as_it_was) != 0) return;
        as_we_want = as_it_was;
        as_we_want.c_lflag &= ~tcflag_t(ICANON | ECHO);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) handle(signal, end_by);
        handle(SIGTSTP, stop);
        handle(SIGCONT, go_on);
        changed = tcsetattr(0, TCSANOW, &as_we_want) == 0;
    }
    ~Keys() {
        if (!changed) return;
        for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGCONT})
            std::signal(signal, SIG_DFL);
        leave_terminal();
    }
    Keys(const Keys&) = delete;
    Keys& operator=(const Keys&) = delete;

    /// The next key within so many milliseconds; 'q' where nobody can type any more.
    std::optional<char> next(int milliseconds) const {
        pollfd input{0, POLLIN, 0};
        if (poll(&input, 1, milliseconds) <= 0) return std::nullopt;
        char key = 0;
        const auto count = read(0, &key, 1);
        if (count < 0 && errno == EINTR) return std::nullopt;
        return count == 1 ? key : 'q';
    }

  private:
    /// Leaves a signal alone that whoever started this program wants to be ignored, as nohup does.
    static void handle(int signal, void (*handler)(int)) {
        if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
    }

    bool changed = false;
};

int check_once(const Project& project, const CheckWish& wish, std::ostream& out) {
    const auto begin = std::chrono::steady_clock::now();
    int code = 1;
    try {
        code = check_step(project, wish, out);
    } catch (const std::exception& problem) { // while someone saves, a file may be missing for a moment
        out << printable(problem.what()) << "\n";
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    out << "\n" << int(took.count() * 10) / 10.0 << " s; waiting for the next save (q ends)\n" << std::flush;
    return code;
}

/// Of the learner's files; nothing while one of them is being replaced.
std::optional<std::string> fingerprint_now(const Project& project, const std::string& step) {
    try {
        return fingerprint(project, step);
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

} // namespace

int watch_step(const Project& project, const CheckWish& wish, std::ostream& out) {
    const Keys keys;
    std::string seen;
    for (int code = 0;;) {
        const auto now = fingerprint_now(project, wish.step);
        if (now && *now != seen) {
            if (isatty(1) == 1) out << "\x1b[2J\x1b[H";
            code = check_once(project, wish, out);
            seen = *now;
        }
        const auto key = keys.next(200);
        if (key == 'q' || key == 'Q') return code;
    }
}

} // namespace rt
