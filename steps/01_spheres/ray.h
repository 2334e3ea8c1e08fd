// A ray: a half-line with the stretch of it that still matters.
#pragma once

#include "common/vec.h"

namespace rt {

/// The points origin + t direction for t in (t_min, t_max). `direction` need not have unit length: t counts
/// in lengths of it. A hit shortens the ray, so whatever is found later is nearer.
struct Ray {
    vec3 origin;
    vec3 direction;
    float t_min = 0;
    float t_max = infinity;
};

inline vec3 at(const Ray& ray, float t) {
    return ray.origin + t * ray.direction;
}

/// True if `t` lies in the ray's interval. A t that is not a number lies in none.
inline bool contains(const Ray& ray, float t) {
    return ray.t_min < t && t < ray.t_max;
}

} // namespace rt
