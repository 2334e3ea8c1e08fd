// The background: a sky that a ray sees when it meets nothing, and the light that it sheds.
#pragma once

#include "common/math/vec.h"

namespace rt {

/// Radiance changes evenly with height, from `nadir` straight below to `zenith` straight above.
struct Sky {
    vec3 nadir{0};
    vec3 zenith{0};
};

/// L(w) = mix(nadir, zenith, (1 + cos) / 2), where cos is between w and straight up. Any length of
/// `direction`.
inline vec3 radiance(const Sky& sky, vec3 direction) {
    return mix(sky.nadir, sky.zenith, 0.5f + 0.5f * normalize(direction).y);
}

/// What a surface with this unit normal receives of the whole sky, W/m^2, if nothing stands in the way: E =
/// integral of L(w) cos dw over the half-sphere. The even part of L gives pi, the part that grows with the
/// cosine 2 pi / 3, so E = pi mix(nadir, zenith, 1/2 + n.y / 3).
inline vec3 irradiance(const Sky& sky, vec3 normal) {
    return pi * mix(sky.nadir, sky.zenith, 0.5f + normal.y / 3);
}

} // namespace rt
