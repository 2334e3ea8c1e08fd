// Facts about --version.
#include "common/cli/options.h"
#include "common/util/version.h"

#include <doctest/doctest.h>

#include <array>
#include <iostream>
#include <sstream>
#include <string>

TEST_CASE("--version prints the version of the project and nothing else whatever the other options") {
    for (const char* beside : {"--quiet", "--teapot"}) {
        rt::Options options("03_test", "What is asked here?", {});
        const std::array<const char*, 3> words{"03_test", beside, "--version"};
        const std::ostringstream text;
        std::streambuf* const terminal = std::cout.rdbuf(text.rdbuf());
        const bool goes_on = options.parse(int(words.size()), words.data());
        std::cout.rdbuf(terminal);
        CHECK_FALSE(goes_on);
        CHECK(text.str() == std::string(rt::version()) + "\n");
    }
}
