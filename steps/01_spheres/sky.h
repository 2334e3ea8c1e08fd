// The sky: what a ray that hits nothing sees, and the light that it sends to a surface.
#pragma once

#include "common/math/vec.h"

namespace rt {

/// Radiance changes linearly along `up`, from `nadir` to `zenith`. A tilted `up` makes one side brighter.
struct Sky {
    vec3 nadir{0};
    vec3 zenith{0};
    vec3 up{0, 1, 0}; ///< unit
};

/// Returns L(w) = mix(nadir, zenith, (1 + cos) / 2), with the cosine between w and up. `direction` may have
/// any length.
inline vec3 radiance(const Sky& sky, vec3 direction) {
    return mix(sky.nadir, sky.zenith, 0.5f + 0.5f * dot(normalize(direction), sky.up));
}

/// Returns the irradiance from the whole, unoccluded sky at a surface with this unit normal, W/m^2: E =
/// integral of L(w) cos dw over the hemisphere. The constant part of L gives pi, the part proportional to the
/// cosine 2 pi / 3, so E = pi mix(nadir, zenith, 1/2 + dot(n, up) / 3).
inline vec3 irradiance(const Sky& sky, vec3 normal) {
    return pi * mix(sky.nadir, sky.zenith, 0.5f + dot(normal, sky.up) / 3);
}

} // namespace rt
