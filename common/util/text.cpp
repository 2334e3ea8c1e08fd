// Reads words and numbers in the text of OBJ and MTL files. Numbers are rounded to the nearest double.
#include "common/util/text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>

namespace rt {
namespace {

void skip_sign(const char*& at, const char* end) {
    if (at < end && (*at == '+' || *at == '-')) ++at;
}

int skip_digits(const char*& at, const char* end) {
    const char* const begin = at;
    while (at < end && is_digit(*at)) ++at;
    return int(std::min<std::ptrdiff_t>(at - begin, 100000));
}

/// Reads the digits after the 'e' of a number. Returns false if there are none.
bool read_exponent(const char*& at, const char* end, int& exponent) {
    const bool negative = at < end && *at == '-';
    skip_sign(at, end);
    const char* const begin = at;
    for (; at < end && is_digit(*at); ++at) exponent = std::min(exponent * 10 + (*at - '0'), 100000);
    exponent = negative ? -exponent : exponent;
    return at > begin;
}

/// Powers of ten, all exact: doubles represent them exactly up to 1e22.
constexpr std::array<double, 20> powers_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,
                                               1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19};

/// Reads a number in its usual spelling: up to 19 digits, optionally with a minus and a decimal point. The
/// value is the quotient of two exact doubles, so it is rounded only once (Clinger, PLDI 1990). Returns
/// null for any other word.
const char* read_plain_number(const char* at, const char* end, double& value) {
    const bool negative = *at == '-';
    if (negative) ++at;
    std::uint64_t digits = 0;
    const char* const begin = at;
    for (; is_digit(*at); ++at) digits = digits * 10 + std::uint64_t(*at - '0');
    auto count = at - begin;
    std::ptrdiff_t places = 0;
    if (*at == '.') {
        const char* const fraction = ++at;
        for (; is_digit(*at); ++at) digits = digits * 10 + std::uint64_t(*at - '0');
        places = at - fraction;
        count += places;
    }
    if (count == 0 || count > 19 || digits > std::uint64_t(1) << 53) return nullptr;
    if (at != end && !is_blank(*at)) return nullptr;
    const double size = double(digits) / powers_of_ten[std::size_t(places)];
    value = negative ? -size : size;
    return at;
}

} // namespace

std::string at_line(const std::string& path, int line, const std::string& message) {
    return path + ":" + std::to_string(line) + ": " + message;
}

void blank_byte_order_mark(std::string& text) {
    if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.replace(0, 3, "   ");
}

void unify_line_ends(std::string& text) {
    for (std::size_t i = text.find('\r'); i != std::string::npos; i = text.find('\r', i + 1))
        text[i] = i + 1 < text.size() && text[i + 1] == '\n' ? ' ' : '\n';
}

std::string_view number_fault(std::string_view word, int largest_exponent) {
    const char* at = word.data();
    const char* const end = at + word.size();
    skip_sign(at, end);
    while (at + 1 < end && *at == '0' && is_digit(at[1])) // leading zeros do not count as digits
        ++at;
    const int whole_digits = skip_digits(at, end);
    int fraction_digits = 0;
    if (at < end && *at == '.') fraction_digits = skip_digits(++at, end);
    if (whole_digits + fraction_digits == 0) return "is not a number";
    int exponent = 0;
    if (at < end && (*at == 'e' || *at == 'E') && !read_exponent(++at, end, exponent))
        return "is not a number";
    if (at != end) return "is not a number";
    return whole_digits + exponent > largest_exponent ? "is too large a number" : "";
}

bool is_not_finite(std::string_view word) {
    std::string lower(word.substr(0, 8));
    std::ranges::transform(lower, lower.begin(),
                           [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
    if (lower.starts_with('-') || lower.starts_with('+')) lower.erase(0, 1);
    return lower.starts_with("nan") || lower.starts_with("inf") || lower.starts_with("1.#");
}

const char* read_number(const char* at, const char* end, double& value) {
    if (const char* const stop = read_plain_number(at, end, value)) return stop;
    const char* const stop = std::find_if(at, end, is_blank);
    if (!number_fault({at, std::size_t(stop - at)}, double_exponent).empty()) return nullptr;
    value = std::strtod(at, nullptr);
    return stop;
}

std::string in_quotes(std::string_view word) {
    std::string text = "\"" + std::string(word.substr(0, 40)) + (word.size() > 40 ? "..." : "") + "\"";
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
    return text;
}

} // namespace rt
