// How text and pictures are escaped for a web page: JSON for the one, base64 for the other.
#include "tools/tutor/embed.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/util/utf8.h"

#include <cstdint>
#include <cstdio>

namespace rt {
namespace {

std::uint8_t byte_at(std::string_view bytes, std::size_t i) {
    return static_cast<std::uint8_t>(bytes[i]);
}

std::string escaped(std::uint8_t c) {
    char text[8];
    std::snprintf(text, sizeof text, "\\u%04x", unsigned(c));
    return text;
}

/// The four bytes of a big-endian number, as PNG has them.
std::uint32_t big_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | byte_at(bytes, i);
    return value;
}

} // namespace

std::string embedded_text(std::string_view text) {
    std::string out = "\"";
    while (!text.empty()) {
        const std::size_t length = character_length(text);
        const std::uint8_t c = byte_at(text, 0);
        if (length == 0)
            out += "\xEF\xBF\xBD";
        else if (c < ' ' || c == 0x7F || c == '"' || c == '\\' || c == '<' || c == '>' || c == '&')
            out += escaped(c);
        else
            out += text.substr(0, length);
        text.remove_prefix(length == 0 ? 1 : length);
    }
    return out + "\"";
}

std::string base64(std::string_view bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t left = bytes.size() - i;
        const std::uint32_t three = std::uint32_t(byte_at(bytes, i)) << 16 |
                                    (left > 1 ? std::uint32_t(byte_at(bytes, i + 1)) << 8 : 0) |
                                    (left > 2 ? std::uint32_t(byte_at(bytes, i + 2)) : 0);
        out += digits[three >> 18];
        out += digits[three >> 12 & 63];
        out += left > 1 ? digits[three >> 6 & 63] : '=';
        out += left > 2 ? digits[three & 63] : '=';
    }
    return out;
}

EmbeddedPicture embedded_picture(const std::filesystem::path& path) {
    constexpr std::string_view opening("\x89PNG\r\n\x1A\n\0\0\0\rIHDR", 16); // then width and height
    const std::string bytes = read_file(path.string());
    if (bytes.size() < 24 || bytes.compare(0, opening.size(), opening) != 0)
        throw Error(path.string() + ": is no PNG picture; render it anew");
    const std::string_view size = std::string_view(bytes).substr(opening.size());
    return {int(big_endian(size)), int(big_endian(size.substr(4))), "data:image/png;base64," + base64(bytes)};
}

} // namespace rt
