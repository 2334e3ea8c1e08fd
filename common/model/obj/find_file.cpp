// Finds the files that an OBJ or MTL file names, despite quotes, backslashes, case and foreign folders.
#include "common/model/obj/find_file.h"

#include "common/util/text.h"
#include "common/util/paths.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace rt {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::is_regular_file(path, ignored);
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

/// Returns the entry of `folder` that equals `name` except for case; the alphabetically
/// first of several, or empty.
fs::path in_folder(const fs::path& folder, const std::string& name) {
    fs::path found;
    std::error_code failure;
    for (auto entry = fs::directory_iterator(folder.empty() ? "." : folder, failure);
         !failure && entry != fs::directory_iterator(); entry.increment(failure)) {
        const fs::path there = entry->path().filename();
        if (lower(text_of(there)) == lower(name) && (found.empty() || there < found)) found = there;
    }
    return found;
}

/// Returns a file whose path equals `path` except for case, or an empty path.
fs::path in_any_case(const fs::path& path) {
    fs::path found = path.root_path();
    for (const fs::path& part : path.relative_path()) {
        std::error_code ignored;
        const bool is_exact = fs::exists(found / part, ignored);
        const fs::path name = is_exact ? part : in_folder(found, text_of(part));
        if (name.empty()) return {};
        found /= name;
    }
    return is_there(found) ? found : fs::path();
}

} // namespace

std::string unquoted(std::string_view name) {
    if (name.size() >= 2 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    return std::string(name);
}

NamesOfLine names_of_line(std::string text) {
    // An escaped blank belongs to the name; Parser::read_name() has replaced its '\' by '/'.
    const std::string escaped{'/', name_space};
    for (std::size_t at = 0; (at = text.find(escaped, at)) != std::string::npos;) text.replace(at, 2, " ");
    NamesOfLine names{unquoted(text), {""}};
    std::replace(names.whole.begin(), names.whole.end(), name_space, ' ');
    bool in_quotes = false;
    for (const char c : text) {
        if (c == '"')
            in_quotes = !in_quotes;
        else if (c == name_space && !in_quotes)
            names.parts.emplace_back();
        else
            names.parts.back() += c == name_space ? ' ' : c;
    }
    std::erase(names.parts, "");
    return names;
}

std::vector<fs::path> candidates(const std::string& name, const std::vector<fs::path>& folders) {
    std::vector<fs::path> paths;
    const auto add = [&](const fs::path& path) {
        const fs::path normal = path.lexically_normal();
        if (std::find(paths.begin(), paths.end(), normal) == paths.end()) paths.push_back(normal);
    };
    for (const fs::path& folder : folders) add(folder / path_of(name)); // an absolute name stays unchanged
    for (const fs::path& folder : folders) add(folder / path_of(name).filename());
    return paths;
}

std::vector<fs::path> existing(const std::vector<fs::path>& paths) {
    std::vector<fs::path> found;
    std::copy_if(paths.begin(), paths.end(), std::back_inserter(found), is_there);
    if (!found.empty()) return found;
    std::transform(paths.begin(), paths.end(), std::back_inserter(found), in_any_case);
    std::erase(found, fs::path());
    return found;
}

std::string listed(const std::vector<fs::path>& paths) {
    std::string text;
    for (const fs::path& path : paths) text += (text.empty() ? "" : ", ") + text_of(path);
    return text;
}

std::string one_name_of(const fs::path& path) {
    std::error_code failure;
    const fs::path one = fs::weakly_canonical(path, failure);
    return failure ? text_of(path) : text_of(one);
}

} // namespace rt
