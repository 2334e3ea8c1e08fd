// Prints errors and warnings: one line on stderr, without characters that control the terminal.
#pragma once

#include <string>
#include <string_view>

namespace rt {

/// Returns `text` in one line that is safe to show on a terminal. Line ends and tabs become blanks. '?'
/// replaces other control characters (U+0000 to U+001F, U+007F to U+009F), line separators and bidirectional
/// controls (U+2028 to U+202E, U+2066 to U+2069), and bytes that are not UTF-8. Letters of all languages
/// stay. All text from a file or a command line must go through this function before it is printed.
std::string printable(std::string_view text);

/// Returns `text` with printable() applied to each line; line ends and tabs stay.
std::string printable_lines(std::string_view text);

/// Prints printable(line) on stderr, after flushing stdout.
void print_error_line(std::string_view line);

/// Prints "program: message" by print_error_line. Returns the exit code for an error, 2.
int report_error(const std::string& program, const std::string& message);

} // namespace rt
