// Looks at the learner's files five times a second: that costs nothing, and works on every kind of disk.
#include "tools/tutor/watch.h"

#include "common/complain.h"
#include "common/error.h"

#include <chrono>
#include <exception>
#include <optional>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace rt {

namespace {

/// A terminal that hands over each key at once, for as long as this lives.
class Keys {
  public:
    Keys() {
        if (isatty(0) != 1 || tcgetattr(0, &before) != 0) return;
        termios now = before;
        now.c_lflag &= ~tcflag_t(ICANON | ECHO);
        changed = tcsetattr(0, TCSANOW, &now) == 0;
    }
    ~Keys() {
        if (changed) tcsetattr(0, TCSANOW, &before);
    }
    Keys(const Keys&) = delete;
    Keys& operator=(const Keys&) = delete;

    /// The next key within so many milliseconds; 'q' where nobody can type any more.
    std::optional<char> next(int milliseconds) const {
        pollfd input{0, POLLIN, 0};
        if (poll(&input, 1, milliseconds) <= 0) return std::nullopt;
        char key = 0;
        return read(0, &key, 1) == 1 ? key : 'q';
    }

  private:
    termios before{};
    bool changed = false;
};

int check_once(const Project& project, const CheckWish& wish, std::ostream& out) {
    const auto begin = std::chrono::steady_clock::now();
    int code = 1;
    try {
        code = check_step(project, wish, out);
    } catch (const Error& problem) { // while someone types, a file may be missing for a moment
        out << printable(problem.what()) << "\n";
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    out << "\n" << int(took.count() * 10) / 10.0 << " s; waiting for the next save (q ends)\n" << std::flush;
    return code;
}

} // namespace

int watch_step(const Project& project, const CheckWish& wish, std::ostream& out) {
    const Keys keys;
    std::string seen;
    for (int code = 0;;) {
        const std::string now = fingerprint(project, wish.step);
        if (now != seen) {
            if (isatty(1) == 1) out << "\x1b[2J\x1b[H";
            code = check_once(project, wish, out);
            seen = now;
        }
        const auto key = keys.next(200);
        if (key == 'q' || key == 'Q') return code;
    }
}

} // namespace rt
