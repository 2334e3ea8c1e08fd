// Reads words and numbers in the text of OBJ and MTL files, and formats messages about them.
#pragma once

#include <string>
#include <string_view>

namespace rt {

/// Replaces a space inside a name, because tinyobjloader ends names at spaces.
inline constexpr char name_space = '\x1f';

constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Returns "path:line: message", the format of compiler messages.
std::string at_line(const std::string& path, int line, const std::string& message);

/// Replaces a byte order mark at the beginning by blanks.
void blank_byte_order_mark(std::string& text);

/// Converts all line ends to '\n', without changing the number of lines.
void unify_line_ends(std::string& text);

inline constexpr int float_exponent = 38;   ///< FLT_MAX is 3.4e38
inline constexpr int double_exponent = 308; ///< DBL_MAX is 1.8e308

/// Returns what is wrong with a number, in words, or "" if it is a decimal number with at most
/// `largest_exponent` digits before its decimal point.
std::string_view number_fault(std::string_view word, int largest_exponent = float_exponent);

/// Returns whether the word spells NaN or infinity: nan, -nan(ind), inf, 1.#QNAN and the like.
bool is_not_finite(std::string_view word);

/// Reads the decimal number at `at` and returns the end of its word, or null if the word is not a decimal
/// number or does not fit a double. `*end` must be readable, and neither a digit nor a decimal point.
const char* read_number(const char* at, const char* end, double& value);

/// Returns `word` in quotes, shortened, with control characters replaced.
std::string in_quotes(std::string_view word);

} // namespace rt
