// Rows of numbers for people: as a table in Markdown, or line by line.
#pragma once

#include "common/util/json.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace rt::bench {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

inline std::string formatted(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// Texts as they are, numbers with four digits, a dash for null and what is not finite.
inline std::string cell(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_null() || (value.is_number_float() && !std::isfinite(value.get<double>()))) return "-";
    return value.is_number_float() ? formatted("%.4g", value.get<double>()) : json::text(value);
}

/// The number in a field of an object, or `unknown` if there is none.
inline double number(const Json& object, const std::string& name) {
    const auto field = object.find(name);
    return field != object.end() && field->is_number() ? field->get<double>() : unknown;
}

/// Returns a table of objects; the columns are the fields of the first one, unless given. Columns are padded,
/// so that the text is legible as it is, and those of numbers are aligned to the right.
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
