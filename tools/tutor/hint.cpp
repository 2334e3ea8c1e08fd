// ./learn hint 03 reflected_ray: one tier more at each call, and never the code.
#include "tools/tutor/commands.h"
#include "tools/tutor/hints.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"

#include <algorithm>
#include <sstream>

namespace rt {

namespace {

std::string key_of(const Exercise& exercise) {
    return exercise.step + "\t" + exercise.name;
}

/// How many tiers of the exercise have been shown.
std::size_t count_shown(const ShownHints& shown_hints, const Exercise& exercise) {
    const auto found = shown_hints.find(key_of(exercise));
    return found == shown_hints.end() ? 0 : std::min(std::size_t(found->second), tiers);
}

/// Prints a text in lines of at most 90 characters.
void print_wrapped(const std::string& text, std::ostream& out) {
    std::istringstream words(text);
    std::size_t column = 0;
    for (std::string word; words >> word; column += word.size()) {
        if (column > 0 && column + 1 + word.size() > 90) {
            out << "\n";
            column = 0;
        }
        out << (column == 0 ? "  " : " ");
        column += column == 0 ? 0 : 1;
        out << word;
    }
    out << "\n";
}

void print_place(const Project& project, const Exercise& exercise, std::ostream& out) {
    std::error_code ignored;
    const auto path = project.workshop / exercise.step / exercise.file;
    out << exercise.name;
    if (std::filesystem::exists(path, ignored))
        out << " in " << shown(path, place_of(exercise, read_file(path.string())));
    out << "\ntask: " << exercise.task << "\n";
}

void print_next_step(const Exercise& exercise, std::size_t count, std::ostream& out) {
    const std::string number = exercise.step.substr(0, 2);
    if (count < tiers)
        out << "\nmore: ./learn hint " << number << " " << exercise.name << "\n";
    else
        out << "\nThere are no more hints. ./learn diff " << number << " " << exercise.file
            << " shows the reference.\n";
}

void list_exercises(const std::string& step, const std::vector<Exercise>& exercises,
                    const ShownHints& shown_hints, std::ostream& out) {
    const std::string number = step.substr(0, 2);
    out << "The exercises of " << step << ", and how many of their hints you have seen:\n";
    for (const Exercise& exercise : exercises)
        out << "  " << count_shown(shown_hints, exercise) << " of " << tiers << "  " << exercise.name << " ("
            << exercise.file << "): " << exercise.task << "\n";
    out << "\nnext: ./learn hint " << number << " " << exercises.front().name << "\n";
}

/// Tiers first + 1 to last of an exercise.
struct Range {
    std::size_t first, last;
};

/// What to show of an exercise of which `before` tiers have been shown. After the last one it is the last one again.
Range range_of(HintWish wish, std::size_t before) {
    if (wish == HintWish::all) return {0, tiers};
    const std::size_t last =
        wish == HintWish::again ? std::max<std::size_t>(before, 1) : std::min(before + 1, tiers);
    return {last - 1, last};
}

void print_tiers(const std::vector<std::string>& texts, const Range& range, std::ostream& out) {
    for (std::size_t tier = range.first; tier < range.last; ++tier) {
        out << "\nHint " << tier + 1 << " of " << tiers << "\n";
        print_wrapped(texts[tier], out);
    }
}

void forget(const Project& project, ShownHints shown_hints, const std::vector<Exercise>& exercises,
            const std::string& what, std::ostream& out) {
    for (const Exercise& exercise : exercises) shown_hints.erase(key_of(exercise));
    write_shown_hints(project, shown_hints);
    out << "the hints of " << what << " begin anew\n";
}

} // namespace

void show_hints(const Project& project, const std::string& step, const std::string& name, HintWish wish,
                std::ostream& out) {
    const std::vector<Exercise> exercises = exercises_of(project, step);
    ShownHints shown_hints = read_shown_hints(project);
    if (name.empty()) {
        if (wish == HintWish::reset) return forget(project, shown_hints, exercises, step, out);
        return list_exercises(step, exercises, shown_hints, out);
    }
    const Exercise exercise = find_exercise(project, step, name);
    if (wish == HintWish::reset) return forget(project, shown_hints, {exercise}, name, out);
    const Hints hints = read_hints(project.root, step, exercises);

    const std::size_t before = count_shown(shown_hints, exercise);
    const Range range = range_of(wish, before);
    print_place(project, exercise, out);
    print_tiers(hints.at(name), range, out);
    const std::size_t now = std::max(before, range.last);
    print_next_step(exercise, now, out);
    if (now == before) return;
    shown_hints[key_of(exercise)] = int(now);
    write_shown_hints(project, shown_hints);
}

} // namespace rt
