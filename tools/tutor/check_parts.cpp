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
               " s of processor time: an endless loop or recursion?";
    return result.crash.empty()
               ? "ended with exit code " + std::to_string(result.code) + " in the middle of the check"
               : result.crash;
}

CheckResult not_run() {
    CheckResult rest;
    rest.name = "all checks after it";
    rest.state = CheckState::endless;
    rest.failures = {{"", "", "not run, since the check before them did not end", {}}};
    return rest;
}

} // namespace

std::vector<CheckResult> run_all_checks(const fs::path& program, const fs::path& log, int seconds) {
    const ProcessOptions options{
        .log = log, .cpu_seconds = 20 * seconds, .seconds = 300, .memory = std::uint64_t(8) << 30};
    std::vector<CheckResult> all;
    wait_for_program(program);
    while (true) {
        const ProcessResult result =
            run_process({text_of(program), "--reporters=lines", "--first=" + std::to_string(all.size() + 1),
                         "--seconds-per-check=" + std::to_string(seconds)},
                        options);
        std::vector<CheckResult> some = parse_results(read_file(text_of(log)));
        const bool crashed = result.code >= 128; // doctest may still have ended the check
        if (some.empty() || (!crashed && some.back().state != CheckState::unfinished)) {
            append(all, some);
            break;
        }
        some.back().failures = {{text_of(program.filename()), "", reason(result, seconds), {}}};
        some.back().state = result.timed_out ? CheckState::endless : CheckState::unfinished;
        append(all, some);
        if (!result.timed_out) continue;
        all.push_back(not_run());
        break;
    }
    if (all.empty()) throw Error(text_of(program) + " ran no checks; it may be out of date: build it again");
    return all;
}

namespace {

constexpr int seconds_for_a_picture = 60; // of processor time: a busy machine is no endless loop
const std::string few_samples = "2";      // the minimum for a variance

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

fs::path reference_folder(const fs::path& root) {
    return root / "assets" / "reference";
}

std::optional<std::string> render(const RenderJob& job) {
    Words command{text_of(job.program), "--quiet", "--out", text_of(job.out / job.step)};
    const bool noisy = fs::exists(reference_folder(job.root) / (job.step + ".variance.hdr"));
    if (noisy) append(command, {"--variance", text_of(job.out / (job.step + ".variance.hdr"))});
    append(command, with_samples(words_in(reference_fact(job.root, job.step, "test flags")),
                                 noisy && job.samples == Samples::few ? few_samples : ""));
    append(command, job.flags);
    const fs::path log = job.out / "log.txt";
    wait_for_program(path_of(command[0]));
    const ProcessResult result =
        run_process(command, {.log = log, .cpu_seconds = seconds_for_a_picture, .seconds = 300});
    if (result.timed_out)
        return "the program did not finish within " + std::to_string(seconds_for_a_picture) +
               " s of processor time; is there an endless loop?";
    if (result.code >= 128) return "the program crashed";
    if (result.code != 0) return "the program failed: " + read_file(text_of(log));
    return std::nullopt;
}

compare::Comparison compare_render(const RenderJob& job) {
    const std::string picture = job.step + ".hdr", variance = job.step + ".variance.hdr";
    compare::ComparisonInput input{compare::read_encoded(text_of(job.out / picture)),
                                   compare::read_encoded(text_of(job.references / picture))};
    input.step = std::atoi(job.step.c_str());
    if (fs::exists(job.references / variance))
        input.variances = {read_image(text_of(job.out / variance)),
                           read_image(text_of(job.references / variance))};
    return compare::compare_images(input);
}

PictureFinding render_and_compare(const RenderJob& job) {
    if (const auto reason = render(job)) return failed(*reason);
    PictureFinding finding;
    finding.comparison = compare_render(job);
    finding.complete =
        job.samples == Samples::all || !fs::exists(job.references / (job.step + ".variance.hdr"));
    finding.verdict = compare::name_of(finding.comparison->verdict);
    finding.holds = compare::is_same(finding.comparison->verdict);
    finding.lines = summary_lines(*finding.comparison);
    finding.mine = job.out / (job.step + ".png");
    finding.reference = job.references / (job.step + ".png");
    finding.map = job.out / (job.step + ".map.png");
    write_image(text_of(finding.map), compare::error_map(*finding.comparison));
    const auto fact = [&](const char* key) { return reference_fact(job.root, job.step, key); };
    finding.settings = fact("width") + " x " + fact("height") + ", " +
                       (fact("test flags").empty() ? "the program's own settings" : fact("test flags"));
    return finding;
}

Words similar_mistakes(const RenderJob& job) {
    const fs::path picture = job.out / (job.step + ".small.png");
    Words command{text_of(job.program), "--quiet", "--out", text_of(picture)};
    append(command, gallery_flags(job.root, job.step));
    const ProcessResult result = run_process(
        command, {.log = job.out / "log.txt", .cpu_seconds = seconds_for_a_picture, .seconds = 300});
    return result.code == 0 ? nearest_mistake(job.root, job.step, picture).names : Words();
}

} // namespace rt::tutor
