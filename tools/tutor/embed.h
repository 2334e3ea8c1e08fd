// Text and pictures from outside, written so that inside a web page they are nothing but data.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace rt {

/// A JSON string, quotes included, that may stand in a <script> element: <, >, & and control characters are
/// escaped, so that no text ends the element. Bytes that are not UTF-8 become U+FFFD.
std::string embedded_text(std::string_view text);

/// Base64 with padding (RFC 4648, section 4).
std::string base64(std::string_view bytes);

/// A PNG file as a data URL, and its size.
struct EmbeddedPicture {
    int width = 0;
    int height = 0;
    std::string url;
};

/// Throws Error for a file that cannot be read or is no PNG.
EmbeddedPicture embedded_picture(const std::filesystem::path& path);

} // namespace rt
