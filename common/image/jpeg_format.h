// JPEG through libjpeg, where stb_image is too old to read every file safely.
#pragma once

#include "common/image/image_file.h"

#include <string_view>

namespace rt {

/// Grey, YCbCr, RGB, CMYK and YCCK, baseline and progressive. Data that is damaged or ends early is decoded
/// as far as it goes, with a `flaw`. Throws Error with the reason for all else, and for what size_error()
/// refuses; where the build has no libjpeg, for all.
Bitmap decode_with_libjpeg(std::string_view bytes, std::int64_t pixels_left);

} // namespace rt
