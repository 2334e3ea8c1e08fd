// Renders into a folder of its own, so that a picture that the learner made before stays.
#include "tools/tutor/check_picture.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/image/image_file.h"
#include "tools/tutor/build_lock.h"
#include "tools/tutor/gallery.h"
#include "tools/tutor/process.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace rt {

namespace fs = std::filesystem;

namespace {

constexpr int seconds_for_a_picture = 60;
const std::string few_samples = "2"; // fewer have no variance

std::vector<std::string> split(const std::string& words) {
    std::istringstream stream(words);
    std::vector<std::string> all;
    for (std::string word; stream >> word;) all.push_back(word);
    return all;
}

/// The flags with another number of samples, unless that is empty.
std::vector<std::string> with_samples(std::vector<std::string> flags, const std::string& samples) {
    if (samples.empty()) return flags;
    const auto old = std::ranges::find(flags, "--samples");
    if (old != flags.end()) flags.erase(old, old + 2);
    flags.insert(flags.end(), {"--samples", samples});
    return flags;
}

PictureFinding failed(std::string reason) {
    std::ranges::replace(reason, '\n', ' ');
    PictureFinding finding = no_picture(reason);
    finding.holds = false;
    finding.verdict = "failed";
    return finding;
}

/// What kind of difference, where, and why if that is known: FLIP has a line of its own in the report.
std::vector<std::string> in_short(const compare::Comparison& judgement) {
    std::vector<std::string> lines = judgement.lines;
    lines.resize(std::min<std::size_t>(lines.size(), 2));
    if (!judgement.explanation.empty() && judgement.explanation != compare::none_of_these)
        lines.push_back("explanation: " + judgement.explanation);
    return lines;
}

} // namespace

PictureFinding no_picture(const std::string& reason) {
    PictureFinding finding;
    finding.verdict = "none";
    finding.reason = reason;
    finding.lines = {"none: " + reason};
    return finding;
}

PictureFinding judge_picture(const fs::path& root, const std::string& step, const fs::path& build,
                             const fs::path& out, Samples samples) {
    const fs::path references = root / "assets" / "reference";
    const fs::path variance = references / (step + ".variance.hdr");
    std::vector<std::string> command{(build / "bin" / step).string(), "--quiet", "--out",
                                     (out / step).string()};
    if (fs::exists(variance))
        command.insert(command.end(), {"--variance", (out / (step + ".variance.hdr")).string()});
    const bool glimpse = samples == Samples::few && fs::exists(variance);
    for (const std::string& word :
         with_samples(split(reference_fact(root, step, "test flags")), glimpse ? few_samples : ""))
        command.push_back(word);
    const fs::path said = out / "said.txt";
    await_program(command[0]);
    const Ended ended = run_process(command, said, {.seconds = seconds_for_a_picture});
    if (ended.too_long)
        return failed("the program was stopped after " + std::to_string(seconds_for_a_picture) +
                      " s; does it end?");
    if (ended.code >= 128) return failed("the program crashed");
    if (ended.code != 0) return failed("the program says: " + read_file(said.string()));

    compare::ComparisonInput question{compare::read_encoded((out / (step + ".hdr")).string()),
                                      compare::read_encoded((references / (step + ".hdr")).string())};
    question.step = std::atoi(step.c_str());
    if (fs::exists(variance))
        question.variances = {read_image((out / (step + ".variance.hdr")).string()),
                              read_image(variance.string())};
    PictureFinding finding;
    finding.judgement = compare::compare_images(question);
    finding.complete = !glimpse;
    finding.verdict = compare::name_of(finding.judgement->verdict);
    finding.holds = compare::is_same(finding.judgement->verdict);
    finding.lines = in_short(*finding.judgement);
    finding.mine = out / (step + ".png");
    finding.reference = references / (step + ".png");
    finding.map = out / (step + ".map.png");
    write_image(finding.map.string(), compare::error_map(*finding.judgement));
    finding.settings =
        reference_fact(root, step, "width") + " x " + reference_fact(root, step, "height") + ", " +
        (reference_fact(root, step, "test flags").empty() ? "the program's own settings"
                                                          : reference_fact(root, step, "test flags"));
    return finding;
}

std::vector<std::string> alike(const fs::path& root, const std::string& step, const fs::path& build,
                               const fs::path& out) {
    const fs::path picture = out / (step + ".small.png");
    std::vector<std::string> command{(build / "bin" / step).string(), "--quiet", "--out", picture.string()};
    for (const std::string& word : gallery_flags(root, step)) command.push_back(word);
    const Ended ended = run_process(command, out / "said.txt", {.seconds = seconds_for_a_picture});
    return ended.code == 0 ? nearest_mistake(root, step, picture).names : std::vector<std::string>();
}

void fill(Report& report, const PictureFinding& finding) {
    report.verdict = finding.judgement ? finding.verdict : finding.reason;
    report.verdict_lines = finding.lines;
    report.mine = finding.mine;
    report.reference = finding.reference;
    report.map = finding.map;
    report.settings = finding.settings;
    if (!finding.judgement) return;
    report.flip_mean = finding.judgement->flip.mean;
    report.flip_max = finding.judgement->flip.max;
    if (finding.judgement->tiles) report.tiles_over_4 = finding.judgement->tiles->outliers;
}

} // namespace rt
