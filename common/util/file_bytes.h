// Whole files as bytes: read with one clear line when that is not possible, written whole or not at all.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

namespace rt {

/// A plain file that is read from its beginning to its end.
class InputFile {
  public:
    /// Throws Error for a file that is missing, a folder, a device, not readable, or of more than
    /// `max_bytes`.
    explicit InputFile(const std::string& path_, std::uintmax_t max_bytes = std::uintmax_t(1) << 36);

    std::uintmax_t bytes_left() const { return left; }
    /// The next `count` bytes, no more than are left. Throws Error if they cannot be read.
    void read(char* bytes, std::size_t count);

  private:
    std::string path;
    std::uintmax_t left = 0;
    std::ifstream stream;
};

/// The bytes of a plain file. Throws Error for one that is missing, a folder, a device, not readable, or of
/// more than `max_bytes`.
std::string read_file(const std::string& path, std::uintmax_t max_bytes = std::uintmax_t(1) << 36);

/// Twelve random hexadecimal digits, for a name that no other program chooses.
std::string random_digits();

/// Throws Error if write_file could not put a file at `path`. Leaves no trace.
void check_file_writable(const std::string& path);

/// Writes a temporary file in the same folder, makes sure that every byte arrived, and renames it. If that
/// fails, the old file stays as it was and the temporary one is gone. A link stays a link: the file that it
/// names is written. The permissions of an old file stay. Throws Error with the system's reason.
void write_file(const std::string& path, std::string_view bytes);

/// For a signal handler that ends the program: removes the temporary file of a write_file that is under way.
void discard_unfinished_file() noexcept;

} // namespace rt
