// The sky: what a ray that hits nothing sees, and the light that it sends to a surface.
#pragma once

#include "common/math/vec.h"

namespace rt {

/// Radiance changes linearly with height, from `nadir` straight down to `zenith` straight up.
struct Sky {
    vec3 nadir{0};
    vec3 zenith{0};
};

/// Returns L(w) = mix(nadir, zenith, (1 + cos) / 2), with the cosine between w and straight up. `direction`
/// may have any length.
inline vec3 radiance(const Sky& sky, vec3 direction) {
    return mix(sky.nadir, sky.zenith, 0.5f + 0.5f * normalize(direction).y);
}

/// Returns the irradiance from the whole, unoccluded sky at a surface with this unit normal, W/m^2: E =
/// integral of L(w) cos dw over the hemisphere. The constant part of L gives pi, the part proportional to the
/// cosine 2 pi / 3, so E = pi mix(nadir, zenith, 1/2 + n.y / 3).
inline vec3 irradiance(const Sky& sky, vec3 normal) {
    return pi * mix(sky.nadir, sky.zenith, 0.5f + normal.y / 3);
}

} // namespace rt
