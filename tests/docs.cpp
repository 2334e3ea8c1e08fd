// Facts about the weaver, which keeps listings, outputs and links in the chapters in agreement with the code.
#include "common/util/error.h"
#include "tests/check.h"
#include "tests/tutor/folder.h"
#include "tools/tutor/exercises.h"
#include "tools/tutor/util.h"
#include "tools/weave/region.h"
#include "tools/weave/pages.h"
#include "tools/weave/weave.h"

#include <filesystem>
#include <fstream>
#include <string>

using namespace rt;
using namespace rt::weave;
using namespace rt::tutor;

namespace {

const std::string source = R"(// What this file is for.
#pragma once

#include <vector>

namespace rt {

/// A shape.
struct alignas(64) Shape {
    int number = 0; // };
};

using Shapes = std::vector<Shape>;

/// How near is near.
inline constexpr float epsilon = 1e-4f;

enum class Kind { a, b };

template <typename T>
int size(const T& of);

/// In words "};" and '{'.
template <typename T>
int size(const T& of) {
    if (of.empty()) {
        return '}';
    }
    return int(of.size());
}

inline int meet(const Shape& shape, int t) {
    return shape.number + t;
}

/// The other one.
inline int meet(const Shapes& shapes, int t) {
    return size(shapes) + t;
}

} // namespace rt
)";

template <typename Action>
std::string complaint(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

std::string complaint_of(const std::string& name) {
    return complaint([&] { region(source, name, "steps/x.h"); });
}

std::string complaint_in(const std::vector<std::string>& lines) {
    return complaint([&] { find_blocks(lines, "docs/x.md"); });
}

} // namespace

TEST_CASE("A listing is a whole declaration with the comment above it") {
    CHECK(region(source, "Shape", "") ==
          "/// A shape.\nstruct alignas(64) Shape {\n    int number = 0; // };\n};\n");
    CHECK(region(source, "Shapes", "") == "using Shapes = std::vector<Shape>;\n");
    CHECK(region(source, "epsilon", "") ==
          "/// How near is near.\ninline constexpr float epsilon = 1e-4f;\n");
    CHECK(region(source, "Kind", "") == "enum class Kind { a, b };\n");
}

TEST_CASE("A listing of a template shows its definition, and brackets in quotes do not end it") {
    const std::string size = region(source, "size", "");
    CHECK(size.starts_with("/// In words"));
    CHECK(size.ends_with("    return int(of.size());\n}\n"));
}

TEST_CASE("Overloaded functions are distinguished by their parameters") {
    CHECK(region(source, "meet(const Shapes", "")
              .starts_with("/// The other one.\ninline int meet(const Shapes&"));
    CHECK(region(source, "meet(const Shape&", "").starts_with("inline int meet(const Shape& shape"));
    CHECK(complaint_of("meet").starts_with("steps/x.h: there are 2 declarations of meet"));
}

TEST_CASE("A name that no longer exists is an error even if it is still used") {
    CHECK(complaint_of("shape") == "steps/x.h: there is no declaration of shape");
    CHECK(complaint_of("vector") == "steps/x.h: there is no declaration of vector");
    CHECK(complaint_of("number") == "steps/x.h: there is no declaration of number");
}

TEST_CASE("A marker without an end, a stray end and an unknown kind are errors with their line") {
    CHECK(complaint_in({"", "<!-- listing: a.h -->", "x"}) == "docs/x.md:2: this marker has no <!-- end -->");
    CHECK(complaint_in({"<!-- end -->"}) == "docs/x.md:1: this <!-- end --> has no marker before it");
    CHECK(complaint_in({"<!-- lsting: a.h -->", "<!-- end -->"})
              .starts_with("docs/x.md:1: \"lsting\" is not one of"));
    CHECK(complaint_in({"<!-- diff: a b -->", "<!-- diff: a b -->"})
              .starts_with("docs/x.md:2: this marker begins before"));
    CHECK(complaint_in({"<!-- diff: a b -->", "<!-- end -->", "<!-- a word -->"}) == "");
}

TEST_CASE("A picture that is alive in the web edition has a marker without an end") {
    CHECK(find_blocks({"<!-- live: 04_refraction --options ior,bubble -->", "", "![glass](a.png)"}, "page")
              .empty());
}

TEST_CASE("Truncated or damaged sources and pages cause an Error or nothing, but never another exception") {
    for (const char* text : {"alignas(", "requires(", "struct alignas(", "template<int>", "template",
                             "template <int>   ", "(", "};", "'"})
        CHECK_MESSAGE(complaint([&] { region(text, "x", "steps/x.h"); }) ==
                          "steps/x.h: there is no declaration of x",
                      std::string(text));
    for (const char* command :
         {"x # exit y", "x # exit ", "x # exit 99999999999", "x # exit -1", "x # exit 256"})
        CHECK_MESSAGE(complaint([&] {
                          find_commands({"```sh", command}, "docs/x.md");
                      }) == "docs/x.md:2: \"# exit \" must be followed by an exit code",
                      std::string(command));
    CHECK(complaint_in({"<!-- a: -->"}) == "docs/x.md:1: this marker does not say what to insert");
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder.path / "docs");
    const std::string far(5000, 'a');
    const std::string page = "[a](" + far + ") [b](" + far + ".md#c) [d](../docs#e)\n`steps/" + far + "`\n";
    CHECK(dead_links(folder.path, page, "docs/a.md").size() == 4);
}

TEST_CASE("Weaving fills the blocks and leaves everything else unchanged") {
    const std::string page =
        "one\n<!-- listing: a -->\nold\nold\n<!-- end -->\ntwo\n<!-- listing: b -->\n<!-- end -->\n";
    std::string seen;
    const std::string fresh = weave_page(page, "docs/x.md", [&](const Block& block, const std::string& now) {
        seen += now;
        return "new " + block.what + "\n";
    });
    CHECK(seen == "old\nold\n");
    CHECK(fresh ==
          "one\n<!-- listing: a -->\nnew a\n<!-- end -->\ntwo\n<!-- listing: b -->\nnew b\n<!-- end -->\n");
}

TEST_CASE("The commands of a page are the lines of its shell blocks with the exit codes that they state") {
    const auto commands = find_commands(lines_of("```sh\n./learn start 03\n\n./learn check 03    # exit 1: "
                                                 "nothing is written\n```\n```cpp\nint a;\n```\n"));
    REQUIRE(commands.size() == 2);
    CHECK(commands[0].line == "./learn start 03");
    CHECK(commands[0].code == 0);
    CHECK(commands[1].code == 1);
    CHECK(commands[1].number == 4);
}

TEST_CASE("Listings, diffs and galleries are made from files, and a missing file is an error") {
    const TemporaryFolder folder;
    const std::filesystem::path& root = folder.path;
    std::filesystem::create_directories(root / "steps");
    std::ofstream(root / "steps/a.h") << "int f() {\n    //> do it\n    return 2;\n    //< return 0;\n}\n";
    std::ofstream(root / "steps/b.h") << "int f() {\n    return 3;\n}\n";
    CHECK(block_text(root, {"listing", "steps/b.h#f", 0, 0}) == "```cpp\nint f() {\n    return 3;\n}\n```\n");
    CHECK(block_text(root, {"diff", "steps/a.h steps/b.h", 0, 0}).find("-    return 2;\n+    return 3;\n") !=
          std::string::npos);
    CHECK_THROWS_AS(block_text(root, {"diff", "steps/a.h steps/a.h", 0, 0}), Error);
    CHECK_THROWS_AS(block_text(root, {"listing", "steps/c.h", 0, 0}), Error);
    CHECK_THROWS_AS(block_text(root, {"gallery", "09_none", 0, 0}), Error);
}

TEST_CASE("A listing of an exercise shows the gap and folds the answer below it") {
    const TemporaryFolder folder;
    put(folder.path / "steps/a.h", "int f() {\n    //> which number?\n    return 2;\n    //< return 0;\n}\n");
    CHECK(block_text(folder.path, {"listing", "steps/a.h#f", 0, 0}) ==
          "```cpp\nint f() {\n    // TODO: which number?\n    return 0;\n}\n```\n\n"
          "<details><summary>The lines of <code>f</code>, after you have tried</summary>\n\n"
          "```cpp\nreturn 2;\n```\n\n</details>\n");
}

TEST_CASE("A milestone is shown with the functions that lead to it and its picture") {
    const TemporaryFolder folder;
    put(folder.path / "exercises/01_one/milestones.md",
        "# Milestones\n\n## sky: there is a sky\n* Write: f, g\n* Options: --view depth\n* Shows: a sky,\n  "
        "blue.\n");
    CHECK(block_text(folder.path, {"milestone", "01_one sky", 0, 0}) ==
          "\n> **Milestone 1 of 1: there is a sky.** With `f`, `g` written, `./learn run 01 --view depth` "
          "shows a "
          "sky, blue.\n>\n> ![there is a sky](../exercises/01_one/milestones/sky.png)\n\n");
    CHECK_THROWS_AS(block_text(folder.path, {"milestone", "01_one sea", 0, 0}), Error);
}

TEST_CASE("Pages are linked in the order of the README with the chapters first") {
    const TemporaryFolder folder;
    put(folder.path / "README.md", "[a](docs/models.md) [b](docs/01_one.md#top) [c](docs/02_two.md)\n");
    for (const std::string name : {"models", "01_one", "02_two"})
        put(folder.path / "docs" / (name + ".md"), "# Page " + name + "\n\n## A part, of it\n");
    CHECK(block_text(folder.path, {"navigation", "02_two", 0, 0}) ==
          "[← Page 01_one](01_one.md) · [Contents](../README.md#the-eight-chapters) · [Page models "
          "→](models.md)\n");
    CHECK(block_text(folder.path, {"contents", "01_one", 0, 0}) == "\n* [A part, of it](#a-part-of-it)\n\n");
    CHECK_THROWS_AS(block_text(folder.path, {"navigation", "03_three", 0, 0}), Error);
}

TEST_CASE("Mathematics that code hosts do not show is found") {
    const auto count = [](const std::string& page) { return unshowable_math(page, "docs/x.md").size(); };
    CHECK(count("$`a\\,b`$ and `$x` in code\n```sh\necho $HOME\n```\n") == 0);
    CHECK(count("the angle $a$\n") == 1);
    CHECK(count("$`\\operatorname{f}`$\n") == 1);
    CHECK(count("```math\n\\phantom{-}1\n```\n") == 1);
    CHECK(count("| $`|a|`$ | b |\n") == 1);
}

TEST_CASE(
    "A page counts as changed if its commands or usable steps change, but not for prose or later steps") {
    const TemporaryFolder folder;
    const std::filesystem::path& root = folder.path;
    const auto write = [&](const std::string& name, const std::string& text) {
        std::filesystem::create_directories((root / name).parent_path());
        std::ofstream(root / name) << text;
    };
    write("learn", "a script");
    write("steps/01_a/a.h", "1");
    write("steps/02_b/b.h", "2");
    write("docs/01_a.md", "Prose.\n");
    CHECK(page_key(root, "docs/01_a.md") == ""); // no command to run
    write("docs/01_a.md", "Prose.\n```sh\n./learn run 01\n```\n");
    const std::string key = page_key(root, "docs/01_a.md");
    write("docs/01_a.md", "Other prose.\n\n```sh\n./learn run 01\n```\n");
    write("steps/02_b/b.h", "3");
    CHECK(page_key(root, "docs/01_a.md") == key);
    write("docs/01_a.md", "Prose.\n```sh\n./learn run 02\n```\n");
    CHECK(page_key(root, "docs/01_a.md") != key);
    write("docs/01_a.md",
          "Prose.\n```sh\n./learn run 01\n```\n<!-- output: ls -->\n```text\na\n```\n<!-- end -->\n");
    CHECK(page_key(root, "docs/01_a.md") != key);
    write("docs/01_a.md", "Prose.\n```sh\n./learn run 01\n```\n");
    CHECK(page_key(root, "docs/01_a.md") == key);
    write("steps/01_a/a.h", "// Words.\n1 // the same");
    CHECK(page_key(root, "docs/01_a.md") == key);
    write("steps/01_a/a.h", "4");
    CHECK(page_key(root, "docs/01_a.md") != key);
    write("steps/01_a/a.h", "1");
    write("steps/01_a/program/main.cpp", "5");
    CHECK(page_key(root, "docs/01_a.md") != key);
}

TEST_CASE("Dead links, pictures, headings and paths are found with their lines") {
    const TemporaryFolder folder;
    const std::filesystem::path& root = folder.path;
    std::filesystem::create_directories(root / "docs");
    std::ofstream(root / "docs/b.md") << "# A heading, of two: words\n";
    const std::string page =
        "[b](b.md) ![p](p.png)\n[c](b.md#a-heading-of-two-words) [d](b.md#gone) [e](#here)\n"
        "```sh\n[f](f.md)\n```\n## Here\n`docs/b.md` `docs/c.md` [w](https://example.org)\n";
    const auto dead = dead_links(root, page, "docs/a.md");
    REQUIRE(dead.size() == 3);
    CHECK(dead[0] == "docs/a.md:1: p.png does not exist");
    CHECK(dead[1] == "docs/a.md:2: b.md#gone does not exist");
    CHECK(dead[2] == "docs/a.md:7: `docs/c.md` does not exist");
    const std::string html = "<a href=\"gone.md\"><img src=\"gone.png\" alt=\"\"></a> <a href=\"b.md\">\n";
    CHECK(dead_links(root, html, "docs/a.md").size() == 2);
}
