// Whole files as bytes: the file system's many ways to say no, each turned into one line that says what to
// do.
#include "common/file_bytes.h"

#include "common/error.h"

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>

namespace rt {
namespace {

namespace fs = std::filesystem;

/// The temporary file of a write under way, or null: all that a signal handler may look at.
std::atomic<const char*> unfinished_file = nullptr;
static_assert(std::atomic<const char*>::is_always_lock_free);

std::string megabytes(std::uintmax_t bytes) {
    return std::to_string(bytes >> 20) + " MB";
}

/// Where the bytes go in the end: a link stays a link, and the file that it names is replaced.
fs::path final_place(const std::string& path) {
    std::error_code ignored;
    const fs::path target = fs::canonical(path, ignored);
    return ignored ? fs::path(path) : target;
}

/// A name beside `place` that no other program picks at the same time.
fs::path temporary_beside(const fs::path& place) {
    static const char digits[] = "0123456789abcdef";
    std::random_device device;
    std::string suffix = ".";
    for (int i = 0; i < 12; ++i) suffix += digits[device() % 16];
    fs::path temporary = place;
    temporary += suffix + ".part";
    return temporary;
}

/// Removes the temporary file unless it has been renamed.
class Temporary {
  public:
    explicit Temporary(const fs::path& place) : name(temporary_beside(place).string()) {
        unfinished_file = name.c_str();
    }
    ~Temporary() {
        std::error_code ignored;
        if (!renamed) fs::remove(name, ignored);
        unfinished_file = nullptr; // last, so that an interrupt in between still finds the name
    }
    Temporary(const Temporary&) = delete;
    Temporary& operator=(const Temporary&) = delete;

    bool write(std::string_view bytes) const {
        std::ofstream stream(fs::path(name), std::ios::binary | std::ios::trunc);
        stream.write(bytes.data(), std::streamsize(bytes.size()));
        stream.close(); // the last bytes go to the disk here, and a full disk says so here
        return bool(stream);
    }
    void rename_to(const fs::path& place, std::error_code& failure) {
        fs::rename(name, place, failure);
        renamed = !failure;
    }

  private:
    std::string name;
    bool renamed = false;
};

void check_target(const std::string& path, const fs::path& place) {
    std::error_code ignored;
    const fs::file_status status = fs::status(place, ignored);
    if (fs::is_directory(status)) throw Error(path + ": is a folder; name a file in it");
    if (!fs::exists(status)) return;
    if (!fs::is_regular_file(status))
        throw Error(path + ": is a device or a pipe, not a plain file; choose another name");
    if (!std::ofstream(place, std::ios::binary | std::ios::app)) // opened at its end, so nothing changes
        throw Error(path + ": exists and is write-protected; choose another name or allow writing");
}

void check_folder(const std::string& path, const fs::path& place) {
    const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
    std::error_code ignored;
    if (!fs::exists(folder, ignored))
        throw Error(path + ": the folder " + folder.string() + " does not exist; create it first");
    if (!fs::is_directory(folder, ignored)) throw Error(path + ": " + folder.string() + " is not a folder");
}

} // namespace

InputFile::InputFile(const std::string& path_, std::uintmax_t most_bytes) : path(path_) {
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (status.type() == fs::file_type::not_found)
        throw Error(path + ": no such file; check the name and the folder");
    if (fs::is_directory(status)) throw Error(path + ": is a folder, not a file");
    if (failure) throw Error(path + ": cannot be read (" + failure.message() + ")");
    if (!fs::is_regular_file(status)) throw Error(path + ": is a device or a pipe, not a plain file");
    left = fs::file_size(path, failure);
    if (failure) throw Error(path + ": cannot be read (" + failure.message() + ")");
    if (left > most_bytes)
        throw Error(path + ": is too large (" + megabytes(left) + ", at most " + megabytes(most_bytes) + ")");
    stream.open(fs::path(path), std::ios::binary);
    if (!stream) throw Error(path + ": cannot be opened; is reading it allowed?");
}

void InputFile::read(char* bytes, std::size_t count) {
    stream.read(bytes, std::streamsize(count));
    if (std::size_t(stream.gcount()) != count) throw Error(path + ": cannot be read to its end");
    left -= count;
}

std::string read_file(const std::string& path, std::uintmax_t most_bytes) {
    InputFile file(path, most_bytes);
    std::string bytes(std::size_t(file.bytes_left()), '\0');
    file.read(bytes.data(), bytes.size());
    return bytes;
}

void check_file_writable(const std::string& path) {
    const fs::path place = final_place(path);
    check_folder(path, place);
    if (!place.has_filename()) throw Error(path + ": is a folder; name a file in it");
    check_target(path, place);
    if (!Temporary(place).write(""))
        throw Error(path + ": cannot be written; is writing allowed in that folder?");
}

void write_file(const std::string& path, std::string_view bytes) {
    const fs::path place = final_place(path);
    check_folder(path, place);
    check_target(path, place);
    Temporary temporary(place);
    if (!temporary.write(bytes))
        throw Error(path +
                    ": cannot be written; is the disk full? (an older file of that name is untouched)");
    std::error_code failure;
    temporary.rename_to(place, failure);
    if (failure) throw Error(path + ": cannot be put in place (" + failure.message() + ")");
}

void discard_unfinished_file() noexcept {
    const char* const name = unfinished_file.exchange(nullptr);
    if (name) std::remove(name); // no more than a call of unlink, which a handler may make
}

} // namespace rt
