// ./learn status: lists the eight steps with their state, and what to do next.
#include "tools/tutor/commands.h"

#include "common/util/file_bytes.h"
#include "tools/tutor/milestones.h"

#include <algorithm>
#include <iomanip>

namespace rt::tutor {

namespace {

struct StepStatus {
    std::string step;
    int begun = 0;         ///< exercises in the learner's files that are no longer as in the stub
    int exercises = 0;     ///< all exercises in the learner's files
    int in_step = 0;       ///< exercises in all files of the step
    Words written;         ///< the names of those that are begun
    std::string milestone; ///< "2 of 6: rays hit the balls"; empty if none is reached
    std::string to_write;  ///< the place of the first unwritten exercise; empty if there is none
    bool has_files = false;
    bool checked = false;
    bool changed = false; ///< the files have changed since the last check
    LastCheck check;

    bool done() const { return checked && !changed && all_well(check); }
};

void count_exercises(const Project& project, StepStatus& status) {
    const Words files = own_files(project, status.step);
    status.has_files = !files.empty();
    for (const Exercise& exercise : exercises_of(project, status.step)) {
        ++status.in_step;
        if (std::ranges::find(files, exercise.file) == files.end()) continue;
        ++status.exercises;
        const auto path = project.workshop / status.step / exercise.file;
        const std::string text = read_file(text_of(path));
        const std::string reference = read_file(text_of(steps_folder(project) / status.step / exercise.file));
        if (!is_untouched(exercise, text, make_stub(reference, find_exercises(reference, text_of(path)))))
            ++status.begun, status.written.push_back(exercise.name);
        else if (status.to_write.empty())
            status.to_write = exercise.name + " in " + display_path(path, line_of(exercise, text));
    }
}

std::vector<StepStatus> all_statuses(const Project& project) {
    const std::map<std::string, LastCheck> checks = read_checks(project);
    std::vector<StepStatus> all;
    for (const std::string& step : all_steps(project)) {
        StepStatus status{.step = step};
        count_exercises(project, status);
        status.milestone = milestone_text(read_milestones(project.root, step), status.written);
        if (const auto check = checks.find(step); check != checks.end()) {
            status.checked = true;
            status.check = check->second;
            status.changed = check->second.fingerprint != fingerprint(project, step);
        }
        all.push_back(status);
    }
    return all;
}

std::string verdict_words(const std::string& verdict) {
    if (verdict == "same") return "the picture matches the reference";
    if (verdict == "noise") return "the picture matches the reference up to noise";
    if (verdict == "look") return "the picture almost matches; look at the report";
    if (verdict == "different") return "the picture is wrong";
    return "the picture was not compared";
}

std::string status_text(const StepStatus& s) {
    if (!s.has_files) return "not started";
    std::string text = std::to_string(s.begun) + " of " + std::to_string(s.exercises) + " functions started";
    if (s.exercises == 0) text = "started";
    if (!s.milestone.empty()) text += ", milestone " + s.milestone;
    if (s.exercises < s.in_step)
        text += ", " + std::to_string(s.in_step - s.exercises) + " more from the reference";
    if (!s.checked) return text + "; not checked yet";
    text += "; " + std::to_string(s.check.passed) + " of " + std::to_string(s.check.passed + s.check.failed) +
            " checks passed, " + verdict_words(s.check.verdict);
    return text + (s.changed ? "; changed since then" : "");
}

/// Returns what to do next: first finish a step that was started, then start the one after the last
/// that is done.
std::string next_action(const std::vector<StepStatus>& all) {
    const auto number = [](const StepStatus& s) { return number_of(s.step); };
    const auto begun = [](const StepStatus& s) { return s.has_files && !s.done(); };
    const auto open = std::ranges::find_if(all, begun);
    if (open != all.end() && !open->to_write.empty())
        return "write " + open->to_write + "; then ./learn check " + number(*open);
    if (open != all.end()) return "./learn check " + number(*open);
    const auto done = [](const StepStatus& s) { return s.has_files && s.done(); };
    auto from = all.begin();
    for (auto s = all.begin(); s != all.end(); ++s)
        if (done(*s)) from = s + 1;
    if (from != all.end()) return "./learn start " + number(*from);
    const auto skipped = std::ranges::find_if_not(all, done);
    if (skipped != all.end()) return "./learn start " + number(*skipped);
    return "./learn course, which makes a page of your eight pictures to share";
}

} // namespace

Words open_steps(const Project& project) {
    Words open;
    for (const StepStatus& status : all_statuses(project))
        if (!status.has_files || !status.done()) open.push_back(status.step);
    return open;
}

void show_status(const Project& project, std::ostream& out) {
    const std::vector<StepStatus> all = all_statuses(project);
    for (const StepStatus& status : all)
        out << (status.has_files && status.done() ? "done  " : "      ") << std::left << std::setw(16)
            << status.step << status_text(status) << "\n";
    if (open_steps(project).empty()) out << "\nAll steps hold: you have written a path tracer.\n";
    out << "\nnext: " << next_action(all) << "\n";
}

} // namespace rt::tutor
