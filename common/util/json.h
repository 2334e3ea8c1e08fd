// Just enough JSON to write numbers and texts for other programs.
#pragma once

#include "common/util/file_bytes.h"
#include "common/util/utf8.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rt::json {

/// A JSON string, quotes included. Control characters are escaped; bytes that are not UTF-8 become U+FFFD.
inline std::string text(std::string_view text) {
    std::string out = "\"";
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        const char c = text[0];
        char escape[8];
        std::snprintf(escape, sizeof escape, "\\u%04x", unsigned(c) & 0xFF);
        if (length == 0)
            out += "\xEF\xBF\xBD";
        else if ((length == 1 && c < ' ') || c == '\x7F')
            out += escape;
        else
            out.append(c == '"' || c == '\\' ? "\\" : "").append(text.substr(0, length));
        text.remove_prefix(length == 0 ? 1 : length);
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
    for (const auto& [name, value] : fields) out += (out.size() > 1 ? ", " : "") + text(name) + ": " + value;
    return out + "}";
}

/// One element a line.
inline std::string array(const std::vector<std::string>& elements) {
    std::string out = "[";
    for (const std::string& element : elements) out += (out.size() > 1 ? ",\n  " : "\n  ") + element;
    return out + (elements.empty() ? "]" : "\n]");
}

/// What a program was asked to write; an empty path is no file. Throws Error.
inline void write(const std::string& path, const std::string& text) {
    if (!path.empty()) write_file(path, text + "\n");
}

/// Throws Error if write could not: better before the work than after it.
inline void check_writable(const std::string& path) {
    if (!path.empty()) check_file_writable(path);
}

} // namespace rt::json
