// Facts about what a learner is told of a compiler's output: one line, its caret, and what to do.
#include "tools/tutor/compile_help.h"

#include <doctest/doctest.h>

#include <string>

using namespace rt::tutor;

namespace {

std::string remedy(const std::string& message) {
    const auto help = compile_help("workshop/01_one/shape.h:7:5: error: " + message + "\n", "workshop/");
    return help ? help->remedy : "no error";
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("the source line and the caret below it are shown") {
    const auto help = compile_help("In file included from x.cpp:1:\n"
                                   "workshop/01_one/shape.h:7:13: error: expected ';' before '}' token\n"
                                   "    7 |     return x\n"
                                   "      |             ^\n"
                                   "      |             ;\n"
                                   "workshop/01_one/shape.h:9:1: error: another\n",
                                   "workshop/");
    REQUIRE(help);
    CHECK(help->error.line == 7);
    REQUIRE(help->source.size() == 2);
    CHECK(help->source[0] == "    7 |     return x");
    CHECK(has(help->source[1], "^"));
    CHECK(has(help->remedy, "semicolon"));
    CHECK_FALSE(compile_help("ninja: build stopped\n", "workshop/"));
}

TEST_CASE("the commonest errors of GCC and Clang have a remedy") {
    CHECK(has(remedy("no match for ‘operator*’ (operand types are ‘glm::vec<3, float>’ and ‘int’)"),
              "2.0f * v"));
    CHECK(has(remedy("no matching function for call to ‘exp(glm::vec<3, float>&)’"), "exp(v)"));
    CHECK(has(remedy("expected ‘}’ at end of input"), "closing brace"));
    CHECK(has(remedy("expected declaration before ‘}’ token"), "too many"));
    CHECK(has(remedy("‘raduis’ was not declared in this scope; did you mean ‘radius’?"), "spelled"));
    CHECK(has(remedy("use of undeclared identifier 'raduis'"), "spelled"));
    CHECK(has(remedy("use of ‘auto f()’ before deduction of ‘auto’"), "before it is declared"));
    CHECK(has(remedy("mirror.h: No such file or directory"), "03_mirror/mirror.h"));
    CHECK(has(remedy("no return statement in function returning non-void [-Werror=return-type]"), "return"));
    CHECK(has(remedy("‘t’ is used uninitialized [-Werror=uninitialized]"), "a value"));
    CHECK(
        has(remedy("suggest parentheses around assignment used as truth value [-Werror=parentheses]"), "=="));
    CHECK(has(remedy("‘const class std::optional<float>’ has no member named ‘t’"), "->"));
    CHECK(has(remedy("assignment of member ‘rt::Ray::t_max’ in read-only object"), "const"));
    CHECK(remedy("something that nobody has seen").empty());
}
