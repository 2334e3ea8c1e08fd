// A ray: a half-line with the stretch of it that still matters.
#pragma once

#include "common/math/vec.h"

namespace rt {

/// The points origin + t direction for t in (t_min, t_max). `direction` need not have unit length: t counts
/// in lengths of it. A hit shortens the ray, so whatever is found later is nearer.
struct Ray {
    vec3 origin;
    vec3 direction;
    float t_min = 0;
    float t_max = infinity;
};

/// The point at t: computed in double and rounded once.
inline vec3 at(const Ray& ray, float t) {
    return vec3(dvec3(ray.origin) + double(t) * dvec3(ray.direction));
}

/// True if `t` lies in the ray's interval. A t that is not a number lies in none.
inline bool contains(const Ray& ray, float t) {
    return ray.t_min < t && t < ray.t_max;
}

} // namespace rt
