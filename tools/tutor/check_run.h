// A step's checks, run to the end whatever the code under them does: one that crashes or never ends is stopped,
// and the others go on.
#pragma once

#include "tools/tutor/diagnosis.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rt {

/// No check of ours takes longer than a tenth of this, even without optimisation.
inline constexpr int seconds_for_checks = 20;

/// A check that did not end says why in its only failure. `program` is a test executable, `said` a file for
/// what it says. Throws Error if it cannot be run.
std::vector<CheckResult> run_all_checks(const std::filesystem::path& program,
                                        const std::filesystem::path& said,
                                        int seconds = seconds_for_checks);

} // namespace rt
