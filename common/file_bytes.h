// Whole files as bytes: read with one clear line when that is not possible, written whole or not at all.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace rt {

/// The bytes of a plain file. Throws Error for one that is missing, a folder, a device, not readable, or of
/// more than `most_bytes`.
std::string read_file(const std::string& path, std::uintmax_t most_bytes = std::uintmax_t(1) << 36);

/// Throws Error if write_file could not put a file at `path`. Leaves no trace.
void check_file_writable(const std::string& path);

/// Writes a temporary file in the same folder, makes sure that every byte arrived, and renames it. Whatever
/// goes wrong, the old file stays as it was and the temporary one is gone. Throws Error.
void write_file(const std::string& path, std::string_view bytes);

/// For a signal handler that ends the program: removes the temporary file of a write_file that is under way.
void discard_unfinished_file() noexcept;

} // namespace rt
