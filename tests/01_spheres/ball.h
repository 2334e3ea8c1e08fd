// A ball, and rays that hit it from outside and from inside.
// Include it last, so that no name in a learner's header hides one of these.
#pragma once

#include "01_spheres/sphere.h"

namespace rt {

/// Deliberately oblique: neither the normal nor the direction lies along an axis, the radius is not 1 and the
/// direction is not of unit length.
inline const Sphere ball{{1, -2, 3}, 2, 7};
inline const vec3 outward = vec3(2, -1, 2) / 3.0f;
inline const vec3 on_ball = ball.center + 2.0f * outward;
inline const vec3 slanting = -2.5f * normalize(outward + 0.4f * normalize(cross(outward, vec3(0, 1, 0))));
inline const Ray to_ball{on_ball - 2.0f * slanting, slanting};       // hits on_ball at t = 2
inline const Ray from_within{ball.center + outward, 0.5f * outward}; // starts inside, hits on_ball at t = 2

} // namespace rt
