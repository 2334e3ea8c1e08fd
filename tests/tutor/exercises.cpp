// Facts about exercises: found in the reference, removed from it, and found again in a learner's file.
#include "tools/tutor/exercises.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tests/tutor/folder.h"
#include "tools/tutor/hints.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <regex>
#include <set>

using namespace rt;
using namespace rt::tutor;

namespace {

const Project real{RT_ROOT, "/nowhere"};

std::vector<std::string> names_of(const std::vector<Exercise>& exercises) {
    std::vector<std::string> names;
    for (const Exercise& exercise : exercises) names.push_back(exercise.name);
    return names;
}

/// Returns the error that the reader reports for this text.
std::string complaint(const std::string& text) {
    try {
        find_exercises(text, "some.h");
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("each function to write has a row in its chapter") {
    for (const std::string& step : all_steps(real)) {
        const std::string chapter = content_of(real.root / "docs" / (step + ".md"));
        for (const Exercise& exercise : exercises_of(real, step))
            CHECK_MESSAGE(chapter.find("\n| `" + exercise.function + "`") != std::string::npos,
                          step << ": " << exercise.function);
    }
}

TEST_CASE("the eight steps have 43 exercises with unique names within a step") {
    std::size_t count = 0;
    for (const std::string& step : all_steps(real)) {
        const std::vector<std::string> names = names_of(exercises_of(real, step));
        CAPTURE(step);
        CHECK(std::set<std::string>(names.begin(), names.end()).size() == names.size());
        count += names.size();
    }
    CHECK(count == 43);
}

TEST_CASE("every exercise of the course has three hints and there are no others") {
    for (const std::string& step : all_steps(real)) {
        CAPTURE(step);
        CHECK_NOTHROW(read_hints(RT_ROOT, step, exercises_of(real, step)));
    }
}

TEST_CASE("every name in the code of a hint occurs in the code of its step or an earlier one") {
    const std::regex code("`[^`]*`"), name("\\b[A-Za-z_]\\w*"), comment("//.*");
    const auto matches = [](const std::string& text, const std::regex& pattern) {
        const std::sregex_token_iterator begin(text.begin(), text.end(), pattern), end;
        return std::set<std::string>(begin, end);
    };
    std::set<std::string> known;
    for (const std::string& step : all_steps(real)) {
        for (const auto& file : entries_of(real.root / "steps" / step))
            if (file.extension() == ".h")
                known.merge(matches(std::regex_replace(read_file(text_of(file)), comment, ""), name));
        for (const auto& hints : read_hints(RT_ROOT, step, exercises_of(real, step)))
            for (const std::string& hint : hints.second)
                for (const std::string& span : matches(hint, code))
                    for (const std::string& word : matches(span, name))
                        CHECK_MESSAGE(known.contains(word), step << " " << hints.first << ": " << word);
    }
}

TEST_CASE("an exercise is named after its function and has its line numbers") {
    const std::vector<Exercise> found = find_exercises(SmallProject::shape, "shape.h");
    REQUIRE(found.size() == 2);
    CHECK(found[0].function == "half");
    CHECK(found[0].line == 5);
    CHECK(found[0].last_line == 7);
    CHECK(found[0].task == "divide by two");
    CHECK(found[0].placeholder == "return x;");
    CHECK(found[0].reference == std::vector<std::string>{"    return x / 2;"});
    CHECK(found[1].function == "sign"); // its signature has two lines, preceded by a template line
    CHECK(found[1].placeholder == "");
}

TEST_CASE("functions of one name are distinguished by their file and regions of one function by a number") {
    const SmallProject small;
    CHECK(names_of(exercises_of(small.project, "02_two")) ==
          std::vector<std::string>{"twin_base", "twin_above", "both", "both_2"});
}

TEST_CASE("a region without an end is an error that names file and line") {
    CHECK(complaint("int f() {\n    //> task\n    return 1;\n}\n") ==
          "some.h:2: this region has no end (//<)");
    CHECK(complaint("int f() {\n    //> a\n    //> b\n    //<\n}\n").find("some.h:2: ") == 0);
}

TEST_CASE("a region without a beginning, a task or a function is an error that names file and line") {
    CHECK(complaint("int f() {\n    //< return 1;\n}\n").find("some.h:2: ") == 0);
    CHECK(complaint("int f() {\n    //>\n    //<\n}\n").find("some.h:2: ") == 0);
    CHECK(complaint("int f() {\n}\n//> task\n//<\n").find("some.h:3: ") == 0);
    CHECK(complaint("int f() {\n    ///< a comment\n    //> task\n    //<\n}\n") == "");
}

TEST_CASE("a stub has the task and the placeholder where the reference has the answer") {
    const std::string stub = make_stub(SmallProject::shape, find_exercises(SmallProject::shape, "shape.h"));
    CHECK(stub ==
          "// Two functions.\n#pragma once\n\ninline float half(float x) {\n    // TODO: divide by two\n"
          "    return x;\n}\n\ntemplate <typename T>\nint sign(T x,\n         T zero) {\n"
          "    int result = 1;\n    // TODO: negative below zero\n    return result;\n}\n");
}

TEST_CASE("one exercise is cut and the others stay") {
    const std::vector<Exercise> found = find_exercises(SmallProject::shape, "shape.h");
    const std::string stub = make_stub(SmallProject::shape, {found[1]});
    CHECK(stub.find("return x / 2;") != std::string::npos);
    CHECK(stub.find("result = -1") == std::string::npos);
}

TEST_CASE("no stub of the course shows a line of an answer or a marker") {
    for (const std::string& step : all_steps(real))
        for (const std::string& file : files_to_write(exercises_of(real, step))) {
            const std::string text = content_of(steps_folder(real) / step / file);
            const std::vector<Exercise> here = find_exercises(text, file);
            const std::string stub = make_stub(text, here);
            CAPTURE(step + "/" + file);
            CHECK(find_exercises(stub, file).empty());
            std::size_t kept = lines_of(text).size();
            for (const Exercise& e : here) kept -= e.reference.size() + (e.placeholder.empty() ? 1 : 0);
            CHECK(lines_of(stub).size() == kept);
        }
}

TEST_CASE("a function that was not edited is untouched whatever changed around it") {
    const std::vector<Exercise> found = find_exercises(SmallProject::shape, "shape.h");
    const std::string stub = make_stub(SmallProject::shape, found);
    CHECK(is_untouched(found[0], stub, stub));
    std::string mine = "// my own remark\n" + stub;
    mine.replace(mine.find("    // TODO: divide by two\n"), 27, "");
    mine.replace(mine.find("return x;"), 9, "return  x; // later");
    CHECK(is_untouched(found[0], mine, stub)); // comments and blanks are not an answer
    mine.replace(mine.find("return  x;"), 10, "return x / 2;");
    CHECK_FALSE(is_untouched(found[0], mine, stub));
    CHECK(is_untouched(found[1], mine, stub));
    CHECK_FALSE(is_untouched(found[0], "", stub));
}

TEST_CASE("an exercise is found at its TODO or else at its function") {
    const std::vector<Exercise> found = find_exercises(SmallProject::shape, "shape.h");
    const std::string stub = make_stub(SmallProject::shape, found);
    CHECK(line_of(found[1], stub) == 13);
    CHECK(line_of(found[1], SmallProject::shape) == 11);
    CHECK(line_of(found[1], "nothing\n") == 1);
}

TEST_CASE("the headers that a header needs come before it") {
    const SmallProject small;
    CHECK(included_headers({small.root / "steps"}, "02_two/above.h") ==
          std::vector<std::string>{"01_one/shape.h", "02_two/base.h", "02_two/above.h"});
}

TEST_CASE("a function with a loop or a recursive call may not terminate; others do") {
    const auto may = [](const std::string& body) {
        const std::string text =
            "inline int f(int x) {\n" + body + "\n}\ninline int g(int x) {\n    for (;;) {}\n}\n";
        return may_not_end({.function = "f"}, text);
    };
    CHECK_FALSE(may("    return x; // f(x), for (;;)"));
    CHECK(may("    while (x > 0) ++x;"));
    CHECK(may("    for (;;) {}"));
    CHECK(may("    return f(x);"));
}

TEST_CASE("an empty file and an empty stub cause no error") {
    CHECK_FALSE(is_untouched({.function = "f"}, "", ""));
    CHECK(line_of({.function = "f"}, "") == 1);
}
