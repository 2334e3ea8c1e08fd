// Facts about the place where the first NaN arose, which is found in the stacks that nan_trap.h prints.
#include "tools/tutor/toolchain.h"

#include <doctest/doctest.h>

using namespace rt::tutor;

namespace {

const std::string handler =
    "    #0 0x7fa1 in __sanitizer_print_stack_trace ../asan_stack.cpp:87\n"
    "    #1 0x563a in rt::nan_trap::show(int, siginfo_t*, void*) /a/tools/tutor/nan_trap.h:24\n"
    "    #2 0x7fa1  (/lib/x86_64-linux-gnu/libc.so.6+0x3c04f)\n";
const std::string library =
    "    #3 0x563a in glm::normalize<3>(glm::vec<3> const&) /usr/include/glm/func.inl:88\n";
const std::string reference =
    "    #4 0x563a in rt::radiance(rt::Scene const&) steps/03_mirror/radiance.h:20\n";
const std::string learner =
    "    #4 0x563a in rt::reflect(rt::vec3, rt::vec3) workshop/03_mirror/mirror.h:34:12\n";
const std::string check =
    "    #5 0x563a in DOCTEST_ANON_FUNC_2() /a/raysteps/tests/03_mirror/mirror.cpp:30\n";

} // namespace

TEST_CASE("a NaN that arises in a learner's function is told with its place") {
    CHECK(first_nan(handler + library + learner + check) == "in reflect (workshop/03_mirror/mirror.h:34)");
    CHECK(first_nan(handler + learner + check) == "in reflect (workshop/03_mirror/mirror.h:34)");
    CHECK(first_nan("case\tx\n" + handler + check + "\n" + handler + learner + check) ==
          "in reflect (workshop/03_mirror/mirror.h:34)");
}

TEST_CASE("a NaN that arises in the reference or in a check is nobody's") {
    CHECK(first_nan(handler + library + reference + learner + check).empty());
    CHECK(first_nan(handler + library + check).empty());
    CHECK(first_nan("").empty());
}
