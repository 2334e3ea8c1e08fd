// What the checks of step 02 share in addition to those of step 01: a hit on an oblique surface.
// Include it last, so that no name in a learner's header hides one of these.
#pragma once

#include "01_spheres/hit.h"

#include "tests/01_spheres/step.h"

namespace rt {

/// Returns the hit of a slightly oblique ray from above, at `point` on a surface with this normal.
inline Hit hit_at(vec3 point, vec3 normal) {
    const vec3 direction = -2.0f * normal + 0.3f * beside(normal);
    return make_hit(Ray{point - direction, direction, 0, 1}, normal, {0, 0}, 0);
}

/// Deliberately oblique: no vector lies along an axis.
inline const vec3 tilted = vec3(2, 3, 6) / 7.0f;
inline const vec3 somewhere(1, -2, 3);

} // namespace rt
