// Records of what was proved or run, kept in the repository: of each thing the key of all that it depends on. A record
// changes only when a key does, and a key only when code, a command or an output does.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace rt::tutor {

using Record = std::map<std::string, std::string>; ///< from "03_mirror" to its key

/// Reads a record; an empty one if the file is not there.
Record read_record(const std::filesystem::path& path);

/// Writes a record below a heading of comments (#). Leaves a file alone that says the same already.
void write_record(const std::filesystem::path& path, const std::string& heading, const Record& record);

/// Returns a source without its comments, its words one blank apart: what a compiler sees of it. The marks of exercises,
/// //> and //<, stay, since stubs are cut by them; so does a comment with a quote behind it, which may be a text.
std::string code_only(const std::string& source);

} // namespace rt::tutor
