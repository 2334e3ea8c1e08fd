// What ./learn check runs: the checks of a step, whatever the code under them does, and the step's program.
#pragma once

#include "tools/compare/comparison.h"
#include "tools/tutor/diagnosis.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rt::tutor {

/// All checks of a step together take a fifth of this at most.
inline constexpr int seconds_for_checks = 10;

/// After so many checks that had to be stopped the others are not run: somebody waits.
inline constexpr int most_endless = 3;

/// A check that did not end says why in its only failure. `program` is a test executable, `log` a file for
/// what it says. Throws Error if it cannot be run.
std::vector<CheckResult> run_all_checks(const std::filesystem::path& program,
                                        const std::filesystem::path& log, int seconds = seconds_for_checks);

struct PictureFinding {
    bool holds = true;
    bool complete = true; ///< of all samples
    std::string verdict;  ///< same, noise, look, different; or none, failed
    std::string reason;   ///< why there is none, or why it failed
    Words lines;          ///< for a person
    std::optional<compare::Comparison> judgement;
    std::filesystem::path mine, reference, map; ///< PNG files
    std::string settings;
};

/// Judges STEP.hdr in `folder`, with STEP.variance.hdr if the step is noisy, against the step's reference.
/// Throws Error.
compare::Comparison judge_render(const std::filesystem::path& root, const std::string& step,
                                 const std::filesystem::path& folder);

/// With few samples noisy pictures are there much sooner, and their noise, which is known, hides less than
/// one thinks.
enum class Samples { few, all };

/// Renders into `out` with the flags under which pictures of the step are compared, and judges. A program
/// that crashes, does not end or complains is a finding too. Throws Error if there is no reference.
PictureFinding judge_picture(const std::filesystem::path& root, const std::string& step,
                             const std::filesystem::path& build, const std::filesystem::path& out,
                             Samples samples);

/// The ids of the known mistakes with which the program makes the same picture; none if it is like none of
/// them.
Words similar_mistakes(const std::filesystem::path& root, const std::string& step,
                       const std::filesystem::path& build, const std::filesystem::path& out);

PictureFinding no_picture(const std::string& reason);

} // namespace rt::tutor
