// ./learn hint: parses the hints of a step and shows the next of three at each call.
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/commands.h"
#include "tools/tutor/hints.h"

#include <algorithm>
#include <sstream>

namespace rt::tutor {

namespace {

[[noreturn]] void refuse(const std::string& path, std::size_t line, const std::string& what) {
    throw Error(path + ":" + std::to_string(line) + ": " + what);
}

std::string without_blanks_before(const std::string& line) {
    return line.substr(std::min(line.find_first_not_of(' '), line.size()));
}

} // namespace

Hints parse_hints(const std::string& text, const std::string& path) {
    Hints hints;
    Words* current = nullptr;
    std::size_t number = 0;
    for (const std::string& line : lines_of(text)) {
        ++number;
        if (line.empty() || line.starts_with("# ")) continue;
        if (line.starts_with("## ")) {
            const auto [place, is_new] = hints.try_emplace(line.substr(3));
            if (!is_new) refuse(path, number, "there are already hints for " + line.substr(3));
            current = &place->second;
            continue;
        }
        if (!current) refuse(path, number, "expected '## name' before the first hint");
        const std::string mark = std::to_string(current->size() + 1) + ". ";
        if (line.starts_with(mark) && line.size() > mark.size())
            current->push_back(line.substr(mark.size()));
        else if (line.starts_with("   ") && !current->empty())
            current->back() += " " + without_blanks_before(line);
        else
            refuse(path, number,
                   "expected '" + mark + "' and a hint, or three spaces and the rest of the last hint");
    }
    return hints;
}

Hints read_hints(const std::filesystem::path& root, const std::string& step,
                 const std::vector<Exercise>& exercises) {
    const std::string path = text_of(root / "exercises" / step / "hints.md");
    Hints hints = parse_hints(read_file(path), path);
    for (const Exercise& exercise : exercises)
        if (!hints.contains(exercise.name)) throw Error(path + ": there are no hints for " + exercise.name);
    for (const auto& [name, texts] : hints) {
        if (std::ranges::find(exercises, name, &Exercise::name) == exercises.end())
            throw Error(path + ": there are hints for " + name + ", which is not an exercise of " + step);
        if (texts.size() != hint_count)
            throw Error(path + ": " + std::to_string(texts.size()) + " hints for " + name +
                        "; there must be three");
    }
    return hints;
}

namespace {

std::string key_of(const Exercise& exercise) {
    return exercise.step + "\t" + exercise.name;
}

/// Returns how many hints of the exercise have been shown.
std::size_t count_shown(const ShownHints& shown_hints, const Exercise& exercise) {
    const auto found = shown_hints.find(key_of(exercise));
    return found == shown_hints.end() ? 0 : std::min(std::size_t(found->second), hint_count);
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
        out << " in " << display_path(path, line_of(exercise, read_file(text_of(path))));
    out << "\ntask: " << exercise.task << "\n";
}

void print_next_step(const Exercise& exercise, std::size_t count, std::ostream& out) {
    const std::string number = number_of(exercise.step);
    if (count < hint_count)
        out << "\nNext hint: ./learn hint " << number << " " << exercise.name << "\n";
    else
        out << "\nThere are no more hints. ./learn diff " << number << " " << exercise.file
            << " shows the reference.\n";
}

void list_exercises(const std::string& step, const std::vector<Exercise>& exercises,
                    const ShownHints& shown_hints, std::ostream& out) {
    const std::string number = number_of(step);
    out << "The functions of " << step << ", and how many of their hints you have seen:\n";
    for (const Exercise& exercise : exercises)
        out << "  " << count_shown(shown_hints, exercise) << " of " << hint_count << "  " << exercise.name
            << " (" << exercise.file << "): " << exercise.task << "\n";
    out << "\nnext: ./learn hint " << number << " " << exercises.front().name << "\n";
}

/// The hints with indices `first` to `last` - 1.
struct Range {
    std::size_t first, last;
};

/// Returns which hints to show if `before` of them have been shown. After the last hint, it is shown again.
Range range_of(HintMode mode, std::size_t before) {
    if (mode == HintMode::all) return {0, hint_count};
    const std::size_t last =
        mode == HintMode::again ? std::max<std::size_t>(before, 1) : std::min(before + 1, hint_count);
    return {last - 1, last};
}

void print_texts(const Words& texts, const Range& range, std::ostream& out) {
    for (std::size_t tier = range.first; tier < range.last; ++tier) {
        out << "\nHint " << tier + 1 << " of " << hint_count << "\n";
        print_wrapped(texts[tier], out);
    }
}

void forget(const Project& project, ShownHints shown_hints, const std::vector<Exercise>& exercises,
            const std::string& what, std::ostream& out) {
    for (const Exercise& exercise : exercises) shown_hints.erase(key_of(exercise));
    write_shown_hints(project, shown_hints);
    out << "the hints for " << what << " start again with the first\n";
}

} // namespace

void show_hints(const Project& project, const std::string& step, const std::string& name, HintMode mode,
                std::ostream& out) {
    const std::vector<Exercise> exercises = exercises_of(project, step);
    ShownHints shown_hints = read_shown_hints(project);
    if (name.empty()) {
        if (mode == HintMode::reset) return forget(project, shown_hints, exercises, step, out);
        return list_exercises(step, exercises, shown_hints, out);
    }
    const Exercise exercise = find_exercise(project, step, name);
    if (mode == HintMode::reset) return forget(project, shown_hints, {exercise}, name, out);
    const Hints hints = read_hints(project.root, step, exercises);

    const std::size_t before = count_shown(shown_hints, exercise);
    const Range range = range_of(mode, before);
    print_place(project, exercise, out);
    print_texts(hints.at(name), range, out);
    const std::size_t now = std::max(before, range.last);
    print_next_step(exercise, now, out);
    if (now == before) return;
    shown_hints[key_of(exercise)] = int(now);
    write_shown_hints(project, shown_hints);
}

} // namespace rt::tutor
