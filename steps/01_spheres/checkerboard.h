// A checkerboard: a pattern of two colours on a matte surface.
#pragma once

#include "01_spheres/diffuse.h"

namespace rt {

/// Squares of two colours, `size` wide in uv.
struct Checker {
    vec3 even;
    vec3 odd;
    float size = 1;
};

inline Diffuse at(const Checker& checker, vec2 uv) {
    //> floor, not a cast to int, which would make the two squares beside zero one
    const vec2 square = floor(uv / checker.size);
    const bool odd = glm::mod(square.x + square.y, 2.0f) != 0;
    return {odd ? checker.odd : checker.even};
    //< return {checker.even};
}

template <typename S>
Diffuse matte_at(const Checker& checker, const S&, const Hit& hit) {
    return at(checker, hit.uv);
}

} // namespace rt
