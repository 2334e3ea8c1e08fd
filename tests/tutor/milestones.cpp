// Facts about milestones: they group all exercises of a step, and say how far a learner is.
#include "tests/tutor/folder.h"

#include "common/util/error.h"
#include "tools/tutor/milestones.h"

#include <doctest/doctest.h>

using namespace rt;
using namespace rt::tutor;

namespace {

const std::string list =
    "# Milestones of step 01: one\n\nAn introduction.\n\n"
    "## whole: it is whole\n* Write: sign\n* Shows: a sign.\n\n"
    "## halves: it has halves\n* Write: half\n* Options: --view depth\n* Shows: two\n  halves.\n";

std::string complaint(const std::string& text) {
    const SmallProject small;
    put(small.root / "exercises/01_one/milestones.md", text);
    try {
        find_step_exercises(small.root / "steps", "01_one");
    } catch (const Error& error) {
        return error.what();
    }
    return "no complaint";
}

std::string replaced(const std::string& part, const std::string& with) {
    std::string text = list;
    return text.replace(text.find(part), part.size(), with);
}

} // namespace

TEST_CASE("a milestone is read with all of its fields") {
    const std::vector<Milestone> milestones = parse_milestones(list, "milestones.md");
    REQUIRE(milestones.size() == 2);
    CHECK(milestones[1].id == "halves");
    CHECK(milestones[1].title == "it has halves");
    CHECK(milestones[1].functions == Words{"half"});
    CHECK(milestones[1].options == Words{"--view", "depth"});
    CHECK(milestones[1].shows == "two halves.");
}

TEST_CASE("exercises stand in the order of their milestones") {
    const SmallProject small;
    CHECK(find_step_exercises(small.root / "steps", "01_one").front().name == "half");
    put(small.root / "exercises/01_one/milestones.md", list);
    CHECK(find_step_exercises(small.root / "steps", "01_one").front().name == "sign");
}

TEST_CASE("a list of milestones that does not fit the exercises is refused in one line") {
    CHECK(complaint(list) == "no complaint");
    CHECK(complaint(replaced("* Write: sign", "* Write: half")).ends_with("half occurs twice"));
    CHECK(complaint(replaced("* Write: half", "* Write: quarter")).ends_with("half is missing"));
    CHECK(
        complaint(replaced("* Write: half", "* Write: half, third")).ends_with("asks for no function third"));
    CHECK(complaint(replaced("* Shows: a", "* Show: a")).find("milestones.md:7: expected") !=
          std::string::npos);
    CHECK(complaint(replaced("whole: it", "whole it")).find("milestones.md:5: a milestone") !=
          std::string::npos);
}

TEST_CASE("a milestone is reached when its functions and all before are written") {
    const std::vector<Milestone> milestones = parse_milestones(list, "milestones.md");
    CHECK(milestones_reached(milestones, {}) == 0);
    CHECK(milestones_reached(milestones, {"half"}) == 0);
    CHECK(milestones_reached(milestones, {"sign"}) == 1);
    CHECK(milestones_reached(milestones, {"half", "sign"}) == 2);
    CHECK(milestone_text(milestones, {"half", "sign"}) == "2 of 2: it has halves");
    CHECK(milestone_text(milestones, {"half"}).empty());
}
