// ./learn undo 03 mirror.h: puts the learner's file aside, so that the reference counts again.
#include "tools/tutor/commands.h"

#include "common/util/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <ctime>

namespace rt {

namespace fs = std::filesystem;

namespace {

/// Now, as 2026-01-31-235959.
std::string time_stamp() {
    const std::time_t now = std::time(nullptr);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d-%H%M%S", std::localtime(&now));
    return text.data();
}

/// A name in the backup folder that nothing has yet.
fs::path free_place(const fs::path& folder, const std::string& file) {
    const fs::path first = folder / (file + "." + time_stamp());
    fs::path place = first;
    std::error_code ignored;
    for (int count = 2; fs::exists(fs::symlink_status(place, ignored)); ++count) {
        place = first;
        place += "-" + std::to_string(count);
    }
    return place;
}

/// A path as a shell takes it for one word.
std::string quoted(const fs::path& path) {
    const std::string text = shown(path);
    const bool plain = std::ranges::all_of(text, [](unsigned char c) {
        return std::isalnum(c) || std::string("/._-").find(char(c)) != std::string::npos;
    });
    if (plain) return text;
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
    return word + "'";
}

void put_aside(const Project& project, const std::string& step, const std::string& file, std::ostream& out) {
    const fs::path folder = project.workshop / ".backup" / step;
    make_folder(folder);
    const fs::path from = project.workshop / step / file, to = free_place(folder, file);
    std::error_code failure;
    fs::rename(from, to, failure);
    if (failure)
        throw Error("cannot move " + shown(from) + " to " + shown(to) + " (" + failure.message() + ")");
    out << "moved " << shown(from) << " to " << shown(to) << "\n"
        << "  to get it back: mv " << quoted(to) << " " << quoted(from) << "\n";
}

} // namespace

void undo_files(const Project& project, const std::string& step, const std::string& file, std::ostream& out) {
    std::vector<std::string> files = own_files(project, step);
    if (!file.empty() || files.empty()) files = {find_own_file(project, step, file)};
    for (const std::string& each : files) put_aside(project, step, each, out);
    out << "the reference counts again; ./learn start " << step.substr(0, 2) << " makes a new stub\n";
}

} // namespace rt
