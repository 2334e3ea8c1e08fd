// Helpers: strings and tables, a hash, temporary folders, parallel loops.
#pragma once

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/util/paths.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <mutex>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <type_traits>
#include <vector>

namespace rt::tutor {

using Words = std::vector<std::string>;

/// Returns the lines of a text without their line ends.
inline Words lines_of(const std::string& text) {
    Words lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

inline Words words_in(const std::string& text) {
    Words words;
    std::istringstream stream(text);
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

/// Splits a line at the separators.
inline Words fields_of(std::string_view line, char separator = '\t') {
    Words fields(1);
    for (const char c : line)
        if (c == separator)
            fields.emplace_back();
        else
            fields.back() += c;
    return fields;
}

/// Returns the rest of the first line that begins with `begin`, or an empty string.
inline std::string line_after(const std::string& text, const std::string& begin) {
    for (const std::string& line : lines_of(text))
        if (line.starts_with(begin)) return line.substr(begin.size());
    return "";
}

/// Returns the text without leading and trailing whitespace.
inline std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    return first == text.npos ? "" : text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

inline std::string joined(const Words& words, const std::string& between) {
    std::string text;
    for (const std::string& word : words) text += (&word == words.data() ? "" : between) + word;
    return text;
}

template <typename Element>
void append(std::vector<Element>& elements, const std::type_identity_t<std::vector<Element>>& more) {
    elements.insert(elements.end(), more.begin(), more.end());
}

template <typename Element, typename Value>
bool contains(const std::vector<Element>& elements, const Value& value) {
    return std::ranges::find(elements, value) != elements.end();
}

/// Pads the text to `width` characters, aligned right, or left if `width` is negative.
inline std::string cell(const std::string& text, int width) {
    const std::size_t size = std::size_t(std::abs(width));
    const std::string blanks(size - std::min(size, text.size()), ' ');
    return width < 0 ? text + blanks : blanks + text;
}

/// Returns a text such as "3 of 7".
inline std::string part_of(std::size_t part, std::size_t whole, const std::string& between = " of ") {
    return std::to_string(part) + between + std::to_string(whole);
}

/// 64-bit FNV-1a hash of a sequence of strings.
class Hash {
  public:
    void add(std::string_view bytes) {
        for (const char c : bytes) state = (state ^ std::uint8_t(c)) * 0x100000001b3u;
        state = (state ^ 0x100) * 0x100000001b3u; // a separator, so that "a" "bc" differs from "ab" "c"
    }
    /// Returns the hash as 16 hexadecimal digits.
    std::string text() const {
        char digits[17];
        std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(state));
        return digits;
    }

  private:
    std::uint64_t state = 0xcbf29ce484222325u;
};

/// A new, empty folder that is removed at the end with all its contents. Its name is random and it is created
/// exclusively, so that another user cannot have prepared a link there.
class TemporaryFolder {
  public:
    /// Creates the folder in `folder`. Throws Error if that fails.
    explicit TemporaryFolder(const std::filesystem::path& folder = std::filesystem::temp_directory_path())
        : path(folder / ("raysteps." + random_digits())) {
        std::error_code failure;
        if (!std::filesystem::create_directory(path, failure))
            throw Error(text_of(folder) + ": cannot create a temporary folder here; is it writable?");
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path path;
};

/// Calls work(i) for all i < `count` on `jobs` threads. Rethrows the first exception from `work`.
template <typename Work>
void in_parallel(std::size_t count, int jobs, const Work& work) {
    std::atomic<std::size_t> next = 0;
    std::exception_ptr problem;
    std::mutex mutex;
    const auto run = [&] {
        for (std::size_t i; (i = next++) < count;) {
            try {
                work(i);
            } catch (...) {
                const std::lock_guard lock(mutex);
                if (!problem) problem = std::current_exception();
                next = count;
            }
        }
    };
    std::vector<std::thread> threads;
    for (int i = 0; i < jobs; ++i) threads.emplace_back(run);
    for (std::thread& thread : threads) thread.join();
    if (problem) std::rethrow_exception(problem);
}

} // namespace rt::tutor
