// Runs checks again after one that broke off, and renders into a folder of its own.
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
               " s: it does not end (a loop or a recursion without end?)";
    return result.crash.empty() ? "ended with code " + std::to_string(result.code) + " in the middle of it"
                                : result.crash;
}

CheckResult not_run() {
    CheckResult rest;
    rest.name = "all checks after that one";
    rest.failures = {
        {"", "", "not run, since " + std::to_string(most_endless) + " before them did not end", {}}};
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
    if (all.empty()) throw Error(program.string() + " ran no check: build it anew");
    return all;
}

namespace {

constexpr int seconds_for_a_picture = 60;
const std::string few_samples = "2"; // fewer have no variance

/// The flags with another number of samples, unless that is empty.
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

/// What kind of difference, where, and why if that is known: FLIP has a line of its own in the report.
Words in_short(const compare::Comparison& judgement) {
    Words lines = judgement.lines;
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

compare::Comparison judge_render(const fs::path& root, const std::string& step, const fs::path& folder) {
    const fs::path references = root / "assets" / "reference";
    const std::string picture = step + ".hdr", variance = step + ".variance.hdr";
    compare::ComparisonInput question{compare::read_encoded((folder / picture).string()),
                                      compare::read_encoded((references / picture).string())};
    question.step = std::atoi(step.c_str());
    if (fs::exists(references / variance))
        question.variances = {read_image((folder / variance).string()),
                              read_image((references / variance).string())};
    return compare::compare_images(question);
}

PictureFinding judge_picture(const fs::path& root, const std::string& step, const fs::path& build,
                             const fs::path& out, Samples samples) {
    const fs::path references = root / "assets" / "reference";
    const fs::path variance = references / (step + ".variance.hdr");
    Words command{(build / "bin" / step).string(), "--quiet", "--out", (out / step).string()};
    if (fs::exists(variance))
        command.insert(command.end(), {"--variance", (out / (step + ".variance.hdr")).string()});
    const bool glimpse = samples == Samples::few && fs::exists(variance);
    for (const std::string& word :
         with_samples(words_in(reference_fact(root, step, "test flags")), glimpse ? few_samples : ""))
        command.push_back(word);
    const fs::path log = out / "said.txt";
    wait_for_program(command[0]);
    const ProcessResult result = run_process(command, {.log = log, .seconds = seconds_for_a_picture});
    if (result.timed_out)
        return failed("the program was stopped after " + std::to_string(seconds_for_a_picture) +
                      " s; does it end?");
    if (result.code >= 128) return failed("the program crashed");
    if (result.code != 0) return failed("the program says: " + read_file(log.string()));

    PictureFinding finding;
    finding.judgement = judge_render(root, step, out);
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

Words similar_mistakes(const fs::path& root, const std::string& step, const fs::path& build,
                       const fs::path& out) {
    const fs::path picture = out / (step + ".small.png");
    Words command{(build / "bin" / step).string(), "--quiet", "--out", picture.string()};
    for (const std::string& word : gallery_flags(root, step)) command.push_back(word);
    const ProcessResult result =
        run_process(command, {.log = out / "said.txt", .seconds = seconds_for_a_picture});
    return result.code == 0 ? nearest_mistake(root, step, picture).names : Words();
}

} // namespace rt::tutor
