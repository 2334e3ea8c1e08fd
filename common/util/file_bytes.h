// Reads and writes whole files as bytes. A write either completes or leaves the old file unchanged.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <string_view>

namespace rt {

/// A regular file, read from beginning to end.
class InputFile {
  public:
    /// Throws Error if the file is missing, a folder, a device, not readable, or larger than `max_bytes`.
    explicit InputFile(const std::string& path_, std::uintmax_t max_bytes = std::uintmax_t(1) << 36);

    std::uintmax_t bytes_left() const { return left; }
    /// Reads the next `count` bytes, at most bytes_left(). Throws Error if they cannot be read.
    void read(char* bytes, std::size_t count);

  private:
    std::string path;
    std::uintmax_t left = 0;
    std::ifstream stream;
};

/// Returns the bytes of a regular file. Throws Error if it is missing, a folder, a device, not readable,
/// or larger than `max_bytes`.
std::string read_file(const std::string& path, std::uintmax_t max_bytes = std::uintmax_t(1) << 36);

/// Returns twelve random hexadecimal digits, for a unique file name.
std::string random_digits();

/// Throws Error if write_file could not write a file at `path`. Leaves no trace.
void check_file_writable(const std::string& path);

/// Writes a temporary file in the same folder, checks that every byte was written, and renames it. On failure
/// the old file stays unchanged and the temporary one is removed. If `path` is a symbolic link, the file that
/// it names is written. The permissions of an old file are kept. Throws Error with the system's reason.
void write_file(const std::string& path, std::string_view bytes);

/// Removes the temporary file of a write_file in progress. For a signal handler that ends the program.
void discard_unfinished_file() noexcept;

} // namespace rt
