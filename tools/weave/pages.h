// The pages of the book in their order, and the links between them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rt::weave {

/// Returns the anchor that code hosts give a heading: lower case, hyphens for spaces, no other signs.
std::string anchor_of(const std::string& heading);

/// Returns the line with links to the previous page, the contents and the next page: in the order in which README.md
/// first names the pages of docs/. Throws Error if it does not name this one ("03_mirror").
std::string navigation(const std::filesystem::path& root, const std::string& name);

/// Returns links to the sections ("## ...") of a page of docs/.
std::string contents(const std::filesystem::path& root, const std::string& name);

/// Returns what code hosts do not show as mathematics, each as "path:line: what": $x$ without backquotes, in which they
/// change signs, commands that they refuse, and | in a table.
std::vector<std::string> unshowable_math(const std::string& page, const std::string& path);

} // namespace rt::weave
