// Matte surfaces: chalk, paper, plaster. They look equally bright from everywhere.
#pragma once

#include "common/math/vec.h"

#include <cmath>

namespace rt {

struct Diffuse {
    vec3 albedo;             ///< the share of the light that comes back, in [0, 1]
    vec3 emission = vec3(0); ///< radiance that it sends out by itself, W / (m^2 sr)
};

/// The flat shader: one radiance from every side whatever light there is. In step 08 it becomes a lamp.
inline Diffuse flat(vec3 radiance) {
    return {vec3(0), radiance};
}

/// Lambert's law: irradiance E (W/m^2) leaves a matte surface as radiance albedo / pi E, the same in all
/// directions. The pi is the integral of the cosine over the half-sphere: with albedo 1, all that came leaves
/// again.
inline vec3 reflected(const Diffuse& diffuse, vec3 irradiance) {
    //> emission, and albedo / pi of what arrives
    return diffuse.emission + diffuse.albedo / pi * irradiance;
    //< return vec3(0);
}

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

} // namespace rt
