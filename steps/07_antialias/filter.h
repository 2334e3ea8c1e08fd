// Pixel filters: how far around its middle a pixel gathers light. The samples themselves are spread as the
// filter weighs, so each counts the same and no weights need adding up (filter importance sampling, Ernst,
// Stamminger and Greiner 2006).
#pragma once

#include "07_antialias/sampler.h"
#include "common/render/render.h"

#include <cmath>

namespace rt {

enum class Filter { box, tent, gaussian };

/// A coordinate in [-1, 1) with density 1 - |x|, from a uniform u in [0, 1): the inverse of its cumulative
/// distribution.
inline float sample_tent(float u) {
    //> the left half rises as a square, the right half mirrors it
    return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
    //< return u - 0.5f;
}

/// Two independent numbers with the normal distribution (mean 0, variance 1), from two uniform ones in [0,
/// 1): a radius sqrt(-2 ln u) and an angle (Box and Muller 1958). One takes the cosine, the other the SINE.
inline vec2 box_muller(vec2 u) {
    //> 1 - u.x lies in (0, 1], so the logarithm is finite
    const float radius = std::sqrt(-2 * std::log(1 - u.x));
    const float angle = 2 * pi * u.y;
    return radius * vec2(std::cos(angle), std::sin(angle));
    //< return u;
}

/// Where a sample lies from the middle of its pixel, in pixels. `width` scales the filter: at 1 the box
/// covers the pixel, the tent reaches to the middles of its neighbours, and the Gaussian has a standard
/// deviation of half a pixel.
inline vec2 sample_filter(Filter filter, vec2 u, float width) {
    switch (filter) {
    case Filter::tent: return width * vec2(sample_tent(u.x), sample_tent(u.y));
    case Filter::gaussian: return width * 0.5f * box_muller(u);
    default: return width * (u - 0.5f);
    }
}

/// The point of the picture through which a sample looks, in pixels from the top left corner.
inline vec2 film_point(const PixelSample& sample, Sampler& sampler, Filter filter, float width) {
    return vec2(sample.x, sample.y) + 0.5f + sample_filter(filter, sampler.uniform2(), width);
}

} // namespace rt
