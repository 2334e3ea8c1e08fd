// ./learn start --merge: brings the given parts of the learner's files up to date with the reference, by git.
#include "tools/tutor/commands.h"
#include "tools/tutor/files.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/record.h"
#include "tools/tutor/system.h"
#include "tools/tutor/util.h"

namespace rt::tutor {

namespace fs = std::filesystem;

Words edited_references(const Project& project, const std::string& step) {
    std::string output;
    const Words command{"git",  "-C", text_of(project.root), "status", "--short",
                        "-uno", "--", "steps/" + step};
    const bool known = run_process(command, {.log = "/dev/null", .output = &output}).code == 0;
    Words files;
    if (!known) return files; // a copy without its history
    for (const std::string& line : lines_of(output)) files.push_back(line.substr(3));
    return files;
}

Words outdated_files(const Project& project, const std::string& step) {
    const std::vector<Exercise> exercises = exercises_of(project, step);
    Words files;
    std::error_code ignored;
    for (const std::string& file : own_files(project, step)) {
        const fs::path base = base_of(project, step, file);
        if (fs::exists(base, ignored) && fs::exists(steps_folder(project) / step / file, ignored) &&
            code_only(read_file(text_of(base))) != code_only(stub_of(project, step, file, exercises)))
            files.push_back(file);
    }
    return files;
}

namespace {

/// Merges what has changed between the two stubs into the learner's text. Where both have changed the same lines, the
/// learner's stay, and `clashes` is set.
std::string merged(const std::string& own, const std::string& base, const std::string& stub, bool& clashes) {
    const TemporaryFolder folder;
    const auto put = [&](const char* name, const std::string& text) {
        write_file(text_of(folder.path / name), text);
        return text_of(folder.path / name);
    };
    const Words files{put("own", own), put("base", base), put("stub", stub)};
    std::string text;
    for (const bool keep_own : {false, true}) {
        Words command{"git", "merge-file", "-p", "-q"};
        if (keep_own) command.push_back("--ours");
        append(command, files);
        text.clear();
        const int code = run_process(command, {.output = &text}).code;
        if (code > 127) throw Error("git merge-file failed; is git installed?");
        clashes = keep_own;
        if (code == 0) break;
    }
    return text;
}

} // namespace

void merge_step(const Project& project, const std::string& step, std::ostream& out) {
    const std::vector<Exercise> exercises = exercises_of(project, step);
    const Words files = outdated_files(project, step);
    if (files.empty()) out << "the given parts of your files are those of the reference\n";
    for (const std::string& file : files) {
        const fs::path own = project.workshop / step / file;
        const std::string stub = stub_of(project, step, file, exercises);
        bool clashes = false;
        const std::string text =
            merged(read_file(text_of(own)), read_file(text_of(base_of(project, step, file))), stub, clashes);
        back_up(project, step, file, out);
        write_file(text_of(own), text);
        write_base(project, step, file, stub);
        out << "merged the reference's changes into " << display_path(own)
            << (clashes ? "; your lines stay where both have changed: ./learn diff " + number_of(step) + " " +
                              file
                        : "")
            << "\n";
    }
}

} // namespace rt::tutor
