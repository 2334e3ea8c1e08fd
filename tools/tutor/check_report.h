// What ./learn check finds out, and its page.
#pragma once

#include "tools/tutor/check_parts.h"
#include "tools/tutor/commands.h"
#include "tools/tutor/compile_help.h"
#include "tools/tutor/toolchain.h"

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rt::tutor {

/// The results of one file of checks.
struct CheckedFile {
    std::string source; ///< "tests/03_mirror/mirror.cpp"
    std::vector<CheckResult> results;
};

/// A function of the learner's that fails checks even alone among the reference's.
struct RedFunction {
    std::string name;
    int failing = 0; ///< how many checks it fails
    Diagnosis diagnosis;
};

struct EarlierStep {
    std::string step;
    int passed = 0, failed = 0;
    std::string first; ///< the first check that fails
};

/// Everything that one run finds out.
struct Findings {
    std::filesystem::path scratch; ///< a temporary folder for this run
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
    std::vector<Gap> gaps;
    std::vector<CheckedFile> files;
    std::vector<CheckResult> checks; ///< of all files
    bool complete = true;            ///< false: only those of the file that was saved last
    std::vector<RedFunction> red;
    std::vector<EarlierStep> earlier;
    PictureFinding picture;
    std::optional<Mistake> mistake; ///< the most likely mistake
    std::string confidence;
    Words similar_mistakes; ///< mistakes that produce the same picture
    std::string next;
};

/// Writes workshop/report/NN_name.html, and NN_name.js, by which an open page finds out that it is old. Returns the
/// page's path. Throws Error.
std::filesystem::path write_report(const Project& project, const CheckOptions& options,
                                   const Findings& findings);

} // namespace rt::tutor
