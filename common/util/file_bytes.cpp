// Reads and writes whole files. Every failure of the file system becomes one line that says what to do.
#include "common/util/file_bytes.h"

#include "common/util/error.h"
#include "common/util/paths.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <system_error>

namespace rt {
namespace {

namespace fs = std::filesystem;

/// The temporary file of the current write, or null. Atomic, because a signal handler reads it.
std::atomic<const char*> unfinished_file = nullptr;
static_assert(std::atomic<const char*>::is_always_lock_free);

std::string megabytes(std::uintmax_t bytes) {
    return std::to_string(bytes >> 20) + " MB";
}

std::string reason_of(const std::error_code& failure) {
    return " (" + failure.message() + ")";
}

/// Returns errno as an error code.
std::error_code last_failure() {
    return {errno, std::generic_category()};
}

/// Resolves symbolic links: a link stays, and the file that it names is written, even if that does not exist
/// yet. A file with several hard links is replaced under this name alone.
fs::path final_place(const std::string& path) {
    fs::path place = path_of(path);
    std::error_code failure;
    for (int links = 0; fs::is_symlink(fs::symlink_status(place, failure)); ++links) {
        if (links == 40) throw Error(path + ": its symbolic links form a loop; choose another name");
        place = place.parent_path() / fs::read_symlink(place, failure);
    }
    return place;
}

fs::path folder_of(const fs::path& place) {
    return place.has_parent_path() ? place.parent_path() : fs::path(".");
}

/// A temporary file beside `place` that is renamed to it once complete, and removed otherwise. Its name is
/// short, since the name of `place` may be as long as the system allows, and random, so that it is unique.
class Temporary {
  public:
    explicit Temporary(const fs::path& place_)
        : place(place_), name(text_of(folder_of(place) / ("raysteps-" + random_digits() + ".part"))) {
        unfinished_file = name.c_str();
    }
    ~Temporary() {
        std::error_code ignored;
        if (!renamed) fs::remove(path_of(name), ignored);
        unfinished_file = nullptr; // last, so that a signal handler still finds the name
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    /// Gives the temporary file the permissions of the old file, then writes the bytes. Returns the error.
    std::error_code write(std::string_view bytes) const {
        std::FILE* const file = std::fopen(name.c_str(), "wbx");
        if (!file) return last_failure();
        std::error_code failure;
        const fs::file_status old = fs::status(place, failure);
        if (fs::exists(old)) fs::permissions(path_of(name), old.permissions(), failure);
        failure.clear(); // not an error: some file systems have no permissions
        if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) failure = last_failure();
        const bool closed = std::fclose(file) == 0; // buffered bytes are written here
        return failure || closed ? failure : last_failure();
    }
    std::error_code rename() {
        std::error_code failure;
        fs::rename(path_of(name), place, failure);
        renamed = !failure;
        return failure;
    }

  private:
    const fs::path place;
    const std::string name;
    bool renamed = false;
};

void check_target(const std::string& path, const fs::path& place) {
    std::error_code failure;
    const fs::file_status status = fs::status(place, failure);
    if (status.type() == fs::file_type::none) throw Error(path + ": cannot be written" + reason_of(failure));
    if (fs::is_directory(status)) throw Error(path + ": is a folder; name a file in it");
    if (!fs::exists(status)) return;
    if (!fs::is_regular_file(status))
        throw Error(path + ": is a device or a pipe, not a plain file; choose another name");
    if (!std::ofstream(place, std::ios::binary | std::ios::app)) // append mode, so nothing changes
        throw Error(path + ": exists and is write-protected; choose another name or allow writing");
}

void check_folder(const std::string& path, const fs::path& place) {
    const fs::path folder = folder_of(place);
    std::error_code ignored;
    if (!fs::exists(folder, ignored))
        throw Error(path + ": the folder " + text_of(folder) + " does not exist; create it first");
    if (!fs::is_directory(folder, ignored)) throw Error(path + ": " + text_of(folder) + " is not a folder");
}

/// Returns the path to write for `path`, with links resolved. Throws Error if no file can be written there.
fs::path checked_place(const std::string& path) {
    const fs::path place = final_place(path);
    check_folder(path, place);
    if (!place.has_filename()) throw Error(path + ": is a folder; name a file in it");
    check_target(path, place);
    return place;
}

} // namespace

InputFile::InputFile(const std::string& path_, std::uintmax_t max_bytes) : path(path_) {
    std::error_code failure;
    const fs::file_status status = fs::status(path_of(path), failure);
    if (status.type() == fs::file_type::not_found)
        throw Error(path + ": no such file; check the name and the folder");
    if (fs::is_directory(status)) throw Error(path + ": is a folder, not a file");
    if (failure) throw Error(path + ": cannot be read" + reason_of(failure));
    if (!fs::is_regular_file(status)) throw Error(path + ": is a device or a pipe, not a plain file");
    left = fs::file_size(path_of(path), failure);
    if (failure) throw Error(path + ": cannot be read" + reason_of(failure));
    if (left > max_bytes)
        throw Error(path + ": is too large (" + megabytes(left) + ", at most " + megabytes(max_bytes) + ")");
    stream.open(path_of(path), std::ios::binary);
    if (!stream) throw Error(path + ": cannot be opened; check its permissions");
}

void InputFile::read(char* bytes, std::size_t count) {
    stream.read(bytes, std::streamsize(count));
    if (std::size_t(stream.gcount()) != count) throw Error(path + ": cannot be read to its end");
    left -= count;
}

std::string read_file(const std::string& path, std::uintmax_t max_bytes) {
    InputFile file(path, max_bytes);
    std::string bytes(std::size_t(file.bytes_left()), '\0');
    file.read(bytes.data(), bytes.size());
    return bytes;
}

std::string random_digits() {
    static const char digits[] = "0123456789abcdef";
    std::random_device device;
    std::string text;
    for (int i = 0; i < 12; ++i) text += digits[device() % 16];
    return text;
}

void check_file_writable(const std::string& path) {
    if (const std::error_code failure = Temporary(checked_place(path)).write(""))
        throw Error(path + ": cannot be written" + reason_of(failure) + "; choose another folder");
}

void write_file(const std::string& path, std::string_view bytes) {
    Temporary temporary(checked_place(path));
    const std::error_code failure = temporary.write(bytes);
    if (failure)
        throw Error(path + ": cannot be written" + reason_of(failure) +
                    "; an existing file of that name is unchanged");
    if (const std::error_code refused = temporary.rename())
        throw Error(path + ": cannot be renamed to its final name" + reason_of(refused));
}

void discard_unfinished_file() noexcept {
    const char* const name = unfinished_file.exchange(nullptr);
    if (name) std::remove(name); // only calls unlink, which is allowed in a signal handler
}

} // namespace rt
