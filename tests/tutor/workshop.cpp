// Facts about the workshop: stubs never overwrite, removed files are kept, status shows the progress.
#include "tools/tutor/workshop.h"
#include "common/util/paths.h"

#include "common/util/error.h"
#include "tests/tutor/folder.h"
#include "tools/tutor/commands.h"
#include "tools/tutor/system.h"

#include <doctest/doctest.h>

#include <vector>

using namespace rt;
using namespace rt::tutor;

namespace {

namespace fs = std::filesystem;

std::string start(const SmallProject& small, const std::string& step) {
    return said_by([&](std::ostream& out) { start_step(small.project, step, out); });
}
std::string status(const SmallProject& small) {
    return said_by([&](std::ostream& out) { show_status(small.project, out); });
}
std::string undo(const SmallProject& small, const std::string& step, const std::string& file) {
    return said_by([&](std::ostream& out) { undo_files(small.project, step, file, out); });
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::vector<fs::path> backups(const SmallProject& small, const std::string& step) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(small.own(".backup/" + step)))
        found.push_back(entry.path());
    return found;
}

void replace(const fs::path& path, const std::string& what, const std::string& by) {
    std::string text = content_of(path);
    text.replace(text.find(what), what.size(), by);
    put(path, text);
}

} // namespace

TEST_CASE("start creates stubs of the files that have exercises and of no others") {
    const SmallProject small;
    const std::string said = start(small, "01_one");
    CHECK(own_files(small.project, "01_one") == std::vector<std::string>{"shape.h"});
    CHECK(has(content_of(small.own("01_one/shape.h")), "// TODO: divide by two"));
    CHECK(has(said, "is one enough?"));
    CHECK(has(said, "shape.h:5  half\n      divide by two\n"));
    CHECK(has(said, "./learn check 01"));
}

TEST_CASE("start never overwrites an existing file and reports it") {
    const SmallProject small;
    put(small.own("02_two/base.h"), "// mine\n");
    const std::string said = start(small, "02_two");
    CHECK(content_of(small.own("02_two/base.h")) == "// mine\n");
    CHECK(has(said, "base.h already exists and was not changed"));
    CHECK(has(content_of(small.own("02_two/above.h")), "TODO"));
    put(small.own("02_two/above.h"), "");
    start(small, "02_two");
    CHECK(content_of(small.own("02_two/above.h")) == "");
}

#if !defined(_WIN32) // where links need a privilege
TEST_CASE("start does not write through a dangling link") {
    const SmallProject small;
    fs::create_directories(small.own("01_one"));
    fs::create_symlink(small.root / "elsewhere.h", small.own("01_one/shape.h"));
    CHECK_THROWS_AS(start(small, "01_one"), Error); // the exercises cannot be read there
    CHECK_FALSE(fs::exists(small.root / "elsewhere.h"));
}
#endif

TEST_CASE("start lists the learner's files of earlier steps") {
    const SmallProject small;
    CHECK_FALSE(has(start(small, "02_two"), "Your files"));
    start(small, "01_one");
    CHECK(has(start(small, "02_two"), "Your files of earlier steps, which this step uses: 01_one/shape.h"));
}

TEST_CASE("if no folder can be created, start fails and leaves nothing") {
    const SmallProject small;
    put(small.root / "workshop", "a file, not a folder");
    CHECK_THROWS_AS(start(small, "01_one"), Error);
    CHECK(content_of(small.root / "workshop") == "a file, not a folder");
}

TEST_CASE("3, 03 and the full name mean a step; anything else is rejected") {
    const SmallProject small;
    for (const char* word : {"2", "02", "02_two"}) CHECK(find_step(small.project, word) == "02_two");
    for (const char* word : {"", "3", "two", "002", "../steps/02_two", "02_two/"})
        CHECK_THROWS_AS(find_step(small.project, word), Error);
}

TEST_CASE("an editor's temporary files are not among the learner's files") {
    const SmallProject small;
    for (const char* file : {".shape.h.swp", "shape.h~", ".shape.h", "shape.h", "notes.txt"})
        put(small.own(std::string("01_one/") + file), "x");
    fs::create_directories(small.own("01_one/folder.h"));
    CHECK(own_files(small.project, "01_one") == std::vector<std::string>{"shape.h"});
}

TEST_CASE("undo keeps the file under the current time even for several within a second") {
    const SmallProject small;
    for (const std::string text : {"first", "second", "third"}) {
        put(small.own("01_one/shape.h"), text);
        CHECK(has(undo(small, "01_one", "shape.h"), "to restore it: mv "));
        CHECK_FALSE(fs::exists(small.own("01_one/shape.h")));
    }
    std::string all;
    for (const fs::path& path : backups(small, "01_one")) {
        all += content_of(path) + " ";
        CHECK(text_of(path.filename()).starts_with("shape.h.20"));
    }
    CHECK(all.size() == std::string("first second third ").size());
}

TEST_CASE("undo of a step moves all of its files") {
    const SmallProject small;
    start(small, "02_two");
    undo(small, "02_two", "");
    CHECK(own_files(small.project, "02_two").empty());
    CHECK(backups(small, "02_two").size() == 2);
    CHECK_THROWS_AS(undo(small, "02_two", ""), Error);
}

TEST_CASE("undo moves only files of the step") {
    const SmallProject small;
    start(small, "01_one");
    for (const char* word : {"plain.h", "../01_one/shape.h", "..", "shape"})
        CHECK_THROWS_AS(undo(small, "01_one", word), Error);
    CHECK(fs::exists(small.own("01_one/shape.h")));
    undo(small, "01_one", "workshop/01_one/shape.h");
    CHECK_FALSE(fs::exists(small.own("01_one/shape.h")));
}

TEST_CASE("status counts the functions that differ from their placeholder and states what is next") {
    const SmallProject small;
    CHECK(has(status(small), "01_one          not started"));
    CHECK(has(status(small), "next: ./learn start 01"));
    start(small, "01_one");
    CHECK(has(status(small), "0 of 2 functions started; not checked yet"));
    CHECK(has(status(small), "next: write half in "));
    replace(small.own("01_one/shape.h"), "return x;", "return x / 2;");
    CHECK(has(status(small), "1 of 2 functions started"));
    CHECK(has(status(small), "next: write sign in "));
    replace(small.own("01_one/shape.h"), "    return result", "    return x < zero ? -1 : result");
    CHECK(has(status(small), "2 of 2 functions started"));
    CHECK(has(status(small), "next: ./learn check 01"));
}

TEST_CASE("status reports the last check and whether the files changed since") {
    const SmallProject small;
    put(small.own("01_one/shape.h"), SmallProject::shape);
    write_check(small.project, "01_one", {7, 0, "same", fingerprint(small.project, "01_one")});
    CHECK(has(status(small), "done  01_one"));
    CHECK(has(status(small), "7 of 7 checks passed, the picture matches the reference\n"));
    CHECK(has(status(small), "next: ./learn start 02"));
    replace(small.own("01_one/shape.h"), "x / 2", "x / 3");
    CHECK_FALSE(has(status(small), "done"));
    CHECK(has(status(small), "changed since"));
    CHECK(has(status(small), "next: ./learn check 01"));
    write_check(small.project, "01_one", {5, 2, "different", fingerprint(small.project, "01_one")});
    CHECK(has(status(small), "5 of 7 checks passed, the picture is wrong\n"));
    CHECK_FALSE(has(status(small), "done"));
}

TEST_CASE("a step is done only if its picture is correct too") {
    for (const char* verdict : {"same", "noise"}) CHECK(all_well({3, 0, verdict, ""}));
    for (const char* verdict : {"look", "different", "", "none"}) CHECK_FALSE(all_well({3, 0, verdict, ""}));
    CHECK_FALSE(all_well({3, 1, "same", ""}));
    CHECK_FALSE(all_well({0, 0, "same", ""}));
}

TEST_CASE("a check of one step keeps the state of the others and skips damaged lines") {
    const SmallProject small;
    put(small.own(".state"), "01_one\t3\t0\tsame\tabc\ngarbage\n02_two\tx\t0\tsame\tabc\n\n");
    write_check(small.project, "02_two", {1, 2, "look", "def"});
    const auto checks = read_checks(small.project);
    CHECK(checks.size() == 2);
    CHECK(checks.at("01_one").passed == 3);
    CHECK(checks.at("02_two").failed == 2);
    CHECK(content_of(small.own(".state")) == "01_one\t3\t0\tsame\tabc\n02_two\t1\t2\tlook\tdef\n");
}

TEST_CASE("a fingerprint depends on the files of the step and of earlier steps, not of later ones") {
    const SmallProject small;
    const std::string nothing = fingerprint(small.project, "01_one");
    put(small.own("02_two/base.h"), "x");
    CHECK(fingerprint(small.project, "01_one") == nothing);
    const std::string two = fingerprint(small.project, "02_two");
    CHECK(two != nothing);
    put(small.own("01_one/shape.h"), "x");
    CHECK(fingerprint(small.project, "01_one") != nothing);
    CHECK(fingerprint(small.project, "02_two") != two);
    CHECK(nothing.size() == 16);
}

TEST_CASE("the page at the end is refused while a step is open and says which") {
    const SmallProject small;
    try {
        make_course_page(small.project, false);
        FAIL("a page without pictures");
    } catch (const CommandFailed& failure) {
        CHECK(has(failure.what(), "to do: 01_one, 02_two"));
    }
}

TEST_CASE("if all steps are done, nothing is left") {
    const SmallProject small;
    put(small.own("01_one/shape.h"), SmallProject::shape);
    put(small.own("02_two/base.h"), SmallProject::base);
    for (const char* step : {"01_one", "02_two"})
        write_check(small.project, step, {1, 0, "noise", fingerprint(small.project, step)});
    CHECK(has(status(small), "All steps hold"));
    CHECK(has(status(small), "3 more from the reference")); // above.h was never begun
}

TEST_CASE("merging brings the given part up to date and keeps what the learner wrote") {
    const SmallProject small;
    start(small, "01_one");
    replace(small.own("01_one/shape.h"), "return x;", "return 0.5f * x;");
    CHECK(outdated_files(small.project, "01_one").empty());
    const fs::path reference = small.root / "steps/01_one/shape.h";
    replace(reference, "// Two functions.", "// Two of them.");
    CHECK(outdated_files(small.project, "01_one").empty()); // only a comment
    replace(reference, "int result = 1;", "int result = +1;");
    CHECK(outdated_files(small.project, "01_one") == std::vector<std::string>{"shape.h"});
    const auto merge = [&] {
        return said_by([&](std::ostream& out) { merge_step(small.project, "01_one", out); });
    };
    CHECK(has(merge(), "to restore it: mv "));
    const std::string text = content_of(small.own("01_one/shape.h"));
    CHECK(has(text, "return 0.5f * x;"));
    CHECK(has(text, "int result = +1;"));
    CHECK(has(merge(), "those of the reference"));
}

TEST_CASE("merging keeps the learner's lines where the reference has changed the same ones") {
    const SmallProject small;
    start(small, "01_one");
    replace(small.own("01_one/shape.h"), "    // TODO: divide by two\n    return x;", "    return x / 2;");
    replace(small.root / "steps/01_one/shape.h", "//> divide by two", "//> what is half of it?");
    replace(small.root / "steps/01_one/shape.h", "int result = 1;", "int result = +1;");
    const std::string said = said_by([&](std::ostream& out) { merge_step(small.project, "01_one", out); });
    CHECK(has(said, "your lines stay where both have changed: ./learn diff 01 shape.h"));
    const std::string text = content_of(small.own("01_one/shape.h"));
    CHECK(has(text, "inline float half(float x) {\n    return x / 2;\n}"));
    CHECK(has(text, "int result = +1;"));
    CHECK_FALSE(has(text, "<<<<"));
}
