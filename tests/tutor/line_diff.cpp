// Facts about differences between texts, and about the output of ./learn diff.
#include "tools/tutor/line_diff.h"

#include "common/util/error.h"
#include "common/math/random.h"
#include "tests/tutor/folder.h"
#include "tools/tutor/commands.h"

#include <doctest/doctest.h>

using namespace rt;

namespace {

using Lines = std::vector<std::string>;

std::string shown_diff(const Lines& a, const Lines& b, bool colour = false) {
    return unified(line_diff(a, b), "a", "b", colour);
}

/// Returns one side of a diff.
Lines side(const std::vector<DiffLine>& diff, char kind) {
    Lines lines;
    for (const DiffLine& line : diff)
        if (line.kind == ' ' || line.kind == kind) lines.push_back(line.text);
    return lines;
}

std::size_t changes(const std::vector<DiffLine>& diff) {
    std::size_t count = 0;
    for (const DiffLine& line : diff) count += line.kind != ' ';
    return count;
}

Lines random_lines(Random& random) {
    Lines lines(std::size_t(random.uniform() * 12));
    for (std::string& line : lines) line = char('a' + int(random.uniform() * 4));
    return lines;
}

std::string diff_of(const SmallProject& small, const std::string& file, bool colour = false) {
    return said_by([&](std::ostream& out) { show_diff(small.project, "01_one", file, colour, out); });
}

} // namespace

TEST_CASE("equal texts have no difference") {
    CHECK(shown_diff({"a", "b"}, {"a", "b"}).empty());
    CHECK(shown_diff({}, {}).empty());
}

TEST_CASE("a changed line is shown with three lines of context as diff -u does") {
    const Lines a{"1", "2", "3", "4", "5", "6", "7", "8", "9"};
    Lines b = a;
    b[4] = "five";
    CHECK(shown_diff(a, b) == "--- a\n+++ b\n@@ -2,7 +2,7 @@\n 2\n 3\n 4\n-5\n+five\n 6\n 7\n 8\n");
    CHECK(shown_diff({}, {"x"}) == "--- a\n+++ b\n@@ -0,0 +1 @@\n+x\n");
    CHECK(shown_diff({"x"}, {}) == "--- a\n+++ b\n@@ -1 +0,0 @@\n-x\n");
}

TEST_CASE("changes far from each other are in separate hunks") {
    Lines a;
    for (int i = 0; i < 30; ++i) a.push_back(std::to_string(i));
    Lines b = a;
    a[2] = "old", b[25] = "new";
    const std::string text = shown_diff(a, b);
    CHECK(text.find("@@ -1,6 +1,6 @@") != std::string::npos);
    CHECK(text.find("@@ -23,7 +23,7 @@") != std::string::npos);
}

TEST_CASE("a difference contains both texts and as few changes as possible") {
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        const Lines a = random_lines(random), b = random_lines(random);
        const auto diff = line_diff(a, b);
        REQUIRE(side(diff, '-') == a);
        REQUIRE(side(diff, '+') == b);
        REQUIRE(changes(diff) == changes(line_diff(b, a)));
        REQUIRE(changes(diff) <= a.size() + b.size());
    }
    CHECK(changes(line_diff({"a", "b", "c", "d"}, {"b", "x", "d"})) == 3);
}

TEST_CASE("texts of many thousand lines are compared quickly") {
    Lines a(20000, "a"), b(20000, "b");
    const auto diff = line_diff(a, b);
    CHECK(changes(diff) == 40000);
}

TEST_CASE("colour is used only if it is requested") {
    CHECK(shown_diff({"x"}, {"y"}).find('\x1b') == std::string::npos);
    const std::string coloured = shown_diff({"x"}, {"y"}, true);
    CHECK(coloured.find("\x1b[31m-x\x1b[0m\n") != std::string::npos);
    CHECK(coloured.find("\x1b[32m+y\x1b[0m\n") != std::string::npos);
}

TEST_CASE("the reference's answer equals the reference with or without markers and with Windows line ends") {
    const SmallProject small;
    put(small.own("01_one/shape.h"), SmallProject::shape);
    CHECK(diff_of(small, "shape.h").ends_with("shape.h: as the reference\n"));
    std::string text = without_markers(SmallProject::shape);
    put(small.own("01_one/shape.h"), text);
    CHECK(diff_of(small, "").ends_with("shape.h: as the reference\n"));
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
    put(small.own("01_one/shape.h"), text);
    CHECK(diff_of(small, "").ends_with("shape.h: as the reference\n"));
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
    CHECK(diff_of(small, "own.h").ends_with("yours alone, the reference has no such file\n"));
    CHECK_THROWS_AS(diff_of(small, "shape.h"), Error); // not started
}
