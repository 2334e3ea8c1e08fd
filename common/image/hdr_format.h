// The Radiance .hdr format in memory: three 8-bit mantissas with a shared exponent.
// G. Ward, "Real Pixels", Graphics Gems II, 1991.
#pragma once

#include "common/image/image_file.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace rt {

using Rgbe = std::array<std::uint8_t, 4>;

/// Returns the nearest RGBE to a colour: value = mantissa * 2^(exponent - 136). Negative values become 0;
/// values that are too large become the largest representable one.
Rgbe rgbe_from_linear(vec3 colour);
vec3 linear_from_rgbe(Rgbe rgbe);

/// Returns a complete .hdr file, run-length encoded. Pixels that are not finite are written as magenta.
std::string encode_hdr(const Image& image);

/// Returns the radiance values of a .hdr file, divided by the factors of its EXPOSURE and COLORCORR lines.
/// Throws Error with the reason if the file is damaged, truncated or too large (see size_error()).
Image decode_hdr(std::string_view bytes, std::int64_t pixels_left = max_pixels);

} // namespace rt
