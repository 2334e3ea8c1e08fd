// Detects the format of an image file, and checks what stb_image would take on trust.
#include "common/image/image_kind.h"

#include "common/util/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>

namespace rt {
namespace {

constexpr std::string_view png_magic{"\x89PNG\r\n\x1a\n", 8};
constexpr std::size_t chunk_frame = 12;      // length, type and checksum of a PNG chunk, in bytes
constexpr std::size_t most_inflation = 1032; // the largest expansion factor of deflate
constexpr std::size_t most_colours = 256;

Error cut_short() {
    return Error("is cut short");
}

/// Returns the byte at offset `at`. Throws Error past the end.
std::size_t byte(std::string_view bytes, std::size_t at) {
    if (at >= bytes.size()) throw cut_short();
    return std::uint8_t(bytes[at]);
}

std::size_t big_endian_32(std::string_view bytes, std::size_t at) {
    return byte(bytes, at) << 24 | byte(bytes, at + 1) << 16 | byte(bytes, at + 2) << 8 | byte(bytes, at + 3);
}

std::size_t little_endian_16(std::string_view bytes, std::size_t at) {
    return byte(bytes, at) | byte(bytes, at + 1) << 8;
}

std::size_t little_endian_32(std::string_view bytes, std::size_t at) {
    return little_endian_16(bytes, at) | little_endian_16(bytes, at + 2) << 16;
}

bool begins_with(std::string_view bytes, std::string_view magic) {
    return bytes.substr(0, magic.size()) == magic;
}

bool has_tga_ending(const std::string& path) {
    constexpr std::string_view ending = ".tga";
    return path.size() >= ending.size() &&
           std::equal(ending.rbegin(), ending.rend(), path.rbegin(),
                      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

/// Returns the minimum size of a PNG's decoded pixels, in bytes. `header` is the IHDR chunk.
std::size_t png_pixel_bytes(std::string_view header) {
    constexpr std::array<std::size_t, 7> channels{1, 0, 3, 1, 2, 0, 4}; // one per colour type
    const std::size_t width = big_endian_32(header, 8), height = big_endian_32(header, 12);
    const std::size_t bits = byte(header, 16) * channels[std::min<std::size_t>(byte(header, 17), 6)];
    return (width * bits + 7) / 8 * height;
}

/// Returns a PLTE chunk extended to 256 colours with black. Its checksum is left zero, since stb ignores it.
std::string full_palette(std::string_view chunk) {
    std::string full("\0\0\3\0", 4);
    full += chunk.substr(4, chunk.size() - chunk_frame + 4); // kind and colours
    full.resize(chunk_frame + 3 * most_colours, '\0');
    return full;
}

} // namespace

ImageKind image_kind_of(const std::string& path, std::string_view bytes) {
    if (begins_with(bytes, png_magic)) return ImageKind::png;
    if (begins_with(bytes, "\xff\xd8\xff")) return ImageKind::jpeg;
    if (begins_with(bytes, "BM")) return ImageKind::bmp;
    if (begins_with(bytes, "#?")) return ImageKind::hdr;
    return has_tga_ending(path) ? ImageKind::tga : ImageKind::unknown;
}

std::string mended_png(std::string_view bytes) {
    std::string mended(png_magic);
    std::size_t data = 0, needed = 0;
    for (std::size_t at = png_magic.size();;) {
        const std::string_view kind = bytes.substr(std::min(at + 4, bytes.size()), 4);
        if (kind == "IEND") break;
        const std::size_t length = big_endian_32(bytes, at);
        if (bytes.size() - at < chunk_frame || length > bytes.size() - at - chunk_frame) throw cut_short();
        const std::string_view chunk = bytes.substr(at, chunk_frame + length);
        at += chunk.size();
        if (kind == "IHDR" && length == 13) needed = png_pixel_bytes(chunk);
        if (kind == "IDAT") data += length;
        if (kind == "PLTE" && length % 3 == 0 && length < 3 * most_colours)
            mended += full_palette(chunk);
        else if (kind != "IDAT" || length > 0)
            mended += chunk;
    }
    if (data == 0) throw Error("holds no pixel data");
    if (data < needed / most_inflation) throw cut_short();
    return mended + std::string("\0\0\0\0IEND\0\0\0\0", 12);
}

std::string mended_bmp(std::string_view bytes, int width, int height) {
    const std::size_t offset = little_endian_32(bytes, 10), header = little_endian_32(bytes, 14);
    const bool is_old = header == 12;
    if (offset < 14 + header) throw Error("is damaged (its pixels begin inside its header)");
    if (!is_old && little_endian_32(bytes, 30) > 3) // stb reads half of these values as uncompressed
        throw Error("uses an unsupported compression; save it as PNG again");
    const std::size_t bits = little_endian_16(bytes, is_old ? 24 : 28);
    const std::size_t row = (std::size_t(width) * bits + 31) / 32 * 4;
    const std::size_t last_row = (std::size_t(width) * bits + 7) / 8; // which may lack its padding
    if (offset > bytes.size() || bytes.size() - offset < row * std::size_t(height - 1) + last_row)
        throw cut_short();
    const std::size_t palette = 14 + header, entry = is_old ? 3 : 4;
    if (bits > 8) return std::string(bytes);
    const std::size_t length = std::min(offset - palette, most_colours * entry);
    // stb assumes the old header to be 12 bytes longer than it is, and skips 12 bytes after the palette.
    const std::size_t gap = is_old ? 12 : 0;
    std::string mended(bytes.substr(0, palette + length));
    mended.resize(palette + most_colours * entry + gap, '\0');
    for (std::size_t i = 0; i < 4; ++i) mended[10 + i] = char(mended.size() >> 8 * i);
    return mended.append(bytes.substr(offset));
}

void check_tga(std::string_view bytes, int width, int height) {
    const auto bytes_of = [&](std::size_t at) { return (byte(bytes, at) + 7) / 8; }; // the file states bits
    const std::size_t pixel = bytes_of(16), first_colour = little_endian_16(bytes, 3);
    if (byte(bytes, 1) == 1 && first_colour > 0) // stb takes it for a number of bytes to skip
        throw Error("has a palette that starts at colour " + std::to_string(first_colour) +
                    "; save it as PNG again");
    std::size_t at = 18 + byte(bytes, 0) + little_endian_16(bytes, 5) * bytes_of(7);
    std::size_t left = std::size_t(width) * std::size_t(height);
    if (byte(bytes, 2) < 8) { // not run-length encoded
        if (bytes.size() < at + left * pixel) throw cut_short();
        return;
    }
    while (left > 0) {
        const std::size_t packet = byte(bytes, at), count = (packet & 127) + 1;
        at += 1 + (packet > 127 ? 1 : count) * pixel;
        left -= std::min(left, count);
    }
    if (at > bytes.size()) throw cut_short();
}

bool is_cut_jpeg(std::string_view bytes) {
    const std::size_t scan = bytes.rfind("\xff\xda"), end = bytes.rfind("\xff\xd9");
    return end == std::string_view::npos || (scan != std::string_view::npos && end < scan);
}

} // namespace rt
