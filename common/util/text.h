// Words and numbers in the text of OBJ and MTL files.
#pragma once

#include <string>
#include <string_view>

namespace rt {

/// Stands for a space inside a name, because tinyobjloader ends names at spaces.
inline constexpr char name_space = '\x1f';

constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// "path:line: message", as compilers write it.
std::string at_line(const std::string& path, int line, const std::string& message);

/// Makes a byte order mark blank.
void blank_byte_order_mark(std::string& text);

/// Makes every line end a '\n', the number of lines staying as it is.
void unify_line_ends(std::string& text);

inline constexpr int float_exponent = 38;   ///< FLT_MAX is 3.4e38
inline constexpr int double_exponent = 308; ///< DBL_MAX is 1.8e308

/// What is wrong with a number, in words: "" for a decimal number of at most `largest_exponent` digits before
/// its point.
std::string_view number_fault(std::string_view word, int largest_exponent = float_exponent);

/// Whether a program meant "not a number" or "infinite": nan, -nan(ind), inf, 1.#QNAN and the like.
bool is_not_finite(std::string_view word);

/// Reads the decimal number at `at` and returns the end of its word, or null if the word is no such number,
/// or one that does not fit a double. `*end` must be readable, and neither a digit nor a point.
const char* read_number(const char* at, const char* end, double& value);

/// `word` in quotes, short and printable whatever it holds.
std::string in_quotes(std::string_view word);

} // namespace rt
