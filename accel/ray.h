// Rays, spheres, bounds and hits, as the fast tree takes and returns them.
#pragma once

#include "common/math/vec.h"

#include <array>
#include <concepts>

namespace rt::accel {

/// The points origin + t direction for t in (t_min, t_max). t is measured in multiples of |direction|.
struct Ray {
    vec3 origin;
    vec3 direction;
    float t_min = 0;
    float t_max = infinity;
};

/// A ray of the caller's own: a type with these four members is used as it is, without a conversion.
template <typename T>
concept RayLike = requires(const T& ray) {
    { ray.origin } -> std::convertible_to<vec3>;
    { ray.direction } -> std::convertible_to<vec3>;
    { ray.t_min } -> std::convertible_to<float>;
    { ray.t_max } -> std::convertible_to<float>;
};

/// Returns whether t lies in the ray's interval. NaN does not.
inline bool in_interval(const RayLike auto& ray, float t) {
    return ray.t_min < t && t < ray.t_max;
}

/// Where a ray hits a primitive: at origin + t direction, which in a triangle is (1 - u - v) A + u B + v C.
struct ExactHit {
    float t, u = 0, v = 0;
};

struct Sphere {
    vec3 center;
    float radius;
};

/// An axis-aligned box; empty until it is extended: min above max.
struct Bounds {
    vec3 min{infinity};
    vec3 max{-infinity};
};

inline void extend(Bounds& bounds, vec3 point) {
    bounds.min = glm::min(bounds.min, point);
    bounds.max = glm::max(bounds.max, point);
}

inline Bounds bounds_of(const Sphere& sphere) {
    return {sphere.center - sphere.radius, sphere.center + sphere.radius};
}

inline Bounds bounds_of(const std::array<vec3, 3>& triangle) {
    Bounds bounds;
    for (const vec3 vertex : triangle) extend(bounds, vertex);
    return bounds;
}

/// Half the surface area; 0 if empty.
inline float half_area(const Bounds& bounds) {
    const vec3 size = glm::max(bounds.max - bounds.min, vec3(0));
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

} // namespace rt::accel
