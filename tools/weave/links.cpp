// Looks whether what a page refers to is there.
#include "tools/weave/weave.h"

#include "common/file_bytes.h"
#include "tools/tutor/exercises.h"

#include <algorithm>
#include <cctype>
#include <regex>
#include <set>

namespace rt {

namespace fs = std::filesystem;

namespace {

/// Calls each(line, its number) for those outside of code.
template <typename Each>
void outside_of_code(const std::string& page, const Each& each) {
    bool inside = false;
    const auto lines = lines_of(page);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].starts_with("```"))
            inside = !inside;
        else if (!inside)
            each(lines[i], i + 1);
    }
}

/// As code-hosting sites name a heading: small letters, blanks become hyphens, other signs go.
std::string anchor_of(const std::string& heading) {
    std::string anchor;
    for (const char c : heading) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 128)
            anchor += char(std::tolower(byte));
        if (c == ' ') anchor += '-';
    }
    return anchor;
}

std::set<std::string> anchors_of(const std::string& page) {
    std::set<std::string> anchors;
    outside_of_code(page, [&](const std::string& line, std::size_t) {
        const std::size_t text = line.find_first_not_of('#');
        if (text == 0 || text == std::string::npos || line[text] != ' ') return;
        anchors.insert(anchor_of(line.substr(text + 1)));
    });
    return anchors;
}

bool is_there(const fs::path& page_path, const std::string& page, const std::string& target) {
    const std::size_t hash = target.find('#');
    const std::string file = target.substr(0, hash);
    const fs::path path = page_path.parent_path() / file;
    if (!file.empty() && !fs::exists(path)) return false;
    if (hash == std::string::npos) return true;
    return anchors_of(file.empty() ? page : read_file(path.string())).contains(target.substr(hash + 1));
}

std::vector<std::string> found(const std::string& line, const std::regex& pattern) {
    std::vector<std::string> all;
    for (std::sregex_iterator it(line.begin(), line.end(), pattern), end; it != end; ++it)
        all.push_back((*it)[1]);
    return all;
}

} // namespace

std::vector<std::string> dead_links(const fs::path& root, const std::string& page, const std::string& path) {
    static const std::regex link(R"(\]\(([^)\s]+)\))");
    static const std::regex project_path(
        R"(`((?:steps|common|tests|tools|docs|mistakes|hints|assets|cmake)/[A-Za-z0-9_./-]*)`)");
    std::vector<std::string> dead;
    outside_of_code(page, [&](const std::string& line, std::size_t number) {
        const std::string where = path + ":" + std::to_string(number) + ": ";
        for (const std::string& target : found(line, link))
            if (!target.starts_with("http") && !is_there(root / path, page, target))
                dead.push_back(where + target + " is not there");
        for (const std::string& name : found(line, project_path))
            if (name.find("NN") == std::string::npos && !fs::exists(root / name))
                dead.push_back(where + "`" + name + "` is not there");
    });
    return dead;
}

} // namespace rt
