// Reads hints: plain Markdown, so that they can be read without this program too.
#include "tools/tutor/hints.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"

#include <algorithm>

namespace rt {

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
    std::vector<std::string>* current = nullptr;
    std::size_t number = 0;
    for (const std::string& line : lines_of(text)) {
        ++number;
        if (line.empty() || line.starts_with("# ")) continue;
        if (line.starts_with("## ")) {
            const auto [place, is_new] = hints.try_emplace(line.substr(3));
            if (!is_new) refuse(path, number, "a second set of hints for " + line.substr(3));
            current = &place->second;
            continue;
        }
        if (!current) refuse(path, number, "a hint stands below '## name'");
        const std::string mark = std::to_string(current->size() + 1) + ". ";
        if (line.starts_with(mark) && line.size() > mark.size())
            current->push_back(line.substr(mark.size()));
        else if (line.starts_with("   ") && !current->empty())
            current->back() += " " + without_blanks_before(line);
        else
            refuse(path, number,
                   "expected '" + mark + "' and a hint, or three blanks and more of the last one");
    }
    return hints;
}

Hints read_hints(const std::filesystem::path& root, const std::string& step,
                 const std::vector<Exercise>& exercises) {
    const std::string path = (root / "exercises" / step / "hints.md").string();
    Hints hints = parse_hints(read_file(path), path);
    for (const Exercise& exercise : exercises)
        if (!hints.contains(exercise.name)) throw Error(path + ": no hints for " + exercise.name);
    for (const auto& [name, texts] : hints) {
        if (std::ranges::find(exercises, name, &Exercise::name) == exercises.end())
            throw Error(path + ": hints for " + name + ", which is no exercise of " + step);
        if (texts.size() != tiers)
            throw Error(path + ": " + std::to_string(texts.size()) + " hints for " + name + ", not three");
    }
    return hints;
}

} // namespace rt
