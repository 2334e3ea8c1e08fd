// ./learn diff 03: the reference against what the learner wrote.
#include "tools/tutor/commands.h"
#include "tools/tutor/line_diff.h"

#include "common/util/file_bytes.h"

namespace rt {

namespace fs = std::filesystem;

namespace {

/// The lines of a file, without the markers of its exercises and whatever ends its lines.
std::vector<std::string> plain_lines(const std::string& path) {
    std::vector<std::string> lines = lines_of(without_markers(read_file(path)));
    for (std::string& line : lines)
        if (line.ends_with('\r')) line.pop_back();
    return lines;
}

void diff_file(const Project& project, const std::string& step, const std::string& file, bool colour,
               std::ostream& out) {
    const fs::path reference = steps_folder(project) / step / file, own = project.workshop / step / file;
    std::error_code ignored;
    if (!fs::exists(reference, ignored)) {
        out << shown(own) << ": yours alone, the reference has no such file\n";
        return;
    }
    const auto diff = line_diff(plain_lines(reference.string()), plain_lines(own.string()));
    const std::string text = unified(diff, shown(reference), shown(own), colour);
    out << (text.empty() ? shown(own) + ": as the reference\n" : text);
}

} // namespace

void show_diff(const Project& project, const std::string& step, const std::string& file, bool colour,
               std::ostream& out) {
    std::vector<std::string> files = own_files(project, step);
    if (!file.empty() || files.empty()) files = {find_own_file(project, step, file)};
    for (const std::string& each : files) diff_file(project, step, each, colour, out);
}

} // namespace rt
