// A picture as a file holds it: each value is known up to the file's rounding, and what is white in a PNG may
// be any brighter.
#pragma once

#include "tools/compare/compare.h"
#include "common/image/image.h"

#include <string>

namespace rt {

enum class Storage {
    floats, ///< in memory: exact
    hdr,    ///< 8 bits of the largest channel
    png     ///< 8 bits of the sRGB curve, cut off at white
};

struct StoredImage {
    Image image;
    Storage storage = Storage::floats;
    int channels = 3; ///< in the file, 1 to 4
};

/// Throws Error with the path and the reason.
StoredImage read_stored(const std::string& path);

/// What each value may have been before it was stored.
struct Spans {
    Image low, high;
};
Spans spans_of(const StoredImage& stored);

/// Two pictures that difference() can compare.
struct Pair {
    Image test, reference;
};

/// As they are where both are stored alike, so that equal pictures have equal values; else the values in both
/// spans that are nearest to each other.
Pair comparable(const StoredImage& test, const StoredImage& reference);

/// As difference(), of the gaps between the spans: where they overlap, the pictures agree.
Difference gap(const Spans& test, const Spans& reference);

/// Both ways of the sRGB curve for all of a colour, without an end at 1.
vec3 srgb_encoded(vec3 linear);
vec3 srgb_decoded(vec3 srgb);

} // namespace rt
