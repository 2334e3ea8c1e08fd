// Facts about ./learn watch: it restores the terminal, and files may disappear for a moment.
#include "tests/tutor/folder.h"
#include "tests/posix.h"
#include "tools/tutor/commands.h"

#include <doctest/doctest.h>

#include <chrono>
#include <cstdlib>
#include <thread>

#if !defined(_WIN32) // for lack of pseudo-terminals and signals

using namespace rt;
using namespace rt::tutor;

namespace {

/// A process that watches step 01 of a small project without a build: each check reports that and ends.
class Watched {
  public:
    Watched() {
        grantpt(master);
        unlockpt(master);
        const std::string name = ptsname(master);
        terminal = open(name.c_str(), O_RDWR | O_NOCTTY);
        put(small.own("01_one/shape.h"), "x");
        child = fork();
        if (child == 0) watch_at(name);
    }
    ~Watched() {
        kill(child, SIGKILL);
        waitpid(child, nullptr, WNOHANG);
        close(terminal);
        close(master);
    }
    Watched(const Watched&) = delete;
    Watched& operator=(const Watched&) = delete;

    bool hands_over_keys() const {
        termios now{};
        tcgetattr(terminal, &now);
        return (now.c_lflag & tcflag_t(ICANON | ECHO)) == 0;
    }
    void type(char key) const { REQUIRE(write(master, &key, 1) == 1); }

    /// Returns how the process ended or stopped; 0 if it has not within ten seconds.
    int status() const {
        int status = 0;
        wait_until([&] { return waitpid(child, &status, WNOHANG | WUNTRACED) == child; });
        return status;
    }

    template <typename Condition>
    static bool wait_until(const Condition& condition) {
        for (int i = 0; i < 500; ++i) {
            if (condition()) return true;
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
        return false;
    }
    bool begins() const {
        return wait_until([&] { return hands_over_keys(); });
    }

    const SmallProject small;
    pid_t child = 0;

  private:
    [[noreturn]] void watch_at(const std::string& name) const {
        setsid();
        const int own = open(name.c_str(), O_RDWR);
        ioctl(own, TIOCSCTTY, 0);
        dup2(own, 0);
        std::ostringstream said;
        _exit(watch_step(small.project, {"01_one", small.root / "no build", false}, said));
    }

    int master = posix_openpt(O_RDWR | O_NOCTTY), terminal = -1;
};

} // namespace

TEST_CASE("the terminal is restored whatever ends a watch") {
    constexpr char ctrl_c = 3;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
        CAPTURE(signal);
        const Watched watched;
        REQUIRE(watched.begins());
        if (signal == SIGINT)
            watched.type(ctrl_c);
        else
            kill(watched.child, signal);
        const int status = watched.status();
        CHECK(WIFSIGNALED(status));
        CHECK(WTERMSIG(status) == signal);
        CHECK_FALSE(watched.hands_over_keys());
    }
    const Watched watched;
    REQUIRE(watched.begins());
    watched.type('q');
    CHECK(WIFEXITED(watched.status()));
    CHECK_FALSE(watched.hands_over_keys());
}

TEST_CASE("a watch that is stopped restores the terminal and takes it again when it continues") {
    const Watched watched;
    REQUIRE(watched.begins());
    kill(watched.child, SIGTSTP);
    CHECK(WIFSTOPPED(watched.status()));
    CHECK_FALSE(watched.hands_over_keys());
    kill(watched.child, SIGCONT);
    CHECK(watched.begins());
}

TEST_CASE("a watch continues while files disappear for a moment") {
    const Watched watched;
    REQUIRE(watched.begins());
    const auto file = watched.small.own("01_one/shape.h");
    for (int i = 0; i < 3000; ++i) {
        std::filesystem::remove(file);
        put(file, "x");
        if (i % 100 == 0) std::filesystem::remove_all(file.parent_path());
    }
    watched.type('q');
    const int status = watched.status();
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 1); // of the check, which has no build
}
#endif
