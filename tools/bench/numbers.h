// Numbers of a benchmark: clocks, means, and rows of results as text.
#pragma once

#include "common/util/error.h"
#include "common/util/json.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

namespace rt::bench {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Measures seconds since it was made: on the clock, or of processor time, over all threads of the program.
class Stopwatch {
  public:
    double wall() const { return std::chrono::duration<double>(Clock::now() - wall_begin).count(); }
    double cpu() const { return double(std::clock() - cpu_begin) / CLOCKS_PER_SEC; }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point wall_begin = Clock::now();
    std::clock_t cpu_begin = std::clock();
};

/// Returns `unknown` if there are no values.
inline double median(std::vector<double> values) {
    if (values.empty()) return unknown;
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

inline double mean(const std::vector<double>& values) {
    double sum = 0;
    for (const double value : values) sum += value;
    return sum / double(values.size());
}

/// Returns the geometric mean of those values that are numbers above 0; NaN, which is `unknown`, if none is.
inline double geometric_mean(const std::vector<double>& values) {
    std::vector<double> logarithms;
    for (const double value : values)
        if (value > 0) logarithms.push_back(std::log(value));
    return std::exp(mean(logarithms));
}

inline std::string formatted(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Returns texts as they are, numbers with four digits, and a dash for null and what is not finite.
inline std::string cell(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_null() || (value.is_number_float() && !std::isfinite(value.get<double>()))) return "-";
    return value.is_number_float() ? formatted("%.4g", value.get<double>()) : json::text(value);
}

/// Returns the number in a field of an object, or `unknown` if there is none.
inline double number(const Json& object, const std::string& name) {
    const Json field = object.value(name, Json());
    return field.is_number() ? field.get<double>() : unknown;
}

/// Returns a whole number from 0. Throws Error for anything else.
inline std::uint64_t count(const Json& value) {
    if (!value.is_number_integer() || (!value.is_number_unsigned() && value.get<std::int64_t>() < 0))
        throw Error("these are not the numbers of a benchmark: a count must be a whole number from 0");
    return value.get<std::uint64_t>();
}

/// Returns a table of objects in Markdown. Its columns are the fields of the first object, unless given. They
/// are padded, so that the text is legible as it is, and those of numbers are aligned to the right.
inline std::string table(const Json& list, std::vector<std::string> columns = {}) {
    if (!list.is_array() || list.empty()) return "";
    if (columns.empty())
        for (const auto& field : list[0].items()) columns.push_back(field.key());
    std::vector<std::string> lines(list.size() + 2, "|");
    for (std::string& name : columns) {
        std::vector<std::string> cells;
        for (const Json& row : list) cells.push_back(cell(row.value(name, Json())));
        const bool right = cells[0].empty() || !std::isalpha(static_cast<unsigned char>(cells[0][0]));
        std::ranges::replace(name, '_', ' ');
        std::size_t width = name.size();
        for (const std::string& text : cells) width = std::max(width, text.size());
        const auto padded = [&](const std::string& text) {
            const std::string space(width - text.size(), ' ');
            return " " + (right ? space + text : text + space) + " |";
        };
        lines[0] += padded(name);
        lines[1] += std::string(width + 1, '-') + (right ? ":|" : "-|");
        for (std::size_t i = 0; i < cells.size(); ++i) lines[i + 2] += padded(cells[i]);
    }
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text + "\n";
}

/// Prints an object on one line.
inline void print_row(const Json& row) {
    for (const auto& [name, value] : row.items()) std::printf("%s %s  ", name.c_str(), cell(value).c_str());
    std::printf("\n");
    std::fflush(stdout);
}

} // namespace rt::bench
