// ./learn start 03: cuts the stubs of a step, beside whatever the learner has written already.
#include "tools/tutor/commands.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"

#include <algorithm>
#include <utility>

namespace rt {

namespace fs = std::filesystem;

namespace {

using Contents = std::vector<std::pair<std::string, std::string>>; ///< file name, text

/// What a file of the reference looks like when all its exercises are cut.
std::string stub_of(const Project& project, const std::string& step, const std::string& file,
                    const std::vector<Exercise>& exercises) {
    std::vector<Exercise> here;
    std::ranges::copy_if(exercises, std::back_inserter(here),
                         [&](const Exercise& e) { return e.file == file; });
    return cut(read_file((steps_folder(project) / step / file).string()), here);
}

/// The stubs of the files that the learner does not have yet.
Contents missing_stubs(const Project& project, const std::string& step,
                       const std::vector<Exercise>& exercises, std::ostream& out) {
    Contents stubs;
    std::error_code ignored;
    for (const std::string& file : files_to_write(exercises)) {
        const fs::path place = project.workshop / step / file;
        if (fs::exists(fs::symlink_status(place, ignored)))
            out << shown(place) << " is there already: left as it is\n";
        else
            stubs.emplace_back(file, stub_of(project, step, file, exercises));
    }
    return stubs;
}

void write_stubs(const Project& project, const std::string& step, const Contents& stubs, std::ostream& out) {
    const fs::path folder = project.workshop / step;
    for (const auto& [file, stub] : stubs) check_file_writable((folder / file).string());
    for (const auto& [file, stub] : stubs) {
        write_file((folder / file).string(), stub);
        out << "made " << shown(folder / file) << "\n";
    }
}

void list_tasks(const Project& project, const std::vector<Exercise>& exercises, std::ostream& out) {
    for (const Exercise& exercise : exercises) {
        const fs::path path = project.workshop / exercise.step / exercise.file;
        out << "  " << shown(path, place_of(exercise, read_file(path.string()))) << "  " << exercise.name
            << "\n"
            << "      " << exercise.task << "\n";
    }
}

/// The learner's files of earlier steps that the step's files include.
void name_foundations(const Project& project, const std::string& step, const std::vector<Exercise>& exercises,
                      std::ostream& out) {
    std::vector<std::string> own;
    std::error_code ignored;
    for (const std::string& file : files_to_write(exercises))
        for (const std::string& header :
             included_headers({project.workshop, steps_folder(project)}, step + "/" + file))
            if (!header.starts_with(step + "/") && std::ranges::find(own, header) == own.end() &&
                fs::exists(project.workshop / header, ignored))
                own.push_back(header);
    std::string names;
    for (const std::string& header : own) names += (names.empty() ? "" : ", ") + header;
    if (!own.empty()) out << "yours  " << names << ": what you write builds on them\n";
}

/// Not the step's folder, where the answers are.
std::string what_to_read(const Project& project, const std::string& step) {
    std::error_code ignored;
    const fs::path chapter = project.root / "docs" / (step + ".md");
    return fs::exists(chapter, ignored) ? shown(chapter) : "the comment above each function";
}

} // namespace

void start_step(const Project& project, const std::string& step, std::ostream& out) {
    const std::vector<Exercise> exercises = exercises_of(project, step);
    const std::string number = step.substr(0, 2);
    make_folder(project.workshop / step);
    out << "Step " << number << " asks: " << question_of(project, step) << "\n\n";
    write_stubs(project, step, missing_stubs(project, step, exercises, out), out);
    out << "\nWrite " << exercises.size() << " functions, best in this order:\n";
    list_tasks(project, exercises, out);
    out << "\n";
    name_foundations(project, step, exercises, out);
    out << "read   " << what_to_read(project, step) << "\n"
        << "then   ./learn check " << number << "\n"
        << "stuck  ./learn hint " << number << " " << exercises.front().name << "\n";
}

} // namespace rt
