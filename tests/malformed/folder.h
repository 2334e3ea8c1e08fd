// A temporary folder for the files of a check, mostly malformed ones, and capture of errors.
#pragma once

#include "common/util/error.h"
#include "common/util/paths.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iostream>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <string_view>

namespace rt::malformed {

namespace fs = std::filesystem;

/// A unique folder below the system's temporary one, removed with its contents.
class Folder {
  public:
    Folder() : path(fs::temp_directory_path() / ("raysteps_" + std::to_string(std::random_device{}()))) {
        fs::create_directories(path);
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string operator/(const std::string& name) const { return text_of(path / path_of(name)); }

    /// Writes a file and returns its path.
    std::string write(const std::string& name, std::string_view bytes) const {
        const fs::path file = path / path_of(name);
        fs::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
        return *this / name;
    }
    int files() const { return int(std::distance(fs::directory_iterator(path), fs::directory_iterator())); }

    const fs::path path;
};

inline std::string bytes_of(const std::string& path) {
    std::ifstream stream(path_of(path), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// Returns the message of the Error that `action` throws, or "no error". The message must be one line.
template <typename Action>
std::string error_of(Action action) {
    try {
        action();
    } catch (const Error& error) {
        const std::string message = error.what();
        CHECK_MESSAGE(message.find('\n') == std::string::npos, ("more than one line: " + message));
        return message;
    }
    return "no error";
}

inline bool contains(std::string_view text, std::string_view part) {
    return text.find(part) != std::string_view::npos;
}

/// Captures stderr during its lifetime.
class Stderr {
  public:
    Stderr() : before(std::cerr.rdbuf(stream.rdbuf())) {}
    ~Stderr() { std::cerr.rdbuf(before); }
    Stderr(const Stderr&) = delete;
    Stderr& operator=(const Stderr&) = delete;

    std::string text() const { return stream.str(); }

  private:
    std::ostringstream stream;
    std::streambuf* before;
};

} // namespace rt::malformed

/// Checks that an error message contains all these parts.
#define CHECK_ERROR(message, ...)                                                                            \
    do {                                                                                                     \
        const std::string text_of_error = (message);                                                         \
        for (const std::string& part : std::initializer_list<std::string>{__VA_ARGS__})                      \
            CHECK_MESSAGE(rt::malformed::contains(text_of_error, part),                                      \
                          ("expected \"" + part + "\" in: " + text_of_error));                               \
    } while (false)
