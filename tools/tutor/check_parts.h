// The parts of ./learn check that run code: the checks of a step and its program, even if they crash or hang.
#pragma once

#include "tools/compare/comparison.h"
#include "tools/tutor/diagnosis.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rt::tutor {

/// A check that uses more processor time than this many seconds is stopped; each uses a fraction of it. A busy machine
/// does not count.
inline constexpr int seconds_per_check = 5;

/// Runs all checks of a test executable and restarts it after each check that crashes; such a check has one failure,
/// which says why. After a check that does not end the remaining ones are not run, since the learner is waiting. `log`
/// is a file for the output. Throws Error if the program cannot be run.
std::vector<CheckResult> run_all_checks(const std::filesystem::path& program,
                                        const std::filesystem::path& log, int seconds = seconds_per_check);

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

/// How many samples to render. Few samples give a noisy preview much sooner; since its noise is known, it
/// still reveals most mistakes.
enum class Samples { few, all };

/// What to render and what to compare it with.
struct RenderJob {
    std::filesystem::path root;
    std::string step;
    std::filesystem::path program; ///< of the step
    std::filesystem::path
        references;            ///< the folder of STEP.hdr, STEP.png and, for a noisy step, STEP.variance.hdr
    std::filesystem::path out; ///< a folder for the same files of the program
    Samples samples = Samples::all;
    Words flags = {}; ///< further flags, which do not change the picture
};

/// Returns the folder of the step's references.
std::filesystem::path reference_folder(const std::filesystem::path& root);

/// Renders STEP.hdr and the others with the step's test flags. Returns why there is no picture: the program crashed,
/// hung or failed; or nothing.
std::optional<std::string> render(const RenderJob& job);

/// Compares what was rendered with the references. Throws Error.
compare::Comparison compare_render(const RenderJob& job);

/// Renders and compares. If the program crashes, hangs or fails, the finding says so. Throws Error if there is no
/// reference.
PictureFinding render_and_compare(const RenderJob& job);

/// Returns the ids of the known mistakes that produce the same picture as the program.
Words similar_mistakes(const RenderJob& job);

PictureFinding no_picture(const std::string& reason);

} // namespace rt::tutor
