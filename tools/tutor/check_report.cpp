// Collects the findings of a check as JSON for the report.
#include "tools/tutor/check_report.h"

#include "common/util/file_bytes.h"
#include "tools/tutor/report.h"

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

Json check_json(const CheckResult& check) {
    const bool ended = check.state == CheckState::ok || check.state == CheckState::failed ||
                       check.state == CheckState::skipped;
    Words lines;
    for (const Failure& failure : check.failures) {
        lines.push_back(failure.expression + ": " + four_digits(failure.values));
        for (const std::string& note : failure.notes) lines.push_back(four_digits(note));
    }
    if (!check.cause.empty()) lines.push_back(check.cause);
    return {{"name", check.name},
            {"state", !ended                          ? "unfinished"
                      : check.state == CheckState::ok ? "ok"
                      : has_failed(check)             ? "failed"
                                                      : "skipped"},
            {"seconds", check.seconds},
            {"lines", lines}};
}

Json mistake_json(const Project& project, const Findings& findings) {
    if (!findings.mistake) return nullptr;
    const Mistake& mistake = *findings.mistake;
    return {{"title", mistake.title},
            {"confidence", findings.confidence},
            {"shows", mistake.shows},
            {"why", mistake.why},
            {"fix", mistake.fix},
            {"picture", text_of(gallery_picture(project.root, mistake.step, mistake.id))}};
}

Words earlier_lines(const Findings& findings) {
    Words lines;
    for (const EarlierStep& earlier : findings.earlier)
        lines.push_back(earlier.step + ": " +
                        part_of(std::size_t(earlier.passed), std::size_t(earlier.passed + earlier.failed)) +
                        " checks pass");
    return lines;
}

} // namespace

fs::path write_report(const Project& project, const CheckOptions& options, const Findings& findings) {
    const PictureFinding& picture = findings.picture;
    const std::string stamp = std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
    Json report{{"step", options.step},
                {"stamp", stamp},
                {"question", question_of(project, options.step)},
                {"own_files", Json::array()},
                {"checks", Json::array()},
                {"earlier", earlier_lines(findings)},
                {"verdict", picture.comparison ? picture.verdict : picture.reason},
                {"verdict_lines", picture.lines},
                {"flip_mean", picture.comparison ? picture.comparison->flip.mean : 0},
                {"flip_max", picture.comparison ? picture.comparison->flip.max : 0},
                {"tiles_over_4", nullptr},
                {"mistake", mistake_json(project, findings)},
                {"next", findings.next},
                {"settings", picture.settings},
                {"pictures",
                 {{"mine", text_of(picture.mine)},
                  {"reference", text_of(picture.reference)},
                  {"map", text_of(picture.map)}}}};
    for (const std::string& file : own_files(project, options.step))
        report["own_files"].push_back(options.step + "/" + file);
    for (const CheckResult& check : findings.checks) report["checks"].push_back(check_json(check));
    if (picture.comparison && picture.comparison->tiles)
        report["tiles_over_4"] = picture.comparison->tiles->outliers;
    const fs::path folder = project.workshop / "report", path = folder / (options.step + ".html");
    make_folder(folder);
    write_file(text_of(path), report_html(project.root, report));
    write_file(text_of(folder / (options.step + ".js")),
               "newest(\"" + stamp + "\");\n"); // open pages run it
    return path;
}

} // namespace rt::tutor
