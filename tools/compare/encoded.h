// A picture as stored in a file: values are known up to the rounding, and white in a PNG means "at least 1".
#pragma once

#include "tools/compare/difference.h"
#include "common/image/image.h"

#include <string>

namespace rt::compare {

enum class Encoding {
    floats, ///< in memory: exact
    hdr,    ///< 8 bits per channel with a common exponent
    png     ///< 8 bits per channel on the sRGB curve, clipped at white
};

struct EncodedImage {
    Image image;
    Encoding encoding = Encoding::floats;
    int channels = 3; ///< in the file, 1 to 4
};

/// Reads a .hdr or .png file. Throws Error with the path and the reason.
EncodedImage read_encoded(const std::string& path);

/// The range of values that each stored value may have had before rounding.
struct Intervals {
    Image low, high;
};
Intervals intervals_of(const EncodedImage& encoded);

/// A pair of pictures for compare_pixels().
struct Pair {
    Image test, reference;
};

/// Returns the pictures unchanged if they have the same encoding, so that equal pictures have equal values;
/// otherwise the values in both intervals that are closest to each other.
Pair comparable(const EncodedImage& test, const EncodedImage& reference);

/// Compares like compare_pixels(), but by the gap between the intervals; overlapping intervals are equal.
Difference interval_distance(const Intervals& test, const Intervals& reference);

/// Convert between linear and sRGB values, without clipping at 1.
vec3 srgb_encoded(vec3 linear);
vec3 srgb_decoded(vec3 srgb);

} // namespace rt::compare
