// Finds dead links: what a page refers to and does not exist.
#include "tools/weave/weave.h"

#include "common/util/file_bytes.h"
#include "tools/tutor/exercises.h"
#include "tools/weave/pages.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <utility>

namespace rt::weave {

using namespace tutor;

namespace fs = std::filesystem;

namespace {

/// Calls each(line, line number) for each line outside of code blocks.
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
    std::error_code ignored; // a name that is too long does not exist
    if (!file.empty() && !fs::exists(path, ignored)) return false;
    if (hash == std::string::npos) return true;
    if (!file.empty() && !fs::is_regular_file(path, ignored)) return false;
    return anchors_of(file.empty() ? page : read_file(text_of(path))).contains(target.substr(hash + 1));
}

/// Returns all parts of the line between `open` and the next `close`.
std::vector<std::string> between(const std::string& line, const std::string& open, char close) {
    std::vector<std::string> all;
    for (std::size_t at = 0; (at = line.find(open, at)) != std::string::npos;) {
        at += open.size();
        const std::size_t end = line.find(close, at);
        if (end == std::string::npos) break;
        all.push_back(line.substr(at, end - at));
    }
    return all;
}

/// Returns all parts of the line in backquotes.
std::vector<std::string> code_in(const std::string& line) {
    std::vector<std::string> all;
    for (std::size_t at = 0; (at = line.find('`', at)) != std::string::npos;) {
        const std::size_t end = line.find('`', ++at);
        if (end == std::string::npos) break;
        all.push_back(line.substr(at, end - at));
        at = end + 1;
    }
    return all;
}

/// Returns whether the text is a path such as steps/03_mirror/mirror.h; not a pattern (steps/NN_name/*.h)
/// or a command.
bool is_project_path(const std::string& code) {
    constexpr std::array rooms{"steps/", "accel/",     "common/", "tests/", "tools/",
                               "docs/",  "exercises/", "assets/", "cmake/"};
    const auto is_plain = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '/' ||
               c == '-';
    };
    return std::ranges::any_of(rooms, [&](const char* room) { return code.starts_with(room); }) &&
           std::ranges::all_of(code, is_plain) && code.find("NN") == std::string::npos;
}

} // namespace

std::vector<std::string> dead_links(const fs::path& root, const std::string& page, const std::string& path) {
    std::vector<std::string> dead;
    outside_of_code(page, [&](const std::string& line, std::size_t number) {
        const std::string where = path + ":" + std::to_string(number) + ": ";
        for (const auto& [open, close] : {std::pair("](", ')'), {"href=\"", '"'}, {"src=\"", '"'}})
            for (const std::string& target : between(line, open, close))
                if (!target.starts_with("http") && !is_there(root / path, page, target))
                    dead.push_back(where + target + " does not exist");
        std::error_code ignored;
        for (const std::string& code : code_in(line))
            if (is_project_path(code) && !fs::exists(root / code, ignored))
                dead.push_back(where + "`" + code + "` does not exist");
    });
    return dead;
}

} // namespace rt::weave
