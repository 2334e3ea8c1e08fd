// Facts about differences between texts, and about the output of ./learn diff.
#include "tools/tutor/diff.h"

#include "common/util/error.h"
#include "tests/tutor/folder.h"
#include "tools/tutor/commands.h"

#include <doctest/doctest.h>

using namespace rt;
using namespace rt::tutor;

namespace {

std::string difference(const std::string& a, const std::string& b, bool colour = false) {
    return unified_diff({"a", a}, {"b", b}, colour);
}

std::string diff_of(const SmallProject& small, const std::string& file, bool colour = false) {
    return said_by([&](std::ostream& out) { show_diff(small.project, "01_one", file, colour, out); });
}

} // namespace

TEST_CASE("equal texts have no difference") {
    CHECK(difference("a\nb\n", "a\nb\n").empty());
    CHECK(difference("", "").empty());
    CHECK(difference("a", "a\n").empty()); // only lines are compared
}

TEST_CASE("a changed line is shown with three lines of context as diff -u does") {
    CHECK(difference("1\n2\n3\n4\n5\n6\n7\n8\n9\n", "1\n2\n3\n4\nfive\n6\n7\n8\n9\n") ==
          "--- a\n+++ b\n@@ -2,7 +2,7 @@\n 2\n 3\n 4\n-5\n+five\n 6\n 7\n 8\n");
    CHECK(difference("", "x") == "--- a\n+++ b\n@@ -0,0 +1 @@\n+x\n");
    CHECK(difference("x", "") == "--- a\n+++ b\n@@ -1 +0,0 @@\n-x\n");
    CHECK(difference("a\nb\nc\nd\n", "b\nx\nd\n") == "--- a\n+++ b\n@@ -1,4 +1,3 @@\n-a\n b\n-c\n+x\n d\n");
}

TEST_CASE("changes far from each other are in separate hunks") {
    std::string a, b;
    for (int i = 0; i < 30; ++i) {
        a += "f" + std::to_string(i) + "()\n";
        b += i == 2 || i == 25 ? "new\n" : "f" + std::to_string(i) + "()\n";
    }
    CHECK(difference(a, b).find("@@ -1,6 +1,6 @@\n") != std::string::npos);
    CHECK(difference(a, b).find("@@ -23,7 +23,7 @@\n") != std::string::npos);
}

TEST_CASE("colour is used only if it is requested, and no other control characters are printed") {
    CHECK(difference("x", "y").find('\x1b') == std::string::npos);
    CHECK(difference("x", "\x1b[2Jy") == "--- a\n+++ b\n@@ -1 +1 @@\n-x\n+?[2Jy\n");
    const std::string coloured = difference("x", "y", true);
    CHECK(coloured.find("\x1b[31m-x\x1b[0m\n") != std::string::npos);
    CHECK(coloured.find("\x1b[32m+y\x1b[0m\n") != std::string::npos);
}

TEST_CASE("the reference's answer equals the reference with or without markers and with Windows line ends") {
    const SmallProject small;
    put(small.own("01_one/shape.h"), SmallProject::shape);
    CHECK(diff_of(small, "shape.h").ends_with("shape.h: same as the reference\n"));
    std::string text = without_markers(SmallProject::shape);
    put(small.own("01_one/shape.h"), text);
    CHECK(diff_of(small, "").ends_with("shape.h: same as the reference\n"));
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
    put(small.own("01_one/shape.h"), text);
    CHECK(diff_of(small, "").ends_with("shape.h: same as the reference\n"));
}

TEST_CASE("a stub differs from the reference only at its exercises") {
    const SmallProject small;
    said_by([&](std::ostream& out) { start_step(small.project, "01_one", out); });
    const std::string text = diff_of(small, "shape.h");
    CHECK(text.find("-    return x / 2;\n+    // TODO: divide by two\n+    return x;\n") !=
          std::string::npos);
    CHECK(text.find("//>") == std::string::npos);
}

TEST_CASE("a file that the reference does not have is reported as the learner's own") {
    const SmallProject small;
    put(small.own("01_one/own.h"), "// mine\n");
    CHECK(diff_of(small, "own.h").ends_with("only yours; the reference has no such file\n"));
    CHECK_THROWS_AS(diff_of(small, "shape.h"), Error); // not begun
}
