// A step's checks, run to the end whatever the code under them does: one that crashes or never ends is stopped,
// and the others go on.
#pragma once

#include "tools/tutor/diagnosis.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rt {

/// All checks of a step together take a fifth of this at most.
inline constexpr int seconds_for_checks = 10;

/// After so many checks that had to be stopped the others are not run: somebody waits.
inline constexpr int most_endless = 3;

/// A check that did not end says why in its only failure. `program` is a test executable, `said` a file for
/// what it says. Throws Error if it cannot be run.
std::vector<CheckResult> run_all_checks(const std::filesystem::path& program,
                                        const std::filesystem::path& said, int seconds = seconds_for_checks);

} // namespace rt
