// The picture that a step's program makes with the learner's files, against the reference.
#pragma once

#include "tools/compare/comparison.h"
#include "tools/tutor/report.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rt {

struct PictureFinding {
    bool holds = true;
    bool complete = true;           ///< of all samples
    std::string verdict;            ///< same, noise, look, different; or none, failed
    std::string reason;             ///< why there is none, or why it failed
    std::vector<std::string> lines; ///< for a person
    std::optional<compare::Comparison> judgement;
    std::filesystem::path mine, reference, map; ///< PNG files
    std::string settings;
};

/// With few samples noisy pictures are there much sooner, and their noise, which is known, hides less than one thinks.
enum class Samples { few, all };

/// Renders into `out` with the flags under which pictures of the step are compared, and judges. A program that crashes, does not
/// end or complains is a finding too. Throws Error if there is no reference.
PictureFinding judge_picture(const std::filesystem::path& root, const std::string& step,
                             const std::filesystem::path& build, const std::filesystem::path& out,
                             Samples samples);

/// The ids of the known mistakes with which the program makes the same picture; none if it is like none of them.
std::vector<std::string> alike(const std::filesystem::path& root, const std::string& step,
                               const std::filesystem::path& build, const std::filesystem::path& out);

PictureFinding no_picture(const std::string& reason);

void fill(Report& report, const PictureFinding& finding);

} // namespace rt
