// How every program refuses and warns: one line on stderr, and nothing in it steers the terminal.
#pragma once

#include <string>
#include <string_view>

namespace rt {

/// Returns `text` as a terminal may show it, in one line. Line ends and tabs become blanks; '?' replaces
/// other control characters (U+0000 to U+001F, U+007F to U+009F), line separators and what changes the
/// direction of writing (U+2028 to U+202E, U+2066 to U+2069), and bytes that are not UTF-8. Letters of all
/// languages stay. All text that comes from a file or a command line goes through this before it is printed.
std::string printable(std::string_view text);

/// Returns printable(line) for each line of `text`; line ends and tabs stay.
std::string printable_lines(std::string_view text);

/// Prints printable(line) on stderr, after all that was printed before.
void print_error_line(std::string_view line);

/// Prints "program: message" by print_error_line. Returns the exit code of a refusal, 2.
int report_error(const std::string& program, const std::string& message);

} // namespace rt
