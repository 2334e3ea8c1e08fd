// Finds the files of a step, and stores the results of checks and the hints shown in two text files.
#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/exercises.h"
#include "tools/tutor/util.h"
#include "tools/tutor/workshop.h"

#include <algorithm>
#include <charconv>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

constexpr const char* same_line = ", ";

/// Returns a word of the command line, quoted for a message.
std::string quoted(const std::string& word) {
    std::string text = "'";
    for (const char c : word) text += (unsigned(c) & 0xff) < 0x20 ? ' ' : c;
    return text + "'";
}

/// Parses a number >= 0; returns -1 if the field is not a number.
int count_in(const std::string& field) {
    int count = -1;
    const char* const end = field.data() + field.size();
    const auto [read, failure] = std::from_chars(field.data(), end, count);
    return failure == std::errc() && read == end && count >= 0 ? count : -1;
}

/// Returns the lines of one of the tutor's files in the workshop, split into fields; empty if there is
/// no such file.
std::vector<Words> read_table(const fs::path& path) {
    std::vector<Words> table;
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return table;
    for (const std::string& line : lines_of(read_file(text_of(path))))
        table.push_back(fields_of(trimmed(line)));
    return table;
}

} // namespace

std::string number_of(const std::string& step) {
    return step.substr(0, step.find('_'));
}

fs::path steps_folder(const Project& project) {
    return project.root / "steps";
}

Words all_steps(const Project& project) {
    Words steps;
    std::error_code ignored;
    for (const fs::path& entry : entries_of(steps_folder(project)))
        if (fs::is_regular_file(entry / "main.cpp", ignored)) steps.push_back(text_of(entry.filename()));
    if (steps.empty())
        throw Error("there are no steps in " + display_path(steps_folder(project)) +
                    "; set --root to the project's folder");
    return steps;
}

std::string find_step(const Project& project, const std::string& word) {
    const Words steps = all_steps(project);
    for (const std::string& step : steps)
        if (word == step || word == number_of(step) || "0" + word == number_of(step)) return step;
    throw Error("there is no step " + quoted(word) + "; the steps are " + joined(steps, same_line));
}

std::string current_step(const Project& project) {
    const Words steps = all_steps(project);
    std::string current = steps.front();
    fs::file_time_type when = fs::file_time_type::min();
    for (const std::string& step : steps)
        for (const std::string& file : own_files(project, step)) {
            std::error_code missing;
            const fs::file_time_type saved = fs::last_write_time(project.workshop / step / file, missing);
            if (missing || saved < when) continue;
            current = step;
            when = saved;
        }
    return current;
}

std::string question_of(const Project& project, const std::string& step) {
    const std::string path = text_of(steps_folder(project) / step / "main.cpp");
    const Words lines = lines_of(read_file(path));
    const std::string first = lines.empty() ? "" : lines.front();
    const auto asks = first.find("asks: ");
    return asks == std::string::npos ? "" : first.substr(asks + 6);
}

std::vector<Exercise> exercises_of(const Project& project, const std::string& step) {
    return find_step_exercises(steps_folder(project), step);
}

Exercise find_exercise(const Project& project, const std::string& step, const std::string& name) {
    const std::vector<Exercise> exercises = exercises_of(project, step);
    const auto found = std::ranges::find(exercises, name, &Exercise::name);
    if (found != exercises.end()) return *found;
    Words names;
    for (const Exercise& exercise : exercises) names.push_back(exercise.name);
    throw Error(step + " has no function " + quoted(name) + " to write; it has " + joined(names, same_line));
}

Words files_to_write(const std::vector<Exercise>& exercises) {
    Words files;
    for (const Exercise& exercise : exercises)
        if (std::ranges::find(files, exercise.file) == files.end()) files.push_back(exercise.file);
    return files;
}

Words own_files(const Project& project, const std::string& step) {
    Words files;
    std::error_code ignored;
    for (const fs::path& entry : entries_of(project.workshop / step)) {
        const std::string file = text_of(entry.filename());
        if (file.ends_with(".h") && file[0] != '.' && fs::is_regular_file(entry, ignored))
            files.push_back(file);
    }
    return files;
}

std::string find_own_file(const Project& project, const std::string& step, const std::string& word) {
    const Words files = own_files(project, step);
    const std::string folder = display_path(project.workshop / step);
    if (files.empty())
        throw Error("you have no files of " + step + "; ./learn start " + number_of(step) + " creates them");
    for (const std::string& file : files)
        if (word == file || word == step + "/" + file || word == "workshop/" + step + "/" + file ||
            word == folder + "/" + file)
            return file;
    throw Error("there is no file " + quoted(word) + " in " + folder + "; the files are " +
                joined(files, same_line));
}

std::string display_path(const fs::path& path) {
    std::error_code failure;
    const fs::path near = fs::proximate(path, failure);
    const bool elsewhere = failure || near.empty() || *near.begin() == "..";
    return printable(text_of(elsewhere ? path.lexically_normal() : near));
}

std::string display_path(const fs::path& path, int line) {
    return display_path(path) + ":" + std::to_string(line);
}

void make_folder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure || !fs::is_directory(folder, failure))
        throw Error("cannot create the folder " + display_path(folder) + " (" + failure.message() + ")");
}

std::map<std::string, LastCheck> read_checks(const Project& project) {
    std::map<std::string, LastCheck> checks;
    for (const auto& fields : read_table(project.workshop / ".state")) {
        if (fields.size() != 5) continue;
        const LastCheck check{count_in(fields[1]), count_in(fields[2]), fields[3], fields[4]};
        if (check.passed >= 0 && check.failed >= 0) checks[fields[0]] = check;
    }
    return checks;
}

void write_check(const Project& project, const std::string& step, const LastCheck& check) {
    std::map<std::string, LastCheck> checks = read_checks(project);
    checks[step] = check;
    std::string text;
    for (const auto& [name, c] : checks)
        text += name + "\t" + std::to_string(c.passed) + "\t" + std::to_string(c.failed) + "\t" + c.verdict +
                "\t" + c.fingerprint + "\n";
    make_folder(project.workshop);
    write_file(text_of(project.workshop / ".state"), text);
}

bool all_well(const LastCheck& check) {
    return check.passed > 0 && check.failed == 0 && (check.verdict == "same" || check.verdict == "noise");
}

std::string fingerprint(const Project& project, const std::string& step) {
    Hash hash;
    for (const std::string& each : all_steps(project)) {
        if (each > step) break;
        for (const std::string& file : own_files(project, each)) {
            hash.add(each + "/" + file);
            hash.add(read_file(text_of(project.workshop / each / file)));
        }
    }
    return hash.text();
}

ShownHints read_shown_hints(const Project& project) {
    ShownHints hints;
    for (const auto& fields : read_table(project.workshop / ".hints"))
        if (fields.size() == 3 && count_in(fields[2]) >= 0)
            hints[fields[0] + "\t" + fields[1]] = count_in(fields[2]);
    return hints;
}

void write_shown_hints(const Project& project, const ShownHints& hints) {
    std::string text;
    for (const auto& [exercise, count] : hints) text += exercise + "\t" + std::to_string(count) + "\n";
    make_folder(project.workshop);
    write_file(text_of(project.workshop / ".hints"), text);
}

Words check_files(const fs::path& root, const std::string& step) {
    Words files;
    for (const fs::path& entry : entries_of(root / "tests" / step)) {
        const fs::path name = entry.filename();
        if (name.extension() == ".cpp") files.push_back(step + "_" + text_of(name.stem()));
    }
    std::stable_partition(files.begin(), files.end(), [](const std::string& file) { return !is_slow(file); });
    auto place = files.begin();
    for (const Exercise& exercise : find_step_exercises(root / "steps", step)) {
        const auto own = std::find(place, files.end(), check_file_of(step, exercise.file));
        if (own != files.end()) std::rotate(place++, own, own + 1);
    }
    return files;
}

std::string check_source(const std::string& step, const std::string& file) {
    return "tests/" + step + file.substr(step.size()).replace(0, 1, "/") + ".cpp";
}

bool is_slow(const std::string& file) {
    return file.ends_with("_statistics");
}

std::string check_file_of(const std::string& step, const std::string& header) {
    return step + "_" + text_of(path_of(header).stem());
}

} // namespace rt::tutor
