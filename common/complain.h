// How every program refuses and warns: one line on stderr, which no file can turn into commands for a terminal.
#pragma once

#include <string>
#include <string_view>

namespace rt {

/// Returns `text` as a terminal may show it, in one line. Line ends and tabs become blanks. '?' takes the place
/// of every other control character (U+0000 to U+001F, U+007F to U+009F), of what changes the direction of
/// writing (U+202A to U+202E, U+2066 to U+2069), and of every byte that is not UTF-8. Letters of all languages
/// stay. All text that comes from a file or a command line passes through it before it is printed.
std::string printable(std::string_view text);

/// Returns printable(line) for each line of `text`; line ends and tabs stay.
std::string printable_lines(std::string_view text);

/// Prints printable(line) on stderr, after all that was printed before.
void print_error_line(std::string_view line);

/// Prints "program: message" by print_error_line. Returns the exit code of a refusal, 2.
int complain(const std::string& program, const std::string& message);

} // namespace rt
