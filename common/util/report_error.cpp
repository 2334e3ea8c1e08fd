// Prints errors and warnings. Each line is written as a whole, even if other threads print as well.
#include "common/util/report_error.h"

#include "common/util/utf8.h"

#include <algorithm>
#include <cstdint>
#include <iostream>

namespace rt {
namespace {

/// Returns whether a terminal interprets this character instead of showing it.
bool steers_a_terminal(std::string_view character) {
    const auto byte = [character](std::size_t i) { return static_cast<std::uint8_t>(character[i]); };
    if (character.size() == 1) return byte(0) < 0x20 || byte(0) == 0x7F;
    if (character.size() == 2) return byte(0) == 0xC2 && byte(1) < 0xA0; // U+0080 to U+009F
    if (character.size() == 4 || byte(0) != 0xE2) return false;
    return (byte(1) == 0x80 && byte(2) >= 0xA8 && byte(2) <= 0xAE) || // U+2028 to U+202E
           (byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9);   // U+2066 to U+2069
}

/// Replaces characters that must not reach a terminal. Those in `kept` stay; other white
/// space becomes a blank.
std::string replaced(std::string_view text, std::string_view kept) {
    std::string out;
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
        if (kept.find(character) != std::string_view::npos)
            out += character;
        else if (character == "\n" || character == "\r" || character == "\t")
            out += ' ';
        else if (length == 0 || steers_a_terminal(character))
            out += '?';
        else
            out += character;
        text.remove_prefix(character.size());
    }
    return out;
}

} // namespace

std::string printable(std::string_view text) {
    return replaced(text, "");
}

std::string printable_lines(std::string_view text) {
    return replaced(text, "\n\t");
}

void print_error_line(std::string_view line) {
    std::cout << std::flush;
    std::cerr << printable(line) + "\n" << std::flush;
}

int report_error(const std::string& program, const std::string& message) {
    print_error_line(program + ": " + message);
    return 2;
}

} // namespace rt
