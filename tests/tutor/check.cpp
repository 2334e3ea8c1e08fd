// Facts about ./learn check with code that does not compile, crashes or does not terminate.
#include "tests/check.h"
#include "common/util/paths.h"
#include "common/util/error.h"
#include "tests/posix.h"
#include "tests/tutor/folder.h"
#include "tools/tutor/check_parts.h"
#include "tools/tutor/build.h"
#include "tools/tutor/system.h"
#include "tools/tutor/util.h"

#include <doctest/doctest.h>

#include <cstdlib>

using namespace rt;
using namespace rt::tutor;

namespace fs = std::filesystem;

#if !defined(_WIN32) // scripts of sh stand for programs
namespace {

/// Writes a substitute for a test executable: three checks, of which the second runs `deed`.
fs::path program(const fs::path& folder, const std::string& deed) {
    const fs::path path = folder / "test_step";
    put(path, "#!/bin/sh\n"
              "first=${2#--first=}\n"
              "ulimit -t ${3#--seconds-per-check=}\n"
              "[ $first -le 1 ] && printf 'case\\ta\\nend\\ta\\tok\\t.1\\n'\n"
              "if [ $first -le 2 ]; then printf 'case\\tb\\n'; " +
                  deed +
                  "; printf 'end\\tb\\tok\\t.1\\n'; fi\n"
                  "printf 'case\\tc\\nfail\\tx.cpp:3\\tf() == 4\\t6 == 4\\nend\\tc\\tfailed\\t.1\\n'\n");
    fs::permissions(path, fs::perms::owner_all);
    return path;
}

std::vector<CheckResult> checks_of(const std::string& deed, int seconds = 20) {
    const SmallProject small;
    return run_all_checks(program(small.root, deed), small.root / "said.txt", seconds);
}

} // namespace

TEST_CASE("checks that end are reported unchanged") {
    const auto checks = checks_of("true");
    REQUIRE(checks.size() == 3);
    CHECK(checks[0].state == CheckState::ok);
    CHECK(checks[1].state == CheckState::ok);
    CHECK(checks[2].state == CheckState::failed);
    REQUIRE(checks[2].failures.size() == 1);
    CHECK(checks[2].failures[0].values == "6 == 4");
}

TEST_CASE("a check that crashes is named, and the others still run") {
    const auto checks = checks_of("kill -SEGV $$");
    REQUIRE(checks.size() == 3);
    CHECK(checks[1].name == "b");
    CHECK(checks[1].state == CheckState::unfinished);
    REQUIRE(checks[1].failures.size() == 1);
    CHECK(checks[1].failures[0].values.find("crashed: invalid memory") != std::string::npos);
    CHECK(checks[2].state == CheckState::failed);
}

TEST_CASE("a check that does not terminate is stopped and named, and the learner waits for no other") {
    const auto checks = checks_of("while :; do :; done", 1);
    REQUIRE(checks.size() == 3);
    CHECK(checks[1].state == CheckState::endless);
    REQUIRE(checks[1].failures.size() == 1);
    CHECK(checks[1].failures[0].values.find("stopped after 1 s of processor time") != std::string::npos);
    CHECK(checks[2].failures.front().values.find("not run") != std::string::npos);
}

TEST_CASE("a check that crashes counts as crashed even if the framework ends it, and the others still run") {
    const auto checks =
        checks_of("printf 'fail\\tx.cpp:2\\tcrashed\\tSIGSEGV\\nend\\tb\\tfailed\\t.1\\n'; kill -SEGV $$");
    REQUIRE(checks.size() == 3);
    CHECK(checks[1].state == CheckState::unfinished);
    CHECK(checks[2].state == CheckState::failed);
}

TEST_CASE("a check that exits the program is named") {
    const auto checks = checks_of("exit 3");
    REQUIRE(checks.size() == 3);
    REQUIRE(checks[1].failures.size() == 1);
    CHECK(checks[1].failures[0].values.find("code 3") != std::string::npos);
}

TEST_CASE("a build locks its folder until it ends or its process ends") {
    const TemporaryFolder folder;
    const fs::path build = folder.path / "release";
    const auto is_free = [&] {
        const int other = open(folder.path.c_str(), O_RDONLY);
        const bool got = flock(other, LOCK_EX | LOCK_NB) == 0;
        close(other);
        return got;
    };
    {
        const BuildLock alone(build);
        CHECK_FALSE(is_free());
    }
    CHECK(is_free());
    const pid_t child = fork();
    if (child == 0) {
        new BuildLock(build / ""); // never released
        raise(SIGKILL);
    }
    waitpid(child, nullptr, 0);
    CHECK(is_free());
    const BuildLock nowhere("/nowhere/at/all"); // no lock, but no error either
}
#endif

TEST_CASE("temporary folders are unique and are removed at the end") {
    fs::path folder;
    {
        const TemporaryFolder first, second;
        CHECK(first.path != second.path);
        put(first.path / "below/x", "x");
        folder = first.path;
    }
    CHECK_FALSE(fs::exists(folder));
    CHECK_THROWS_AS(TemporaryFolder("/nowhere/at/all"), Error);
}

#if !defined(_WIN32)
TEST_CASE("a program's output is captured, and its exit code and crash are reported") {
    std::string output;
    CHECK(run_process({"sh", "-c", "echo a; echo b >&2; exit 3"}, {.log = "/dev/null", .output = &output})
              .code == 3);
    CHECK(output == "a\n");
    CHECK(run_process({"sh", "-c", "kill -SEGV $$"}).crash.find("memory") != std::string::npos);
    CHECK(run_process({"sh", "-c", "exec sleep 20"}, {.seconds = 1}).timed_out);
    CHECK_THROWS_AS(run_process({"/nowhere/at/all"}), Error);
}

TEST_CASE("a page is opened by the first program that does that, and without one that is said") {
    const TemporaryFolder folder;
    const std::string before = std::getenv("PATH");
    const fs::path opener = folder.path / "xdg-open", opened = folder.path / "opened";
    put(opener, "#!/bin/sh\nprintf %s \"$1\" >'" + text_of(opened) + ".new'\n/bin/mv '" + text_of(opened) +
                    ".new' '" + text_of(opened) + "'\n");
    fs::permissions(opener, fs::perms::owner_all);
    put(folder.path / "empty/x", "");
    fs::create_symlink("/bin/sh", folder.path / "empty/sh");
    set_environment("PATH", text_of(folder.path) + ":" + before);
    CHECK(open_page("a page.html"));
    for (int i = 0; i < 500 && !fs::exists(opened); ++i) usleep(10'000);
    CHECK(content_of(opened) == text_of(fs::absolute("a page.html")));
    set_environment("PATH", text_of(folder.path / "empty"));
    CHECK_FALSE(open_page("a page.html"));
    set_environment("PATH", before);
}
#endif

TEST_CASE("of a compiler's many lines the first error in one of the learner's files is shown") {
    const std::string log =
        "[1/3] Building CXX object x.o\n"
        "In file included from tests/03_mirror.cpp:4:\n"
        "steps/03_mirror/radiance.h:20:14: error: no matching function\n"
        "/home/a b/workshop/03_mirror/mirror.h:23:5: error: expected ';' before 'return'\n"
        "/home/a b/workshop/03_mirror/mirror.h:30:5: error: another\n";
    const auto error = first_error(log, "/workshop/");
    REQUIRE(error);
    CHECK(error->file == "/home/a b/workshop/03_mirror/mirror.h");
    CHECK(error->line == 23);
    CHECK(error->message == "expected ';' before 'return'");
    const auto elsewhere = first_error(log, "/nowhere/");
    REQUIRE(elsewhere);
    CHECK(elsewhere->line == 20);
    CHECK(!first_error("ninja: error: loading 'build.ninja'\n", "/workshop/"));
}
