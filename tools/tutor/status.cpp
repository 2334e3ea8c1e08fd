// ./learn status: the eight steps, what is done in each, and what is next.
#include "tools/tutor/commands.h"

#include "common/util/file_bytes.h"

#include <algorithm>
#include <iomanip>

namespace rt {

namespace {

struct Standing {
    std::string step;
    int begun = 0;        ///< exercises of the learner's files that differ from their placeholder
    int exercises = 0;    ///< in the learner's files
    int in_step = 0;      ///< in all files of the step
    std::string to_write; ///< the place of the first exercise that nobody has touched; empty if there is none
    bool has_files = false;
    bool checked = false;
    bool changed = false; ///< since that check
    LastCheck check;

    bool done() const { return checked && !changed && all_well(check); }
};

void count_exercises(const Project& project, Standing& standing) {
    const std::vector<std::string> files = own_files(project, standing.step);
    standing.has_files = !files.empty();
    for (const Exercise& exercise : exercises_of(project, standing.step)) {
        ++standing.in_step;
        if (std::ranges::find(files, exercise.file) == files.end()) continue;
        ++standing.exercises;
        const auto path = project.workshop / standing.step / exercise.file;
        const std::string text = read_file(path.string());
        const std::string reference =
            read_file((steps_folder(project) / standing.step / exercise.file).string());
        if (!is_untouched(exercise, text, cut(reference, find_exercises(reference, path.string()))))
            ++standing.begun;
        else if (standing.to_write.empty())
            standing.to_write = exercise.name + " in " + shown(path, place_of(exercise, text));
    }
}

std::vector<Standing> standings(const Project& project) {
    const std::map<std::string, LastCheck> checks = read_checks(project);
    std::vector<Standing> all;
    for (const std::string& step : all_steps(project)) {
        Standing standing{.step = step};
        count_exercises(project, standing);
        if (const auto check = checks.find(step); check != checks.end()) {
            standing.checked = true;
            standing.check = check->second;
            standing.changed = check->second.fingerprint != fingerprint(project, step);
        }
        all.push_back(standing);
    }
    return all;
}

std::string verdict_words(const std::string& verdict) {
    if (verdict == "same") return "the picture is the reference's";
    if (verdict == "noise") return "the picture is the reference's up to noise";
    if (verdict == "look") return "the picture needs a look";
    if (verdict == "different") return "the picture is another";
    return "the picture was not compared";
}

std::string words(const Standing& s) {
    if (!s.has_files) return "not begun";
    std::string text = std::to_string(s.begun) + " of " + std::to_string(s.exercises) + " functions begun";
    if (s.exercises == 0) text = "begun";
    if (s.exercises < s.in_step)
        text += ", " + std::to_string(s.in_step - s.exercises) + " more stand as in the reference";
    if (!s.checked) return text + "; not checked yet";
    text += "; " + std::to_string(s.check.passed) + " of " + std::to_string(s.check.passed + s.check.failed) +
            " checks passed, " + verdict_words(s.check.verdict);
    return text + (s.changed ? "; changed since" : "");
}

/// The one thing to do next: first what was begun, then the step after the last one that is done.
std::string advice(const std::vector<Standing>& all) {
    const auto number = [](const Standing& s) { return s.step.substr(0, 2); };
    const auto begun = [](const Standing& s) { return s.has_files && !s.done(); };
    const auto open = std::ranges::find_if(all, begun);
    if (open != all.end() && !open->to_write.empty())
        return "write " + open->to_write + "; then ./learn check " + number(*open);
    if (open != all.end()) return "./learn check " + number(*open);
    const auto done = [](const Standing& s) { return s.has_files && s.done(); };
    auto from = all.begin();
    for (auto s = all.begin(); s != all.end(); ++s)
        if (done(*s)) from = s + 1;
    if (from != all.end()) return "./learn start " + number(*from);
    const auto skipped = std::ranges::find_if_not(all, done);
    if (skipped != all.end()) return "./learn start " + number(*skipped);
    return "nothing: all steps are yours. ./learn run renders them";
}

} // namespace

void show_status(const Project& project, std::ostream& out) {
    const std::vector<Standing> all = standings(project);
    for (const Standing& standing : all)
        out << (standing.has_files && standing.done() ? "done  " : "      ") << std::left << std::setw(16)
            << standing.step << words(standing) << "\n";
    out << "\nnext: " << advice(all) << "\n";
}

} // namespace rt
