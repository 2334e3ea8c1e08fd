// An image in memory, in linear light, and the sRGB transfer curve for reading and writing it.
#pragma once

#include "common/math/vec.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace rt {

/// Linear RGB, row by row from the top left: (0, 0) is the top left pixel, and y grows downward.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<vec3> pixels;

    Image() = default;
    Image(int w, int h) : width(w), height(h), pixels(std::size_t(w) * std::size_t(h)) {}

    vec3& operator()(int x, int y) { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
    const vec3& operator()(int x, int y) const {
        return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)];
    }
};

/// Returns the sRGB value in [0, 1] of linear light in [0, 1] (IEC 61966-2-1: a linear toe,
/// then a power of 1/2.4).
inline float srgb_from_linear(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

/// Returns the relative luminance of linear sRGB (IEC 61966-2-1): the Y of CIE XYZ.
inline float luminance(vec3 rgb) {
    return dot(rgb, vec3(0.2126f, 0.7152f, 0.0722f));
}

inline bool is_finite(vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Returns the colour that files and screens show: magenta if it is not finite.
inline vec3 visible(vec3 colour) {
    return is_finite(colour) ? colour : vec3(1, 0, 1);
}

} // namespace rt
