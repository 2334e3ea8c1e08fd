// Just enough JSON to write numbers and texts for other programs.
#pragma once

#include "common/file_bytes.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rt {

inline std::string json_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (c >= ' ') out += c;
    }
    return out + "\"";
}

/// Six significant digits; null for what is not a number.
inline std::string number(double value) {
    if (!std::isfinite(value)) return "null";
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

inline std::string number(std::int64_t value) {
    return std::to_string(value);
}

using Fields = std::vector<std::pair<std::string, std::string>>;

/// The values are JSON already.
inline std::string object(const Fields& fields) {
    std::string out = "{";
    for (const auto& [name, value] : fields)
        out += (out.size() > 1 ? ", " : "") + json_text(name) + ": " + value;
    return out + "}";
}

/// One element a line.
inline std::string array(const std::vector<std::string>& elements) {
    std::string out = "[";
    for (const std::string& element : elements) out += (out.size() > 1 ? ",\n  " : "\n  ") + element;
    return out + (elements.empty() ? "]" : "\n]");
}

/// What a program was asked to write; an empty path is no file. Throws Error.
inline void write_text(const std::string& path, const std::string& text) {
    if (!path.empty()) write_file(path, text + "\n");
}

/// Throws Error if write_text could not: better before the work than after it.
inline void check_text(const std::string& path) {
    if (!path.empty()) check_file_writable(path);
}

} // namespace rt
