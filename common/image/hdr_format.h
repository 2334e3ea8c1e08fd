// Radiance's .hdr format in memory: 8 bits a channel and one exponent for the three (Ward, Graphics Gems II,
// 1991).
#pragma once

#include "common/image/image_file.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace rt {

using Rgbe = std::array<std::uint8_t, 4>;

/// The nearest RGBE to a colour: value = mantissa * 2^(exponent - 136). Negative becomes 0, too large the
/// largest.
Rgbe rgbe_from_linear(vec3 colour);
vec3 linear_from_rgbe(Rgbe rgbe);

/// A whole .hdr file, run-length encoded; magenta where a pixel is not finite.
std::string encode_hdr(const Image& image);

/// Radiance: what EXPOSURE and COLORCORR lines multiplied the pixels by is divided out again. Throws Error
/// with the reason for what is damaged, cut short or too large (see size_error()). Never reads past the
/// end.
Image decode_hdr(std::string_view bytes, std::int64_t pixels_left = max_pixels);

} // namespace rt
