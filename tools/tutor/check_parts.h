// The parts of ./learn check that run code: the checks of a step and its program, even if they crash or hang.
#pragma once

#include "tools/compare/comparison.h"
#include "tools/tutor/diagnosis.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rt::tutor {

/// Time limit of a file of checks, in seconds. The checks of a whole step take at most a fifth of it.
inline constexpr int seconds_for_checks = 10;

/// After this many checks that did not finish, the remaining ones are not run, since the learner is waiting.
inline constexpr int most_endless = 3;

/// Runs all checks of a test executable and restarts it after each check that crashes or hangs; such a
/// check has one failure, which says why. `log` is a file for the output. Throws Error if the program
/// cannot be run.
std::vector<CheckResult> run_all_checks(const std::filesystem::path& program,
                                        const std::filesystem::path& log, int seconds = seconds_for_checks);

struct PictureFinding {
    bool holds = true;
    bool complete = true; ///< rendered with all samples
    std::string verdict;  ///< same, noise, look, different; or none, failed
    std::string reason;   ///< why there is no picture, or why rendering failed
    Words lines;          ///< text for the learner
    std::optional<compare::Comparison> comparison;
    std::filesystem::path mine, reference, map; ///< PNG files
    std::string settings;
};

/// Compares STEP.hdr in `folder` with the step's reference, using STEP.variance.hdr if the step is
/// noisy. Throws Error.
compare::Comparison compare_render(const std::filesystem::path& root, const std::string& step,
                                   const std::filesystem::path& folder);

/// How many samples to render. Few samples give a noisy preview much sooner; since its noise is known, it
/// still reveals most mistakes.
enum class Samples { few, all };

/// Renders into `out` with the step's test flags, and compares with the reference. If the program crashes,
/// hangs or fails, the finding says so. Throws Error if there is no reference.
PictureFinding render_and_compare(const std::filesystem::path& root, const std::string& step,
                                  const std::filesystem::path& build, const std::filesystem::path& out,
                                  Samples samples);

/// Returns the ids of the known mistakes that produce the same picture as the program.
Words similar_mistakes(const std::filesystem::path& root, const std::string& step,
                       const std::filesystem::path& build, const std::filesystem::path& out);

PictureFinding no_picture(const std::string& reason);

} // namespace rt::tutor
