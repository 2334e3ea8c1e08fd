// Gaps: the functions that a learner has not written yet. The checks see the reference's lines there, so that whatever
// fails is about a line that the learner wrote; the picture is compared with the reference cut at the same gaps.
#pragma once

#include "tools/tutor/workshop.h"

#include <map>
#include <string>
#include <vector>

namespace rt::tutor {

/// Headers that replace those of steps/: from "03_mirror/mirror.h" to the text.
using Headers = std::map<std::string, std::string>;

/// `absent`: the learner has no such file, so the reference is used; `unwritten`: the function is as it was cut.
enum class GapState { absent, unwritten, written };

struct Gap {
    Exercise exercise;
    GapState state = GapState::absent;
    std::string place; ///< "workshop/03_mirror/mirror.h:22"
};

/// Returns the functions to write of a step, in their order.
std::vector<Gap> gaps_of(const Project& project, const std::string& step);

/// Returns {"--accel", "bvh"} for the program of a step after 05, which uses the wide tree by default, if the learner has
/// written bvh.h and nothing of step 05 is missing; nothing otherwise, and if the `given` flags choose.
Words own_tree_flags(const Project& project, const std::string& step, const Words& given = {});

/// Returns the learner's headers of the steps up to `step` as they are, with #line directives.
Headers own_headers(const Project& project, const std::string& step);

/// Returns the learner's headers of the steps up to `step`, with the reference's lines in place of functions that are
/// not written yet. #line directives keep file names and line numbers as the learner knows them.
Headers filled_headers(const Project& project, const std::string& step);

/// Returns the learner's headers of `step` alone, in which only these functions (names of exercises) are the learner's:
/// shows whose fault a failing check is. What cannot be told apart stays the learner's.
Headers isolated_headers(const Project& project, const std::string& step, const Words& functions);

/// Returns the reference's headers with the gaps that the learner's headers have.
Headers cut_headers(const Project& project, const std::string& step);

} // namespace rt::tutor
