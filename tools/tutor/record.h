// Records of what was proved or run: for each result, a hash of everything that it depends on.
// They are kept in the repository. A record changes only if a hash does, and a hash changes only if code, a
// command or an output does.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace rt::tutor {

using Record = std::map<std::string, std::string>; ///< maps "03_mirror" to its hash

/// Reads a record; empty if the file does not exist.
Record read_record(const std::filesystem::path& path);

/// Writes a record after a heading of comments (#). Does not touch a file that already has this content.
void write_record(const std::filesystem::path& path, const std::string& heading, const Record& record);

/// Returns a source without comments, with words separated by one space: what the compiler sees. Exercise
/// markers (//> and //<) are kept, because stubs depend on them; so is a comment that is followed by a quote,
/// because it may be part of a string.
std::string code_only(const std::string& source);

} // namespace rt::tutor
