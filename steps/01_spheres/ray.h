// A ray: origin, direction, and the interval of t in which hits count.
#pragma once

#include "common/math/vec.h"

namespace rt {

/// The points origin + t direction for t in (t_min, t_max). `direction` need not have unit length: t is
/// measured in multiples of |direction|. A hit shrinks t_max, so whatever is found later is closer.
struct Ray {
    vec3 origin;
    vec3 direction;
    float t_min = 0;
    float t_max = infinity;
};

/// Returns the point at t, computed in double and rounded once.
inline vec3 at(const Ray& ray, float t) {
    return vec3(dvec3(ray.origin) + double(t) * dvec3(ray.direction));
}

/// Returns whether t is in the ray's interval; false for NaN.
inline bool contains(const Ray& ray, float t) {
    return ray.t_min < t && t < ray.t_max;
}

} // namespace rt
