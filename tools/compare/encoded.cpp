// Computes the intervals that rounding and clipping leave, and compares pictures with them.
#include "tools/compare/encoded.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/image/image_file.h"

#include <stb_image.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace rt::compare {
namespace {

bool is_hdr(const std::string& path) {
    constexpr std::string_view ending = ".hdr";
    return path.size() >= ending.size() &&
           std::equal(ending.rbegin(), ending.rend(), path.rbegin(),
                      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

/// Returns the number of channels in the file; read_image() always returns three.
int channels_of(const std::string& path) {
    const std::string bytes = read_file(path);
    int width = 0, height = 0, channels = 0;
    if (!stbi_info_from_memory(reinterpret_cast<const stbi_uc*>(bytes.data()), int(bytes.size()), &width,
                               &height, &channels))
        throw Error(path + ": is not a picture in a supported format; save it as PNG");
    return channels;
}

float decoded(float srgb) {
    return srgb <= 0.04045f ? srgb / 12.92f : std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

/// Extends the interval by half a step of the format in both directions.
void widen_hdr(vec3& low, vec3& high) {
    int exponent = 0;
    std::frexp(std::max({low.x, low.y, low.z}), &exponent);
    const float half = std::ldexp(1.0f, exponent - 9);
    low = max(low - half, vec3(0.0f));
    high += half;
}

void widen_png(float& low, float& high) {
    const float code = srgb_from_linear(low) * 255;
    low = code < 0.5f ? 0 : decoded((code - 0.5f) / 255);
    high = code > 254.5f ? infinity : decoded((code + 0.5f) / 255);
}

/// Returns for each pair of intervals the same value if they overlap, or else the two ends that
/// face each other.
Pair facing(const Intervals& test, const Intervals& reference) {
    check_same_size(test.low, reference.low);
    Pair pair{test.low, reference.low};
    for (std::size_t i = 0; i < pair.test.pixels.size(); ++i) {
        vec3 &t = pair.test.pixels[i], &r = pair.reference.pixels[i];
        r = min(max(t, r), reference.high.pixels[i]);
        t = min(max(r, t), test.high.pixels[i]);
    }
    return pair;
}

} // namespace

vec3 srgb_encoded(vec3 linear) {
    return {srgb_from_linear(linear.x), srgb_from_linear(linear.y), srgb_from_linear(linear.z)};
}

vec3 srgb_decoded(vec3 srgb) {
    return {decoded(srgb.x), decoded(srgb.y), decoded(srgb.z)};
}

EncodedImage read_encoded(const std::string& path) {
    if (is_hdr(path)) return {read_image(path), Encoding::hdr, 3};
    EncodedImage encoded{read_image(path), Encoding::png, 3};
    encoded.channels = channels_of(path);
    return encoded;
}

Intervals intervals_of(const EncodedImage& encoded) {
    Intervals intervals{encoded.image, encoded.image};
    for (std::size_t i = 0; i < intervals.low.pixels.size(); ++i) {
        vec3 &low = intervals.low.pixels[i], &high = intervals.high.pixels[i];
        if (encoded.encoding == Encoding::hdr) widen_hdr(low, high);
        if (encoded.encoding == Encoding::png)
            for (int channel = 0; channel < 3; ++channel) widen_png(low[channel], high[channel]);
    }
    return intervals;
}

Difference interval_distance(const Intervals& test, const Intervals& reference) {
    const Pair pair = facing(test, reference);
    return compare_pixels(pair.test, pair.reference);
}

Pair comparable(const EncodedImage& test, const EncodedImage& reference) {
    if (test.encoding == reference.encoding) return {test.image, reference.image};
    return facing(intervals_of(test), intervals_of(reference));
}

} // namespace rt::compare
