// Image files: writes PNG (8-bit sRGB) and Radiance .hdr (linear, shared exponent), reads JPEG, TGA, BMP too.
#pragma once

#include "common/image/image.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rt {

/// Limits of the images that can be read, written or rendered.
inline constexpr int max_dimension = 1 << 14;
inline constexpr std::int64_t max_pixels = std::int64_t(1) << 27;
inline constexpr std::uintmax_t max_file_bytes = std::uintmax_t(1) << 30; // stb counts bytes in an int

/// Limit for all textures of a model together. At 18 bytes per pixel, 6 here and 12 as linear
/// colours, they take 2 GB.
inline constexpr std::int64_t max_texture_pixels = (std::int64_t(1) << 31) / 18;

/// Returns why an image of this size cannot be read or written, or "" if it can. A texture may have at most
/// `pixels_left` pixels, the part of max_texture_pixels that is not used yet.
std::string size_error(int width, int height, std::int64_t pixels_left = max_pixels);

/// An image as stored in a file, with no meaning assigned to its values yet; row by row from the top.
struct Bitmap {
    int width = 0;
    int height = 0;
    /// 3 * width * height values, 0 to 65535. An 8-bit value v is stored as v * 257, a grey value
    /// in all three channels.
    std::vector<std::uint16_t> values;
    /// The alpha channel, one value per pixel; empty if the image is opaque.
    std::vector<std::uint16_t> opacity;
    /// The defect of a file that was read only in part, such as "is cut short"; usually empty.
    std::string flaw;
};

/// Opacity of a surface: one value per pixel, row by row from the top, 0 to 65535. Below
/// half_opaque there is a hole.
struct Mask {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> opacity;
};
inline constexpr std::uint16_t half_opaque = 32768; ///< the minimum opacity of a pixel that is not a hole

/// Throws Error if `path` cannot be written: unknown extension, missing folder, a folder of that name, no
/// permission. Call it before rendering. Leaves no trace on the disk.
void check_writable(const std::string& path);

/// Writes an image in the format of the file name's extension: .png clamps to [0, 1] and applies the exact
/// sRGB curve; .hdr keeps linear light (negative values become 0; values that are too large become the
/// largest of the format). Writes a temporary file beside it and renames it, so that the old file stays until
/// the new one is complete. Pixels that are not finite are written as magenta.
void write_image(const std::string& path, const Image& image);

/// Returns the maximum number of bytes of memory that write_image allocates.
std::size_t memory_to_write(int width, int height);

/// Reads an image as linear RGB: .hdr values as radiance, all others through the inverse of the
/// exact sRGB curve. Drops alpha. Throws Error with the path and the reason, also for a file that
/// is damaged only in part.
Image read_image(const std::string& path);

/// Reads a PNG, JPEG, TGA or BMP as stored, or an .hdr clamped to 1 and converted by the sRGB curve. Alpha
/// that is 0 everywhere (as in many TGA files) is ignored. Throws Error for a damaged file, and, before
/// allocating memory, for a size that size_error() rejects. A truncated JPEG is read as far as possible.
Bitmap read_bitmap(const std::string& path, std::int64_t pixels_left = max_pixels);

/// Returns `path` as an absolute path, for printing.
std::string absolute_path(const std::string& path);

} // namespace rt
