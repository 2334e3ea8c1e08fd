// Runs all checks even if some crash or hang, and renders the picture of a step and compares it.
#include "common/image/image_file.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/build.h"
#include "tools/tutor/catalogue.h"
#include "tools/tutor/check_parts.h"
#include "tools/tutor/system.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

std::string reason(const ProcessResult& result, int seconds) {
    if (result.timed_out)
        return "stopped after " + std::to_string(seconds) +
               " s because it did not finish (an endless loop or recursion?)";
    return result.crash.empty() ? "the program exited with code " + std::to_string(result.code)
                                : result.crash;
}

CheckResult not_run() {
    CheckResult rest;
    rest.name = "all remaining checks";
    rest.failures = {
        {"", "", "not run, because " + std::to_string(most_endless) + " checks did not finish", {}}};
    return rest;
}

} // namespace

std::vector<CheckResult> run_all_checks(const std::filesystem::path& program,
                                        const std::filesystem::path& log, int seconds) {
    const ProcessOptions options{.log = log, .seconds = seconds, .memory = std::uint64_t(8) << 30};
    std::vector<CheckResult> all;
    wait_for_program(program);
    for (int endless = 0;;) {
        const ProcessResult result = run_process(
            {program.string(), "--reporters=lines", "--first=" + std::to_string(all.size() + 1)}, options);
        std::vector<CheckResult> some = parse_results(read_file(log.string()));
        const bool broken_off = !some.empty() && some.back().state == CheckState::unfinished;
        if (broken_off) {
            some.back().failures = {{program.filename().string(), "", reason(result, seconds), {}}};
            if (result.timed_out) some.back().state = CheckState::endless;
        }
        all.insert(all.end(), some.begin(), some.end());
        if (!broken_off) break;
        if (result.timed_out && ++endless == most_endless) {
            all.push_back(not_run());
            break;
        }
    }
    if (all.empty()) throw Error(program.string() + " ran no checks; build it again");
    return all;
}

namespace {

constexpr int seconds_for_a_picture = 60;
const std::string few_samples = "2"; // the minimum for a variance

/// Returns the flags with the number of samples replaced; unchanged if `samples` is empty.
Words with_samples(Words flags, const std::string& samples) {
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

/// Returns the verdict, the location, and the explanation if there is one. The report shows FLIP on
/// a separate line.
Words summary_lines(const compare::Comparison& comparison) {
    Words lines = comparison.lines;
    lines.resize(std::min<std::size_t>(lines.size(), 2));
    if (!comparison.explanation.empty() && comparison.explanation != compare::none_of_these)
        lines.push_back("likely cause: " + comparison.explanation);
    return lines;
}

} // namespace

PictureFinding no_picture(const std::string& reason) {
    PictureFinding finding;
    finding.verdict = "none";
    finding.reason = reason;
    finding.lines = {"no picture: " + reason};
    return finding;
}

compare::Comparison compare_render(const fs::path& root, const std::string& step, const fs::path& folder) {
    const fs::path references = root / "assets" / "reference";
    const std::string picture = step + ".hdr", variance = step + ".variance.hdr";
    compare::ComparisonInput input{compare::read_encoded((folder / picture).string()),
                                   compare::read_encoded((references / picture).string())};
    input.step = std::atoi(step.c_str());
    if (fs::exists(references / variance))
        input.variances = {read_image((folder / variance).string()),
                           read_image((references / variance).string())};
    return compare::compare_images(input);
}

PictureFinding render_and_compare(const fs::path& root, const std::string& step, const fs::path& build,
                                  const fs::path& out, Samples samples) {
    const fs::path references = root / "assets" / "reference";
    const fs::path variance = references / (step + ".variance.hdr");
    Words command{(build / "bin" / step).string(), "--quiet", "--out", (out / step).string()};
    if (fs::exists(variance))
        command.insert(command.end(), {"--variance", (out / (step + ".variance.hdr")).string()});
    const bool preview = samples == Samples::few && fs::exists(variance);
    for (const std::string& word :
         with_samples(words_in(reference_fact(root, step, "test flags")), preview ? few_samples : ""))
        command.push_back(word);
    const fs::path log = out / "log.txt";
    wait_for_program(command[0]);
    const ProcessResult result = run_process(command, {.log = log, .seconds = seconds_for_a_picture});
    if (result.timed_out)
        return failed("the program was stopped after " + std::to_string(seconds_for_a_picture) +
                      " s; is there an endless loop?");
    if (result.code >= 128) return failed("the program crashed");
    if (result.code != 0) return failed("the program reports: " + read_file(log.string()));

    PictureFinding finding;
    finding.comparison = compare_render(root, step, out);
    finding.complete = !preview;
    finding.verdict = compare::name_of(finding.comparison->verdict);
    finding.holds = compare::is_same(finding.comparison->verdict);
    finding.lines = summary_lines(*finding.comparison);
    finding.mine = out / (step + ".png");
    finding.reference = references / (step + ".png");
    finding.map = out / (step + ".map.png");
    write_image(finding.map.string(), compare::error_map(*finding.comparison));
    finding.settings =
        reference_fact(root, step, "width") + " x " + reference_fact(root, step, "height") + ", " +
        (reference_fact(root, step, "test flags").empty() ? "the program's default settings"
                                                          : reference_fact(root, step, "test flags"));
    return finding;
}

Words similar_mistakes(const fs::path& root, const std::string& step, const fs::path& build,
                       const fs::path& out) {
    const fs::path picture = out / (step + ".small.png");
    Words command{(build / "bin" / step).string(), "--quiet", "--out", picture.string()};
    for (const std::string& word : gallery_flags(root, step)) command.push_back(word);
    const ProcessResult result =
        run_process(command, {.log = out / "log.txt", .seconds = seconds_for_a_picture});
    return result.code == 0 ? nearest_mistake(root, step, picture).names : Words();
}

} // namespace rt::tutor
