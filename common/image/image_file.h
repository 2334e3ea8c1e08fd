// Pictures on disk: PNG (8-bit sRGB) and Radiance .hdr (linear, shared exponent), written whole or not at
// all. JPEG, TGA and BMP are read as well.
#pragma once

#include "common/image/image.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rt {

/// What this program reads and writes at most; also what a render may ask for.
inline constexpr int max_dimension = 1 << 14;
inline constexpr std::int64_t max_pixels = std::int64_t(1) << 27;

/// All textures of a model together: 18 bytes per pixel, 6 here and 12 as linear colours, make 2 GB.
inline constexpr std::int64_t max_texture_pixels = (std::int64_t(1) << 31) / 18;

/// Why a picture of this size is not read or written, in words; empty if it is. A texture may have no more
/// than `pixels_left` of max_texture_pixels.
std::string size_error(int width, int height, std::int64_t pixels_left = max_pixels);

/// Bytes or 16-bit words as a file holds them, before anyone has decided what they mean, row by row from the
/// top.
struct Bitmap {
    int width = 0;
    int height = 0;
    /// 3 * width * height, 0 to 65535 (an 8-bit value v stands as v * 257; a grey file's value in all three).
    std::vector<std::uint16_t> values;
    /// The alpha channel, one value per pixel; empty if all is opaque.
    std::vector<std::uint16_t> opacity;
    /// What is wrong with a file that could be read in part, such as "is cut short"; empty for most.
    std::string flaw;
};

/// Where a surface is: one value per pixel, row by row from the top, 0 (a hole) to 65535. It has a hole where
/// that is below one half.
struct Mask {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> opacity;
};
inline constexpr std::uint16_t half_opaque = 32768; ///< the least opacity that counts as there

/// Throws Error, before anything is rendered, when `path` could not be written: an unknown ending, a folder
/// that does not exist, a folder in the file's place, no permission. Leaves no trace on the disk.
void check_writable(const std::string& path);

/// Writes by the ending: .png clamps to [0, 1] and applies the exact sRGB curve, .hdr keeps linear light
/// (negative becomes 0, what is too large for the format its largest value). Writes a temporary file beside
/// it and renames, so that the old file stays until the new one is complete. A pixel that is not finite is
/// written as magenta.
void write_image(const std::string& path, const Image& image);

/// Returns the bytes of memory that write_image takes at most, besides the image.
std::size_t memory_to_write(int width, int height);

/// A picture as linear RGB (.hdr as it stands, the exact sRGB curve undone for all others); alpha is dropped.
/// Throws Error with the path and the reason, also for a flaw.
Image read_image(const std::string& path);

/// A PNG, JPEG, TGA, BMP as it stands in the file, or an .hdr by the sRGB curve, clamped to 1. Alpha that
/// is 0 everywhere (as in many TGA files) counts for nothing. Throws Error, before memory is taken, for a
/// size that size_error() refuses, and for a file that is damaged; a cut JPEG is read as far as it goes.
Bitmap read_bitmap(const std::string& path, std::int64_t pixels_left = max_pixels);

/// `path` made absolute, for printing.
std::string absolute_path(const std::string& path);

} // namespace rt
