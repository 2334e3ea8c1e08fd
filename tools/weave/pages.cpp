// Finds the order of the pages in README.md, and writes the links between them.
#include "tools/weave/pages.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/util.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace rt::weave {

using namespace tutor;

namespace fs = std::filesystem;

namespace {

/// Returns the text of the first heading of a page.
std::string title_of(const fs::path& root, const std::string& name) {
    for (const std::string& line : lines_of(read_file(text_of(root / "docs" / (name + ".md")))))
        if (line.starts_with("# ")) return line.substr(2);
    throw Error("docs/" + name + ".md has no title (\"# ...\")");
}

/// Returns the names of the pages of docs/ that README.md links to, in that order but for the chapters, which come first.
Words page_names(const fs::path& root) {
    const std::string readme = read_file(text_of(root / "README.md")), begin = "](docs/", end = ".md";
    Words names;
    for (std::size_t at = 0; (at = readme.find(begin, at)) != std::string::npos;) {
        at += begin.size();
        const std::size_t close = readme.find_first_of("#)", at);
        const std::string file = readme.substr(at, close - at);
        if (!file.ends_with(end) || file.find('/') != std::string::npos) continue;
        const std::string name = file.substr(0, file.size() - end.size());
        if (!contains(names, name)) names.push_back(name);
    }
    const auto is_chapter = [](const std::string& name) { return name[0] >= '0' && name[0] <= '9'; };
    std::stable_partition(names.begin(), names.end(), is_chapter);
    return names;
}

std::string link_to(const fs::path& root, const std::string& name, const std::string& before,
                    const std::string& after) {
    return "[" + before + title_of(root, name) + after + "](" + name + ".md)";
}

/// Calls each(line, number, mathematics) for each line outside of code blocks; `mathematics` is true within ```math.
template <typename Each>
void for_each_text_line(const std::string& page, const Each& each) {
    std::string fence;
    std::size_t number = 0;
    for (const std::string& line : lines_of(page)) {
        ++number;
        if (line.starts_with("```"))
            fence = fence.empty() ? line : "";
        else if (fence.empty() || fence == "```math")
            each(line, number, !fence.empty());
    }
}

/// A line's inline mathematics ($`...`$), and the rest of it without code in backquotes.
struct LineParts {
    Words mathematics;
    std::string prose;
};

LineParts parts_of(const std::string& line) {
    LineParts parts;
    for (std::size_t i = 0; i < line.size();) {
        const bool is_mathematics = line.compare(i, 2, "$`") == 0;
        const std::size_t begin = i + (is_mathematics ? 2 : 1);
        const std::size_t end = line.find(is_mathematics ? "`$" : "`", begin);
        if ((!is_mathematics && line[i] != '`') || end == std::string::npos) {
            parts.prose += line[i++];
            continue;
        }
        if (is_mathematics) parts.mathematics.push_back(line.substr(begin, end - begin));
        i = end + (is_mathematics ? 2 : 1);
    }
    return parts;
}

} // namespace

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

std::string navigation(const fs::path& root, const std::string& name) {
    const Words names = page_names(root);
    const auto here = std::ranges::find(names, name);
    if (here == names.end()) throw Error("README.md has no link to docs/" + name + ".md");
    std::string line = here == names.begin() ? "" : link_to(root, *(here - 1), "← ", "") + " · ";
    line += "[Contents](../README.md#the-eight-chapters)";
    if (here + 1 != names.end()) line += " · " + link_to(root, *(here + 1), "", " →");
    return line + "\n";
}

std::string contents(const fs::path& root, const std::string& name) {
    const std::string page = read_file(text_of(root / "docs" / (name + ".md")));
    std::string list;
    for_each_text_line(page, [&](const std::string& line, std::size_t, bool) {
        if (line.starts_with("## "))
            list += "* [" + line.substr(3) + "](#" + anchor_of(line.substr(3)) + ")\n";
    });
    if (list.empty()) throw Error("docs/" + name + ".md has no section (\"## ...\")");
    return "\n" + list + "\n";
}

std::vector<std::string> unshowable_math(const std::string& page, const std::string& path) {
    constexpr std::array refused{"\\phantom", "\\operatorname"};
    std::vector<std::string> found;
    for_each_text_line(page, [&](const std::string& line, std::size_t number, bool is_block) {
        const auto complain = [&](const std::string& what) {
            found.push_back(path + ":" + std::to_string(number) + ": " + what);
        };
        if (line.starts_with("<!-- ")) return;
        const LineParts parts = is_block ? LineParts{{line}, ""} : parts_of(line);
        for (const std::string& mathematics : parts.mathematics) {
            for (const char* const command : refused)
                if (mathematics.find(command) != std::string::npos)
                    complain(std::string(command) + " is refused by code hosts");
            if (!is_block && line.starts_with('|') && mathematics.find('|') != std::string::npos)
                complain("a | ends the cell of a table; write \\lvert and \\rvert");
        }
        if (parts.prose.find('$') != std::string::npos)
            complain("write inline mathematics as $`...`$; code hosts change signs in $...$");
    });
    return found;
}

} // namespace rt::weave
