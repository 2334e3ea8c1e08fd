// The values of options as typed: parsed, compared with their range, and refused in one sentence.
#include "common/cli/option_values.h"

#include "common/util/error.h"
#include "common/util/suggestion.h"
#include "common/util/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <type_traits>

namespace rt {
namespace {

/// Returns the decimal number that all of `text` spells, if it is in [low, high].
template <typename Number>
std::optional<Number> number_in(const std::string& text, Number low, Number high) {
    const char *const begin = text.data(), *const end = begin + text.size(), *stop = begin;
    Number value{};
    if constexpr (std::is_integral_v<Number>) {
        const bool plus = text[0] == '+' && text[1] != '-';
        if (const auto [last, error] = std::from_chars(begin + plus, end, value); error == std::errc())
            stop = last;
    } else {
        double number = 0;
        stop = read_number(begin, end, number);
        value = Number(number);
    }
    if (text.empty() || stop != end || value < low || value > high) return {};
    return value;
}

/// Returns the `count` numbers separated by commas, or an empty vector if there are more or fewer, or if one
/// is not a number in [low, high].
template <typename Number>
std::vector<Number> parse_list(const std::string& text, std::size_t count, Number low, Number high) {
    std::vector<Number> values;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::optional<Number> value = number_in(text.substr(begin, end - begin), low, high);
        if (!value || values.size() == count) return {};
        values.push_back(*value);
        begin = end + 1;
    }
    return values.size() == count ? values : std::vector<Number>();
}

} // namespace

template <typename Number>
std::string text_of(Number value) {
    if constexpr (std::is_integral_v<Number>) {
        return std::to_string(value);
    } else {
        std::array<char, 32> text{};
        std::snprintf(text.data(), text.size(), "%g", double(value));
        return text.data();
    }
}

template <typename Number>
Number parse_number(const std::string& name, const std::string& text, Number low, Number high) {
    if (const std::optional<Number> value = number_in(text, low, high)) return *value;
    constexpr bool whole = std::is_integral_v<Number>;
    throw Error("--" + name + " " + in_quotes(text) +
                (whole ? " is not a whole number from " : " is not a number from ") + text_of(low) + " to " +
                text_of(high));
}

template std::string text_of(int);
template std::string text_of(float);
template std::string text_of(std::uint64_t);
template int parse_number(const std::string&, const std::string&, int, int);
template float parse_number(const std::string&, const std::string&, float, float);
template std::uint64_t parse_number(const std::string&, const std::string&, std::uint64_t, std::uint64_t);

dvec3 parse_vector(const std::string& name, const std::string& text) {
    constexpr double largest = std::numeric_limits<float>::max();
    const std::vector<double> v = parse_list(text, 3, -largest, largest);
    if (v.empty())
        throw Error("--" + name + " " + in_quotes(text) +
                    " is not three finite numbers x,y,z, as in 0,1.5,-2");
    return {v[0], v[1], v[2]};
}

int parse_choice(const std::string& name, const std::string& text, const std::vector<std::string>& names) {
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end())
        throw Error("--" + name + " " + in_quotes(text) + " is not a choice" + suggestion(text, names, "") +
                    ": " + one_of(names));
    return int(found - names.begin());
}

Crop parse_crop(const std::string& text, int width, int height) {
    const std::vector<int> c = parse_list(text, 4, 0, max_image_dimension);
    if (c.empty() || c[0] >= c[2] || c[2] > width || c[1] >= c[3] || c[3] > height)
        throw Error("--crop " + in_quotes(text) +
                    " is not four whole numbers x0,y0,x1,y1 with 0 <= x0 < x1 <= " + text_of(width) +
                    " and 0 <= y0 < y1 <= " + text_of(height));
    return {c[0], c[1], c[2], c[3]};
}

std::string one_of(const std::vector<std::string>& names) {
    std::string list = "one of ";
    for (const std::string& name : names) list += (&name == &names.front() ? "" : ", ") + name;
    return list;
}

} // namespace rt
