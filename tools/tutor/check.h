// ./learn check: builds what a step needs on the learner's files, runs its checks, renders, compares, and says what is
// likely wrong.
#pragma once

#include "tools/tutor/workshop.h"

#include <filesystem>
#include <ostream>
#include <string>

namespace rt {

struct CheckWish {
    std::string step;
    std::filesystem::path build; ///< a configured build with the checks of all steps
    bool picture = true;         ///< false: the checks alone
};

/// Answers the exit code: 0 if all holds, 1 if not. Writes workshop/.state and workshop/report/NN_name.html. Throws
/// Error for what is no fault of the learner's code.
int check_step(const Project& project, const CheckWish& wish, std::ostream& out);

} // namespace rt
