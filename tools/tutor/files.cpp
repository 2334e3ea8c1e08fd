// ./learn start and undo: creates the learner's files, and moves them out of the way.
#include "tools/tutor/files.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/commands.h"
#include "tools/tutor/util.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <ctime>
#include <utility>

namespace rt::tutor {

namespace fs = std::filesystem;

std::string stub_of(const Project& project, const std::string& step, const std::string& file,
                    const std::vector<Exercise>& exercises) {
    std::vector<Exercise> here;
    std::ranges::copy_if(exercises, std::back_inserter(here),
                         [&](const Exercise& e) { return e.file == file; });
    return make_stub(read_file(text_of(steps_folder(project) / step / file)), here);
}

fs::path base_of(const Project& project, const std::string& step, const std::string& file) {
    return project.workshop / ".base" / step / file;
}

void write_base(const Project& project, const std::string& step, const std::string& file,
                const std::string& stub) {
    make_folder(project.workshop / ".base" / step);
    write_file(text_of(base_of(project, step, file)), stub);
}

namespace {

using Contents = std::vector<std::pair<std::string, std::string>>; ///< file name, text

/// Returns the stubs of the files that the learner does not have yet.
Contents missing_stubs(const Project& project, const std::string& step,
                       const std::vector<Exercise>& exercises, std::ostream& out) {
    Contents stubs;
    std::error_code ignored;
    for (const std::string& file : files_to_write(exercises)) {
        const fs::path place = project.workshop / step / file;
        if (fs::exists(fs::symlink_status(place, ignored)))
            out << display_path(place) << " already exists and was not changed\n";
        else
            stubs.emplace_back(file, stub_of(project, step, file, exercises));
    }
    return stubs;
}

void write_stubs(const Project& project, const std::string& step, const Contents& stubs, std::ostream& out) {
    const fs::path folder = project.workshop / step;
    for (const auto& [file, stub] : stubs) check_file_writable(text_of(folder / file));
    for (const auto& [file, stub] : stubs) {
        write_file(text_of(folder / file), stub);
        write_base(project, step, file, stub);
        out << "created " << display_path(folder / file) << "\n";
    }
}

/// Writes workshop/compile_flags.txt, by which clangd finds the learner's headers before those of steps/, if there is
/// none yet.
void write_compile_flags(const Project& project) {
    const fs::path path = project.workshop / "compile_flags.txt";
    const fs::path packages = project.root / "build/release/prove/toolchain.txt";
    std::error_code ignored;
    if (fs::exists(path, ignored)) return;
    Words flags{"-xc++", "-std=c++20", "-DGLM_FORCE_EXPLICIT_CTOR", "-Wno-pragma-once-outside-header"};
    for (const fs::path& folder : {project.workshop, steps_folder(project), project.root})
        flags.push_back("-I" + text_of(fs::proximate(folder, project.workshop)));
    if (fs::exists(packages, ignored))
        for (const std::string& line : lines_of(read_file(text_of(packages))))
            if (const std::string flag = line.substr(std::min<std::size_t>(line.size(), 5));
                (flag.starts_with("-D") || flag.starts_with("-I")) && flag != "-I/usr/include" &&
                !contains(flags, flag))
                flags.push_back(flag);
    write_file(text_of(path), joined(flags, "\n") + "\n");
}

void list_tasks(const Project& project, const std::vector<Exercise>& exercises, std::ostream& out) {
    for (const Exercise& exercise : exercises) {
        const fs::path path = project.workshop / exercise.step / exercise.file;
        out << "  " << display_path(path, line_of(exercise, read_file(text_of(path)))) << "  "
            << exercise.name << "\n"
            << "      " << exercise.task << "\n";
    }
}

/// Lists the learner's files of earlier steps that the step's files include.
void list_dependencies(const Project& project, const std::string& step,
                       const std::vector<Exercise>& exercises, std::ostream& out) {
    Words own;
    std::error_code ignored;
    for (const std::string& file : files_to_write(exercises))
        for (const std::string& header :
             included_headers({project.workshop, steps_folder(project)}, step + "/" + file))
            if (!header.starts_with(step + "/") && std::ranges::find(own, header) == own.end() &&
                fs::exists(project.workshop / header, ignored))
                own.push_back(header);
    std::string names;
    for (const std::string& header : own) names += (names.empty() ? "" : ", ") + header;
    if (!own.empty()) out << "Your files of earlier steps, which this step uses: " << names << "\n";
}

/// Returns what to read. Not the step's folder, which contains the solutions.
std::string what_to_read(const Project& project, const std::string& step) {
    std::error_code ignored;
    const fs::path chapter = project.root / "docs" / (step + ".md");
    return fs::exists(chapter, ignored) ? display_path(chapter) : "the comment above each function";
}

} // namespace

void start_step(const Project& project, const std::string& step, std::ostream& out) {
    const std::vector<Exercise> exercises = exercises_of(project, step);
    const std::string number = number_of(step);
    make_folder(project.workshop / step);
    out << "Step " << number << ": " << question_of(project, step) << "\n\n";
    write_stubs(project, step, missing_stubs(project, step, exercises, out), out);
    write_compile_flags(project);
    out << "\nWrite " << exercises.size() << " functions. This is a good order:\n";
    list_tasks(project, exercises, out);
    out << "\n";
    list_dependencies(project, step, exercises, out);
    out << "Read:      " << what_to_read(project, step) << "\n"
        << "Check:     ./learn check " << number << "\n"
        << "Get help:  ./learn hint " << number << " " << exercises.front().name << "\n";
}

namespace {

/// Returns the local time as 2026-01-31-235959.
std::string time_stamp() {
    const std::time_t now = std::time(nullptr);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d-%H%M%S", std::localtime(&now));
    return text.data();
}

/// Returns a path in the backup folder that does not exist yet.
fs::path unused_path(const fs::path& folder, const std::string& file) {
    const fs::path first = folder / (file + "." + time_stamp());
    fs::path place = first;
    std::error_code ignored;
    for (int count = 2; fs::exists(fs::symlink_status(place, ignored)); ++count) {
        place = first;
        place += "-" + std::to_string(count);
    }
    return place;
}

/// Returns a path quoted for a shell.
std::string quoted(const fs::path& path) {
    const std::string text = display_path(path);
    const bool plain = std::ranges::all_of(text, [](unsigned char c) {
        return std::isalnum(c) || std::string("/._-").find(char(c)) != std::string::npos;
    });
    if (plain) return text;
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
    return word + "'";
}

} // namespace

void back_up(const Project& project, const std::string& step, const std::string& file, std::ostream& out) {
    const fs::path folder = project.workshop / ".backup" / step;
    make_folder(folder);
    const fs::path from = project.workshop / step / file, to = unused_path(folder, file);
    std::error_code failure;
    fs::rename(from, to, failure);
    if (failure)
        throw Error("cannot move " + display_path(from) + " to " + display_path(to) + " (" +
                    failure.message() + ")");
    out << "moved " << display_path(from) << " to " << display_path(to) << "\n"
        << "  to restore it: mv " << quoted(to) << " " << quoted(from) << "\n";
}

void undo_files(const Project& project, const std::string& step, const std::string& file, std::ostream& out) {
    Words files = own_files(project, step);
    if (!file.empty() || files.empty()) files = {find_own_file(project, step, file)};
    for (const std::string& each : files) back_up(project, step, each, out);
    out << "the reference is used again; ./learn start " << number_of(step) << " creates a new stub\n";
}

} // namespace rt::tutor
