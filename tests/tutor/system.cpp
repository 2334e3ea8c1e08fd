// Facts about running other programs, on every system: this program plays them, as one of the roles below.
#include "common/util/error.h"
#include "tools/tutor/system.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <iostream>

using namespace rt;
using namespace rt::tutor;

TEST_CASE("role: ends with 3" * doctest::skip()) {
    std::cout << "to stdout" << std::endl;
    std::cerr << "to stderr" << std::endl;
    std::exit(3);
}

TEST_CASE("role: C:\\a folder\\ \"in quotes\\\"" * doctest::skip()) {
    std::exit(4);
}

TEST_CASE("role: reads what is not there" * doctest::skip()) {
    volatile int* const nowhere = nullptr;
    std::exit(*nowhere);
}

TEST_CASE("role: never ends" * doctest::skip()) {
    volatile bool goes_on = true;
    while (goes_on) {
    }
}

namespace {

// A sanitizer reports a crash itself, and ends the program with a code of its own.
#if defined(__has_feature)
constexpr bool is_sanitized = __has_feature(address_sanitizer);
#elif defined(__SANITIZE_ADDRESS__)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif

ProcessResult run_role(const std::string& role, ProcessOptions options = {}) {
    std::string filter = "--test-case=role: " + role;
    for (std::size_t i = 0; (i = filter.find('\\', i)) != filter.npos; i += 2)
        filter.insert(i, "\\"); // doctest's escape
    std::string ignored;
    if (!options.output) options.output = &ignored;
    options.log = "/dev/null";
    return run_process({RT_TEST_TUTOR, "--no-skip", filter}, options);
}

} // namespace

TEST_CASE("the exit code and the output of a program are returned") {
    std::string output;
    CHECK(run_role("ends with 3", {.output = &output}).code == 3);
    CHECK(output.find("to stdout") != output.npos);
    CHECK(output.find("to stderr") == output.npos);
    CHECK_THROWS_AS(run_process({"/nowhere/at/all"}), Error);
}

TEST_CASE("words with blanks and quotes and backslashes arrive as they were") {
    CHECK(run_role("C:\\a folder\\ \"in quotes\\\"").code == 4);
}

TEST_CASE("a crash is named in words" * doctest::skip(is_sanitized)) {
    const ProcessResult result = run_role("reads what is not there");
    CHECK(result.crash.find("invalid memory access") != std::string::npos);
    CHECK(result.code >= 128);
}

TEST_CASE("a program that never ends is stopped by a limit of time") {
    CHECK(run_role("never ends", {.seconds = 1}).timed_out);
}

TEST_CASE("a program that never ends is stopped by a limit of processor time") {
    CHECK(run_role("never ends", {.cpu_seconds = 1}).timed_out);
}
