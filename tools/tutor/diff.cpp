// ./learn diff: compares the reference with the learner's file, by git.
#include "tools/tutor/diff.h"

#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/commands.h"
#include "tools/tutor/system.h"
#include "tools/tutor/util.h"

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

std::string git_diff(const std::string& first, const std::string& second) {
    const TemporaryFolder folder;
    const auto put = [&](const char* name, const std::string& text) {
        const std::string path = text_of(folder.path / name);
        write_file(path, text.empty() || text.ends_with('\n') ? text : text + "\n");
        return path;
    };
    std::string output;
    const Words command{
        "git",       "diff",        "--no-index", "--no-color",        "--no-ext-diff",      "--patch",
        "--minimal", "--unified=3", "--",         put("first", first), put("second", second)};
    if (run_process(command, {.output = &output}).code > 1) throw Error("git diff failed; is git installed?");
    return output;
}

std::string painted(const char* colour_code, const std::string& line, bool colour) {
    const std::string text = printable_lines(line);
    return colour ? std::string("\x1b[") + colour_code + "m" + text + "\x1b[0m\n" : text + "\n";
}

} // namespace

std::string unified_diff(const NamedText& first, const NamedText& second, bool colour) {
    std::string out;
    for (const std::string& line : lines_of(git_diff(first.text, second.text))) {
        const bool hunk = line.starts_with("@@ ");
        if (hunk && out.empty())
            out = painted("1", "--- " + first.name, colour) + painted("1", "+++ " + second.name, colour);
        if (out.empty()) continue; // git's header
        if (hunk)
            out +=
                painted("36", line.substr(0, line.find(" @@") + 3), colour); // drops the name of the function
        else
            out += line.starts_with(' ') ? printable_lines(line) + "\n"
                                         : painted(line[0] == '-' ? "31" : "32", line, colour);
    }
    return out;
}

namespace {

/// Returns a file without the markers of its exercises and with \n as line ends.
NamedText plain_text(const fs::path& path) {
    std::string text = without_markers(read_file(text_of(path)));
    std::erase(text, '\r');
    return {display_path(path), text};
}

void diff_file(const Project& project, const std::string& step, const std::string& file, bool colour,
               std::ostream& out) {
    const fs::path reference = steps_folder(project) / step / file, own = project.workshop / step / file;
    std::error_code ignored;
    if (!fs::exists(reference, ignored)) {
        out << display_path(own) << ": only yours; the reference has no such file\n";
        return;
    }
    const std::string text = unified_diff(plain_text(reference), plain_text(own), colour);
    out << (text.empty() ? display_path(own) + ": same as the reference\n" : text);
}

} // namespace

void show_diff(const Project& project, const std::string& step, const std::string& file, bool colour,
               std::ostream& out) {
    Words files = own_files(project, step);
    if (!file.empty() || files.empty()) files = {find_own_file(project, step, file)};
    for (const std::string& each : files) diff_file(project, step, each, colour, out);
}

} // namespace rt::tutor
