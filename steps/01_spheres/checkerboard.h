// A checkerboard: a pattern of two colours on a matte surface.
#pragma once

#include "01_spheres/diffuse.h"

namespace rt {

/// Squares of two colours, `size` wide in uv.
struct Checkerboard {
    vec3 even;
    vec3 odd;
    float size = 1;
};

inline Diffuse evaluate(const Checkerboard& checkerboard, vec2 uv) {
    //> which of the two colours has the square that uv lies in, also left of zero?
    const vec2 square = floor(uv / checkerboard.size);
    const bool odd = glm::mod(square.x + square.y, 2.0f) != 0;
    return {odd ? checkerboard.odd : checkerboard.even};
    //< return {checkerboard.even};
}

template <typename S>
Diffuse matte_at(const Checkerboard& checkerboard, const S&, const Hit& hit) {
    return evaluate(checkerboard, hit.uv);
}

} // namespace rt
