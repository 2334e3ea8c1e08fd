// What the checks of step 02 share beside those of step 01: a hit, on a surface that is oblique.
// Included last, so that no name in a learner's header hides one of these.
#pragma once

#include "01_spheres/hit.h"

#include "tests/01_spheres/step.h"

namespace rt {

/// The hit on a surface at `point` with this normal, for a ray that comes from above it, a little aslant.
inline Hit hit_at(vec3 point, vec3 normal) {
    const vec3 direction = -2.0f * normal + 0.3f * beside(normal);
    return make_hit(Ray{point - direction, direction, 0, 1}, normal, {0, 0}, 0);
}

/// Oblique: no vector of it lies along an axis.
inline const vec3 tilted = vec3(2, 3, 6) / 7.0f;
inline const vec3 somewhere(1, -2, 3);

} // namespace rt
