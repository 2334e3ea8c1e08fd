// Renders into the build's folder, so that a picture that the learner made before stays.
#include "tools/tutor/check_picture.h"

#include "common/error.h"
#include "common/file_bytes.h"
#include "common/image_file.h"
#include "tools/tutor/process.h"

#include <algorithm>
#include <sstream>

namespace rt {

namespace fs = std::filesystem;

namespace {

constexpr int seconds_for_a_picture = 60;

/// What assets/reference/NN_name.txt says after `key: `.
std::string fact(const std::string& facts, const std::string& key) {
    std::istringstream lines(facts);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(key + ": ")) return line.substr(key.size() + 2);
    return "";
}

std::vector<std::string> split(const std::string& words) {
    std::istringstream stream(words);
    std::vector<std::string> all;
    for (std::string word; stream >> word;) all.push_back(word);
    return all;
}

PictureFinding failed(std::string reason) {
    std::ranges::replace(reason, '\n', ' ');
    PictureFinding finding = no_picture(reason);
    finding.holds = false;
    finding.verdict = "failed";
    return finding;
}

/// What kind of difference, where, and why if that is known: FLIP has a line of its own in the report.
std::vector<std::string> in_short(const Judgement& judgement) {
    std::vector<std::string> lines = judgement.lines;
    lines.resize(std::min<std::size_t>(lines.size(), 2));
    if (!judgement.explanation.empty() && judgement.explanation != none_of_these)
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

PictureFinding judge_picture(const fs::path& root, const std::string& step, const fs::path& build) {
    const fs::path references = root / "assets" / "reference", out = build / "checked";
    const std::string facts = read_file((references / (step + ".txt")).string());
    const fs::path variance = references / (step + ".variance.hdr");
    fs::create_directories(out);
    std::vector<std::string> command{(build / "bin" / step).string(), "--quiet", "--out",
                                     (out / step).string()};
    if (fs::exists(variance))
        command.insert(command.end(), {"--variance", (out / (step + ".variance.hdr")).string()});
    for (const std::string& word : split(fact(facts, "test flags"))) command.push_back(word);
    const fs::path said = build / "said.txt";
    const Ended ended = run_process(command, said, {.seconds = seconds_for_a_picture});
    if (ended.too_long)
        return failed("the program was stopped after " + std::to_string(seconds_for_a_picture) +
                      " s; does it end?");
    if (ended.code >= 128) return failed("the program crashed");
    if (ended.code != 0) return failed("the program says: " + read_file(said.string()));

    Question question{read_stored((out / (step + ".hdr")).string()),
                      read_stored((references / (step + ".hdr")).string())};
    question.step = std::stoi(step);
    if (fs::exists(variance))
        question.variances = {read_image((out / (step + ".variance.hdr")).string()),
                              read_image(variance.string())};
    PictureFinding finding;
    finding.judgement = judge(question);
    finding.verdict = name_of(finding.judgement->finding);
    finding.holds = is_same(finding.judgement->finding);
    finding.lines = in_short(*finding.judgement);
    finding.mine = out / (step + ".png");
    finding.reference = references / (step + ".png");
    finding.map = out / (step + ".map.png");
    write_image(finding.map.string(), error_map(*finding.judgement));
    finding.settings =
        fact(facts, "width") + " x " + fact(facts, "height") + ", " +
        (fact(facts, "test flags").empty() ? "the program's own settings" : fact(facts, "test flags"));
    return finding;
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
    if (finding.judgement->tiles) report.tiles_over_4 = finding.judgement->tiles->alarms;
}

} // namespace rt
