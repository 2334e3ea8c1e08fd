// Reads image files as stored values: PNG, TGA and BMP through stb, JPEG through stb or libjpeg.
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/image/hdr_format.h"
#include "common/image/image_file.h"
#include "common/image/jpeg_format.h"
#include "common/image/image_kind.h"
#include "common/image/stb_memory.h"

#define STBI_NO_STDIO
#include <stb_image.h>

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <memory>

namespace rt {
namespace {

Error undecodable() {
    if (stb_memory.was_refused) return Error("is damaged (it holds more data than an image of its size)");
    const char* const said = stbi_failure_reason();
    std::string reason = said && *said ? said : "no reason given";
    const auto is_odd = [](char c) { return c < ' ' || c > '~'; }; // stb's message may quote file bytes
    std::replace_if(reason.begin(), reason.end(), is_odd, '?');
    return Error("is damaged or of an unusual kind (" + reason + "); save it as PNG again");
}

/// The size and format that a file states in its header.
struct Header {
    int width = 0, height = 0, channels = 0;
    bool is_deep = false; ///< 16 bits per value
};

Header header_of(const std::string& bytes) {
    const auto* const data = reinterpret_cast<const stbi_uc*>(bytes.data());
    Header header;
    if (!stbi_info_from_memory(data, int(bytes.size()), &header.width, &header.height, &header.channels))
        throw undecodable();
    if (header.height < 0 && header.height > -INT_MAX) header.height = -header.height; // a top-down BMP
    header.is_deep = stbi_is_16_bit_from_memory(data, int(bytes.size())) != 0;
    return header;
}

/// Returns the size of the largest memory block that decoding may need: the pixels with an alpha channel
/// added, the data of an interlaced PNG in a buffer that doubles, or the file's own bytes in such a buffer.
std::size_t largest_block(const Header& header, std::size_t file_bytes) {
    constexpr std::size_t padding = 64; // blocks of a JPEG, and the filter byte of a PNG row
    const std::size_t pixels = (std::size_t(header.width) + padding) * (std::size_t(header.height) + padding);
    return pixels * std::size_t(2 * header.channels) * (header.is_deep ? 2 : 1) + 2 * file_bytes;
}

/// Drops an alpha channel that is 1 everywhere or 0 everywhere, since it carries no information.
void drop_even_opacity(std::vector<std::uint16_t>& opacity) {
    const auto all_are = [&](std::uint16_t value) {
        return std::all_of(opacity.begin(), opacity.end(), [&](std::uint16_t o) { return o == value; });
    };
    if (all_are(65535) || all_are(0)) opacity = {};
}

/// Converts `channels` values per pixel (grey or RGB, with or without alpha) to a Bitmap.
template <typename Value>
Bitmap unpacked(const Value* values, const Header& header) {
    constexpr int scale = sizeof(Value) == 1 ? 257 : 1;
    Bitmap bitmap{header.width, header.height, {}, {}, ""};
    const std::size_t count = std::size_t(header.width) * std::size_t(header.height);
    const std::size_t channels = std::size_t(header.channels);
    const bool is_grey = channels < 3, has_alpha = channels % 2 == 0;
    bitmap.values.resize(3 * count);
    if (has_alpha) bitmap.opacity.resize(count);
    for (std::size_t i = 0; i < count; ++i, values += channels) {
        for (std::size_t c = 0; c < 3; ++c)
            bitmap.values[3 * i + c] = std::uint16_t(values[is_grey ? 0 : c] * scale);
        if (has_alpha) bitmap.opacity[i] = std::uint16_t(values[channels - 1] * scale);
    }
    drop_even_opacity(bitmap.opacity);
    return bitmap;
}

template <typename Value, typename Load>
Bitmap load_all(const std::string& bytes, Load load) {
    Header header;
    const std::unique_ptr<Value, void (*)(void*)> values(load(reinterpret_cast<const stbi_uc*>(bytes.data()),
                                                              int(bytes.size()), &header.width,
                                                              &header.height, &header.channels, 0),
                                                         stbi_image_free);
    if (!values) throw undecodable();
    return unpacked(values.get(), header);
}

Bitmap decode_with_stb(ImageKind kind, std::string& bytes, std::int64_t pixels_left) {
    stb_memory = {};
    const Header header = header_of(bytes);
    if (const std::string why = size_error(header.width, header.height, pixels_left); !why.empty())
        throw Error(why);
    if (kind == ImageKind::png) bytes = mended_png(bytes);
    if (kind == ImageKind::bmp) bytes = mended_bmp(bytes, header.width, header.height);
    if (kind == ImageKind::tga) check_tga(bytes, header.width, header.height);
    stb_memory.largest_block = largest_block(header, bytes.size());
    if (header.is_deep) return load_all<std::uint16_t>(bytes, stbi_load_16_from_memory);
    return load_all<std::uint8_t>(bytes, stbi_load_from_memory);
}

Bitmap decode_jpeg(std::string& bytes, std::int64_t pixels_left) {
#if defined(RT_STB_JPEG) && RT_STB_JPEG
    Bitmap bitmap = decode_with_stb(ImageKind::jpeg, bytes, pixels_left);
#else
    Bitmap bitmap = decode_with_libjpeg(bytes, pixels_left);
#endif
    if (is_cut_jpeg(bytes)) bitmap.flaw = "is cut short";
    return bitmap;
}

Bitmap bitmap_of(const Image& image) {
    Bitmap bitmap{image.width, image.height, {}, {}, ""};
    bitmap.values.reserve(3 * image.pixels.size());
    for (const vec3& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c)
            bitmap.values.push_back(
                std::uint16_t(srgb_from_linear(std::clamp(pixel[c], 0.0f, 1.0f)) * 65535 + 0.5f));
    }
    return bitmap;
}

} // namespace

Bitmap read_bitmap(const std::string& path, std::int64_t pixels_left) {
    std::string bytes = read_file(path, max_file_bytes);
    if (bytes.empty()) throw Error(path + ": is empty");
    try {
        const ImageKind kind = image_kind_of(path, bytes);
        if (kind == ImageKind::hdr) return bitmap_of(decode_hdr(bytes, pixels_left));
        if (kind == ImageKind::jpeg) return decode_jpeg(bytes, pixels_left);
        if (kind == ImageKind::unknown)
            throw Error("is damaged or not a PNG, JPEG, TGA, BMP or HDR image; save it as PNG again");
        return decode_with_stb(kind, bytes, pixels_left);
    } catch (const Error& problem) {
        throw Error(path + ": " + problem.what());
    }
}

} // namespace rt
