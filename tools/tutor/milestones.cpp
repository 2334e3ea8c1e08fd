// Reads and validates the lists of milestones.
#include "tools/tutor/milestones.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"

#include <algorithm>
#include <map>
#include <optional>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

/// Returns what follows `* Name: ` in a line.
std::optional<std::string> field(const std::string& line, const std::string& name) {
    const std::string begin = "* " + name + ": ";
    if (!line.starts_with(begin)) return std::nullopt;
    return trimmed(line.substr(begin.size()));
}

Words split_at(const std::string& text, char separator) {
    Words parts(1);
    for (const char c : text) {
        if (c == separator)
            parts.emplace_back();
        else
            parts.back() += c;
    }
    for (std::string& part : parts) part = trimmed(part);
    std::erase(parts, "");
    return parts;
}

/// Reads `## id: title`.
Milestone begin_milestone(const std::string& line, const std::string& place) {
    const std::string heading = line.substr(3);
    const std::size_t colon = heading.find(": ");
    if (colon == std::string::npos || colon == 0)
        throw Error(place + "a milestone must begin with '## id: title'");
    Milestone milestone;
    milestone.id = heading.substr(0, colon);
    milestone.title = trimmed(heading.substr(colon + 2));
    return milestone;
}

/// Stores one line of a milestone, which may continue the field before it.
void read_line(const std::string& line, const std::string& place, Milestone& milestone) {
    if (const auto names = field(line, "Write"))
        milestone.functions = split_at(*names, ',');
    else if (const auto words = field(line, "Options"))
        milestone.options = split_at(*words, ' ');
    else if (const auto text = field(line, "Shows"))
        milestone.shows = *text;
    else if (line.starts_with("  ") && !milestone.shows.empty())
        milestone.shows += " " + trimmed(line);
    else if (!trimmed(line).empty())
        throw Error(place + "expected '* Write: ', '* Options: ' or '* Shows: ' here");
}

} // namespace

std::vector<Milestone> parse_milestones(const std::string& text, const std::string& path) {
    std::vector<Milestone> milestones;
    int number = 0;
    for (const std::string& line : lines_of(text)) {
        const std::string place = path + ":" + std::to_string(++number) + ": ";
        if (line.starts_with("## "))
            milestones.push_back(begin_milestone(line, place));
        else if (!milestones.empty())
            read_line(line, place, milestones.back());
    }
    for (const Milestone& milestone : milestones)
        if (milestone.functions.empty() || milestone.shows.empty())
            throw Error(path + ": the milestone " + milestone.id + " needs '* Write: ' and '* Shows: '");
    return milestones;
}

std::vector<Milestone> read_milestones(const fs::path& root, const std::string& step) {
    const std::string path = "exercises/" + step + "/milestones.md";
    std::error_code ignored;
    if (!fs::exists(root / path, ignored)) return {};
    return parse_milestones(read_file(text_of(root / path)), path);
}

void sort_by_milestones(const fs::path& root, const std::string& step, std::vector<Exercise>& exercises) {
    const std::vector<Milestone> milestones = read_milestones(root, step);
    if (milestones.empty()) return;
    const std::string path = "exercises/" + step + "/milestones.md: ";
    std::map<std::string, std::size_t> places;
    for (const Milestone& milestone : milestones)
        for (const std::string& name : milestone.functions)
            if (!places.emplace(name, places.size()).second) throw Error(path + name + " occurs twice");
    for (const Exercise& exercise : exercises)
        if (!places.contains(exercise.name)) throw Error(path + exercise.name + " is missing");
    if (places.size() != exercises.size())
        for (const auto& [name, place] : places)
            if (std::ranges::find(exercises, name, &Exercise::name) == exercises.end())
                throw Error(path + step + " asks for no function " + name);
    std::ranges::sort(exercises, {}, [&](const Exercise& exercise) { return places.at(exercise.name); });
}

std::size_t milestones_reached(const std::vector<Milestone>& milestones, const Words& written) {
    const auto complete = [&](const Milestone& milestone) {
        return std::ranges::all_of(milestone.functions,
                                   [&](const std::string& name) { return contains(written, name); });
    };
    return std::size_t(std::ranges::find_if_not(milestones, complete) - milestones.begin());
}

std::string milestone_text(const std::vector<Milestone>& milestones, const Words& written) {
    const std::size_t reached = milestones_reached(milestones, written);
    if (reached == 0) return "";
    return std::to_string(reached) + " of " + std::to_string(milestones.size()) + ": " +
           milestones[reached - 1].title;
}

fs::path milestone_picture(const std::string& step, const std::string& id) {
    return fs::path("exercises") / step / "milestones" / (id + ".png");
}

} // namespace rt::tutor
