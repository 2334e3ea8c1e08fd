// Facts about gaps: what is not written is the reference's while the checks run, and lines keep their numbers.
#include "tests/tutor/folder.h"
#include "common/util/paths.h"
#include "tools/tutor/commands.h"
#include "tools/tutor/gaps.h"

#include <doctest/doctest.h>

using namespace rt::tutor;

namespace {

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// A project whose learner has started step 01, and has written these lines in place of the first function's gap.
struct Learner : SmallProject {
    explicit Learner(const std::string& lines = "") {
        said_by([&](std::ostream& out) { start_step(project, "01_one", out); });
        if (lines.empty()) return;
        std::string text = content_of(own("01_one/shape.h"));
        const std::string gap = "    // TODO: divide by two\n    return x;\n";
        text.replace(text.find(gap), gap.size(), lines);
        put(own("01_one/shape.h"), text);
    }
};

std::string header(const Headers& headers) {
    return headers.at("01_one/shape.h");
}

} // namespace

TEST_CASE("each function is absent, unwritten or written") {
    const SmallProject small;
    for (const Gap& gap : gaps_of(small.project, "01_one")) CHECK(gap.state == GapState::absent);
    const Learner learner("    return 0.5f * x;\n");
    const auto gaps = gaps_of(learner.project, "01_one");
    REQUIRE(gaps.size() == 2);
    CHECK(gaps[0].state == GapState::written);
    CHECK(gaps[1].state == GapState::unwritten);
    CHECK(has(gaps[1].place, "01_one/shape.h:"));
    // Comments and blanks alone are not written.
    const Learner commented("    return  x; // to do\n");
    CHECK(gaps_of(commented.project, "01_one")[0].state == GapState::unwritten);
}

TEST_CASE("an unwritten function is filled with the reference's, and a written one stays") {
    const Learner learner("    return 0.5f * x;\n");
    const std::string filled = header(filled_headers(learner.project, "01_one"));
    CHECK(has(filled, "return 0.5f * x;"));
    CHECK(has(filled, "if (x < zero) result = -1;"));
    const std::string own = header(own_headers(learner.project, "01_one"));
    CHECK(has(own, "return 0.5f * x;"));
    CHECK_FALSE(has(own, "result = -1"));
}

TEST_CASE("a function alone stands among the reference's") {
    const Learner learner("    return 0.5f * x;\n");
    const std::string with = header(isolated_headers(learner.project, "01_one", {"half"}));
    CHECK(has(with, "return 0.5f * x;"));
    CHECK(has(with, "result = -1"));
    CHECK(isolated_headers(learner.project, "01_one", {}).empty());
}

TEST_CASE("the reference is cut where the learner has gaps, and nowhere else") {
    const Learner learner("    return 0.5f * x;\n");
    const std::string cut = header(cut_headers(learner.project, "01_one"));
    CHECK(has(cut, "return x / 2;"));
    CHECK_FALSE(has(cut, "result = -1"));
    const SmallProject nothing;
    CHECK(cut_headers(nothing.project, "01_one").empty());
}

TEST_CASE("behind a filled function the lines have the learner's numbers again") {
    const Learner learner;
    const std::string path = rt::text_of(learner.own("01_one/shape.h"));
    put(path, content_of(path) + "int after;\n");
    int line = 0, expected = 0, found = 0;
    for (const std::string& each : lines_of(content_of(path))) {
        ++line;
        if (each == "int after;") expected = line;
    }
    line = 0;
    for (const std::string& each : lines_of(header(filled_headers(learner.project, "01_one")))) {
        ++line;
        if (each.starts_with("#line ")) line = std::atoi(each.c_str() + 6) - 1;
        if (each == "int after;") found = line;
    }
    CHECK(found == expected);
}

TEST_CASE("a declaration is no definition, and overloads are told apart by their position") {
    const std::string text =
        "int f(int a);\nint f(int a,\n      int b) {\n    return a;\n}\n\nint f() {\n}\n";
    const auto ranges = functions_named(text, "f");
    REQUIRE(ranges.size() == 2);
    CHECK(ranges[0].begin == 1);
    CHECK(ranges[0].end == 5);
    CHECK(ranges[1].begin == 6);
    CHECK(bare_code(text, ranges[0]) == "intf(inta,intb){returna;}");
    CHECK(functions_named(text, "g").empty());
}

TEST_CASE("the learner's own tree renders the steps after 05 as soon as nothing of step 05 is missing") {
    const SmallProject small;
    const Project real{RT_ROOT, small.project.workshop};
    CHECK(own_tree_flags(real, "06_textures").empty());
    said_by([&](std::ostream& out) { start_step(real, "05_mesh_bvh", out); });
    CHECK(own_tree_flags(real, "06_textures").empty());
    for (const std::string& file : own_files(real, "05_mesh_bvh"))
        put(small.own("05_mesh_bvh/" + file), content_of(real.root / "steps/05_mesh_bvh" / file));
    CHECK(own_tree_flags(real, "06_textures") == Words{"--accel", "bvh"});
    CHECK(own_tree_flags(real, "05_mesh_bvh").empty());
}
