// Facts about terminal output: text in every language is printed, and control characters are not.
#include "common/util/report_error.h"

#include "common/util/utf8.h"

#include <doctest/doctest.h>

#include <string>
#include <string_view>

using rt::printable;
using rt::printable_lines;

namespace {

/// Returns the UTF-8 bytes of a code point, which may be invalid.
std::string utf8(unsigned code) {
    const auto tail = [code](int shift) { return char(0x80 | (code >> shift & 0x3F)); };
    if (code < 0x80) return {char(code)};
    if (code < 0x800) return {char(0xC0 | code >> 6), tail(0)};
    if (code < 0x10000) return {char(0xE0 | code >> 12), tail(6), tail(0)};
    return {char(0xF0 | code >> 18), tail(12), tail(6), tail(0)};
}

bool is_surrogate(unsigned code) {
    return code >= 0xD800 && code < 0xE000;
}

bool is_control(unsigned code) {
    return code < 0x20 || (code >= 0x7F && code < 0xA0) || (code >= 0x2028 && code <= 0x202E) ||
           (code >= 0x2066 && code <= 0x2069);
}

} // namespace

TEST_CASE("every character of Unicode except control characters is printed unchanged") {
    std::string wrong;
    for (unsigned code = 0; code < 0x110000; ++code) {
        const std::string text = utf8(code);
        const bool stays = !is_control(code) && !is_surrogate(code);
        if ((printable(text) == text) != stays && wrong.size() < 100) wrong += std::to_string(code) + " ";
    }
    CHECK(wrong == "");
}

TEST_CASE("an escape sequence becomes harmless and keeps its letters") {
    CHECK(printable("x\x1b[2J\x1b]0;OWNED\x07y.png") == "x?[2J?]0;OWNED?y.png");
    CHECK(printable("\x9b"
                    "31mred") == "?31mred"); // CSI in one byte
    CHECK(printable("\xC2\x9b"
                    "31mred") == "?31mred"); // and as UTF-8
    CHECK(printable("a\x08\x7f") == "a??");
    CHECK(printable("a\u202Egnp.exe") == "a?gnp.exe"); // would be shown from right to left
    CHECK(printable(std::string_view("a\0b", 3)) == "a?b");
}

TEST_CASE("text stays on one line unless lines are requested") {
    CHECK(printable("a\nb\r\tc") == "a b  c");
    CHECK(printable_lines("a\n\tb\x1b[0m\r\n") == "a\n\tb?[0m \n");
}

TEST_CASE("letters of every language are unchanged") {
    const std::string text = "caf\u00E9 \u4E2D\u6587 \u0416 \u05D0 \U0001F600 ~";
    CHECK(printable(text) == text);
}

TEST_CASE("each byte that is not valid UTF-8 is shown as a question mark") {
    CHECK(printable("caf\xE9.png") == "caf?.png"); // Latin-1
    CHECK(printable("\xC3") == "?");               // truncated
    CHECK(printable("\xE2\x82z") == "??z");
    CHECK(printable("\xC0\xAF") == "??");           // two bytes for a slash
    CHECK(printable("\xED\xA0\x80") == "???");      // half of a surrogate pair
    CHECK(printable("\xF4\x90\x80\x80") == "????"); // above U+10FFFF
    CHECK(printable("\xE0\x9F\xBF\xFF") == "????"); // three bytes where two suffice
    CHECK(printable("\xF0\x8F\xBF\xBF") == "????");
}

TEST_CASE("printable text is unchanged by printable whatever bytes it came from") {
    int changed = 0;
    for (unsigned i = 0; i < 0x10000; ++i) {
        const std::string shown = printable(std::string{char(i >> 8), char(i), '\x9B', 'm'});
        changed += printable(shown) != shown;
    }
    CHECK(changed == 0);
    CHECK(printable("").empty());
}
