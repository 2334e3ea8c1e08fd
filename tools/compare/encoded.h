// A picture as a file holds it: each value is known up to the file's rounding, and what is white in a PNG may
// be any brighter.
#pragma once

#include "tools/compare/difference.h"
#include "common/image/image.h"

#include <string>

namespace rt::compare {

enum class Encoding {
    floats, ///< in memory: exact
    hdr,    ///< 8 bits of the largest channel
    png     ///< 8 bits of the sRGB curve, cut off at white
};

struct EncodedImage {
    Image image;
    Encoding encoding = Encoding::floats;
    int channels = 3; ///< in the file, 1 to 4
};

/// Throws Error with the path and the reason.
EncodedImage read_encoded(const std::string& path);

/// What each value may have been before it was stored.
struct Intervals {
    Image low, high;
};
Intervals intervals_of(const EncodedImage& encoded);

/// Two pictures that compare_pixels() can compare.
struct Pair {
    Image test, reference;
};

/// As they are where both are stored alike, so that equal pictures have equal values; else the values in both
/// intervals that are nearest to each other.
Pair comparable(const EncodedImage& test, const EncodedImage& reference);

/// As compare_pixels(), of the gaps between the intervals: where they overlap, the pictures agree.
Difference interval_distance(const Intervals& test, const Intervals& reference);

/// Both ways of the sRGB curve for all of a colour, without an end at 1.
vec3 srgb_encoded(vec3 linear);
vec3 srgb_decoded(vec3 srgb);

} // namespace rt::compare
