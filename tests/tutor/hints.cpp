// Facts about hints: the format of their files, and that each call shows one more.
#include "tools/tutor/hints.h"

#include "common/util/error.h"
#include "tests/tutor/folder.h"
#include "tools/tutor/commands.h"

#include <doctest/doctest.h>

using namespace rt;
using namespace rt::tutor;

namespace {

std::string hint(const SmallProject& small, const std::string& name, HintMode mode = HintMode::next) {
    return said_by([&](std::ostream& out) { show_hints(small.project, "01_one", name, mode, out); });
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::string complaint(const std::string& hints) {
    const SmallProject small;
    put(small.root / "exercises/01_one/hints.md", hints);
    try {
        read_hints(small.root, "01_one", exercises_of(small.project, "01_one"));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

} // namespace

TEST_CASE("each call gives the next hint and after the third there is none") {
    const SmallProject small;
    const std::string first = hint(small, "half"), second = hint(small, "half"), third = hint(small, "half");
    CHECK(has(first, "Hint 1 of 3\n  look twice\n"));
    CHECK_FALSE(has(first, "formula"));
    CHECK(has(second, "Hint 2 of 3\n  formula\n"));
    CHECK_FALSE(has(second, "line\n\n"));
    CHECK(has(third, "Hint 3 of 3\n  line\n"));
    CHECK(has(third, "no more hints"));
    CHECK(hint(small, "half") == third);
    CHECK(has(hint(small, "sign"), "Hint 1 of 3")); // each exercise is counted separately
}

TEST_CASE("a hint can be repeated, all can be shown, and the count can be reset") {
    const SmallProject small;
    CHECK(has(hint(small, "half", HintMode::again), "Hint 1 of 3"));
    hint(small, "half");
    CHECK(has(hint(small, "half", HintMode::again), "Hint 2 of 3"));
    CHECK(has(hint(small, "half", HintMode::again), "Hint 2 of 3"));
    const std::string all = hint(small, "half", HintMode::all);
    CHECK(has(all, "Hint 1 of 3"));
    CHECK(has(all, "Hint 3 of 3"));
    CHECK(has(hint(small, "half"), "no more hints"));
    hint(small, "half", HintMode::reset);
    CHECK(has(hint(small, "half"), "Hint 1 of 3"));
}

TEST_CASE("without a name, the exercises of the step are listed with the number of hints seen") {
    const SmallProject small;
    hint(small, "sign");
    const std::string list = hint(small, "");
    CHECK(has(list, "0 of 3  half (shape.h): divide by two"));
    CHECK(has(list, "1 of 3  sign (shape.h)"));
    hint(small, "", HintMode::reset);
    CHECK(has(hint(small, ""), "0 of 3  sign"));
}

TEST_CASE("an unknown exercise is rejected with the list of names") {
    const SmallProject small;
    CHECK_THROWS_WITH_AS(hint(small, "quarter"),
                         "01_one has no function 'quarter' to write; it has half, sign", Error);
}

TEST_CASE("hints that are missing, superfluous or not three are errors that name the file") {
    CHECK(has(complaint("## half\n1. a\n2. b\n3. c\n"), "01_one/hints.md: there are no hints for sign"));
    const std::string both = "## half\n1. a\n2. b\n3. c\n## sign\n1. a\n2. b\n3. c\n";
    CHECK(complaint(both) == "");
    CHECK(has(complaint(both + "## quarter\n1. a\n2. b\n3. c\n"),
              "hints for quarter, which is not an exercise"));
    CHECK(has(complaint(both + "4. d\n"), "4 hints for sign; there must be three"));
    CHECK(has(complaint("## half\n1. a\n## sign\n1. a\n2. b\n3. c\n"),
              "1 hints for half; there must be three"));
    CHECK(has(complaint(both + "## half\n"), "01_one/hints.md:9: there are already hints for half"));
    CHECK(has(complaint("## half\n2. a\n"), "01_one/hints.md:2: expected '1. '"));
    CHECK(has(complaint("1. a\n"), "01_one/hints.md:1: expected '## name' before the first hint"));
}

TEST_CASE("damaged lines in the record of hints are ignored") {
    const SmallProject small;
    put(small.own(".hints"), "01_one\thalf\tmany\n\n01_one\tsign\t2\nx\n");
    CHECK(has(hint(small, "half"), "Hint 1 of 3"));
    CHECK(has(hint(small, "sign"), "Hint 3 of 3"));
}
