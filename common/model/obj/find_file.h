// Files that an OBJ or MTL file names, as people really write them: in quotes, with spaces, with
// backslashes, in capitals or not, on somebody else's disk.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rt {

/// `name` without the quotes round it, if it has some.
std::string unquoted(std::string_view name);

/// The names of a mtllib line, where `name_space` stands between words: first the whole as one name with
/// spaces in it, and apart from that each of several, where quotes hold words together.
struct NamesOfLine {
    std::string whole;
    std::vector<std::string> parts;
};
NamesOfLine names_of_line(std::string text);

/// Where a file that is called `name` may stand: as stated, seen from each folder, and by its bare name
/// there.
std::vector<std::filesystem::path> candidates(const std::string& name,
                                              const std::vector<std::filesystem::path>& folders);

/// Those of `paths` where a file is. If it is at none of them, files whose names differ from them in capitals
/// alone.
std::vector<std::filesystem::path> existing(const std::vector<std::filesystem::path>& paths);

/// All of them, for a message.
std::string listed(const std::vector<std::filesystem::path>& paths);

/// One name for a file, whatever it was called: for telling whether two are the same.
std::string one_name_of(const std::filesystem::path& path);

} // namespace rt
