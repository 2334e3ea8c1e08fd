// Pictures on disk: PNG (8-bit sRGB) and Radiance .hdr (linear, shared exponent), written whole or not at
// all.
#pragma once

#include "common/image.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rt {

/// What this program reads and writes at most; also what a render may ask for.
inline constexpr int largest_side = 1 << 14;
inline constexpr std::int64_t most_pixels = std::int64_t(1) << 27;

/// Why a picture of this size is not read or written, in words; empty if it is.
std::string size_problem(int width, int height);

/// Bytes or 16-bit words as a file holds them, before anyone has decided what they mean.
/// Three channels, row by row from the top; a grey file's value stands in all three, alpha is dropped.
struct Bitmap {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t>
        values; ///< 3 * width * height, 0 to 65535 (an 8-bit value v stands as v * 257)
};

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

/// A PNG or .hdr as linear RGB (PNG: the exact sRGB curve undone). Throws Error with the path and the reason.
Image read_image(const std::string& path);

/// A PNG (or JPEG where the stb at hand reads it safely) as it stands in the file. Throws Error.
Bitmap read_bitmap(const std::string& path);

/// `path` made absolute, for printing.
std::string absolute_path(const std::string& path);

} // namespace rt
