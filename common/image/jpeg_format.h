// Decodes JPEG through libjpeg, for builds whose stb_image is too old to read every file safely.
#pragma once

#include "common/image/image_file.h"

#include <string_view>

namespace rt {

/// Decodes grey, YCbCr, RGB, CMYK and YCCK, baseline and progressive. Damaged or truncated data is decoded as
/// far as possible, with a `flaw`. Throws Error with the reason for everything else, and for a size that
/// size_error() rejects. In a build without libjpeg, it always throws.
Bitmap decode_with_libjpeg(std::string_view bytes, std::int64_t pixels_left);

} // namespace rt
