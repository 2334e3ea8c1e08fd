// Finds the files that an OBJ or MTL file names as such files really occur:
// in quotes, with spaces or backslashes, in the wrong case, or with a path of another computer.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rt {

/// Returns `name` without its enclosing quotes, if it has any.
std::string unquoted(std::string_view name);

/// The names of an mtllib line, in which `name_space` separates words. `whole`: the line as a single name
/// with spaces. `parts`: the line as several names; quotes keep words together.
struct NamesOfLine {
    std::string whole;
    std::vector<std::string> parts;
};
NamesOfLine names_of_line(std::string text);

/// Returns the paths where a file called `name` may be: the stated path relative to each folder, then its
/// bare file name in each folder.
std::vector<std::filesystem::path> candidates(const std::string& name,
                                              const std::vector<std::filesystem::path>& folders);

/// Returns those of `paths` where a file exists. If there are none, returns existing files whose
/// paths differ only in case.
std::vector<std::filesystem::path> existing(const std::vector<std::filesystem::path>& paths);

/// Returns all paths, separated by commas, for a message.
std::string listed(const std::vector<std::filesystem::path>& paths);

/// Returns the canonical name of a file, for testing whether two paths name the same file.
std::string one_name_of(const std::filesystem::path& path);

} // namespace rt
