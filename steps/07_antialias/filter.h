// Pixel reconstruction filters, by filter importance sampling (Ernst, Stamminger and Greiner 2006): positions
// are drawn from the filter, so all samples have equal weight.
#pragma once

#include "07_antialias/sampler.h"
#include "common/render/render.h"

#include <cmath>

namespace rt {

enum class Filter { box, tent, gaussian };

/// Draws a coordinate in [-1, 1) with density 1 - |x|, from a uniform u in [0, 1), by inverting its
/// cumulative distribution.
inline float sample_tent(float u) {
    //> left of which x lies the fraction u of the tent's area?
    return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 - 2 * u);
    //< return u - 0.5f;
}

/// Draws two independent standard normal numbers from two uniform ones in [0, 1): a radius sqrt(-2 ln u) and
/// an angle (Box and Muller 1958). One takes the cosine, the other the SINE.
inline vec2 box_muller(vec2 u) {
    //> which radius and which angle does a point have whose two coordinates are normal? u.x may be 0
    const float radius = std::sqrt(-2 * std::log(1 - u.x));
    const float angle = 2 * pi * u.y;
    return radius * vec2(std::cos(angle), std::sin(angle));
    //< return u;
}

/// Draws the offset of a sample from the center of its pixel, in pixels. `width` scales the filter: at 1 the
/// box covers the pixel, the tent reaches to the centers of its neighbours, and the Gaussian has a standard
/// deviation of half a pixel.
inline vec2 sample_filter(Filter filter, vec2 u, float width) {
    switch (filter) {
    case Filter::tent: return width * vec2(sample_tent(u.x), sample_tent(u.y));
    case Filter::gaussian: return width * 0.5f * box_muller(u);
    default: return width * (u - 0.5f);
    }
}

/// Returns the point of the image that a sample looks through, in pixels from the top left corner.
inline vec2 film_point(const PixelSample& sample, Sampler& sampler, Filter filter, float width) {
    return vec2(sample.x, sample.y) + 0.5f + sample_filter(filter, sampler.get_2d(), width);
}

} // namespace rt
