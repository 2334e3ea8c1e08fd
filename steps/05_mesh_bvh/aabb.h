// Axis-aligned bounding boxes: a cheap test that lets a ray skip expensive ones.
#pragma once

#include "01_spheres/sphere.h"

#include <optional>

namespace rt {

/// Empty until it is extended: min > max.
struct Aabb {
    vec3 min{infinity};
    vec3 max{-infinity};
};

inline void extend(Aabb& box, vec3 point) {
    box.min = min(box.min, point);
    box.max = max(box.max, point);
}

inline void extend(Aabb& box, const Aabb& other) {
    box.min = min(box.min, other.min);
    box.max = max(box.max, other.max);
}

inline Aabb bounds(const Sphere& sphere) {
    return {sphere.center - sphere.radius, sphere.center + sphere.radius};
}

inline vec3 centroid(const Aabb& box) {
    return (box.min + box.max) / 2.0f;
}

/// Returns half the surface area, to which the probability that a random line hits the box is proportional; 0
/// if empty.
inline float half_area(const Aabb& box) {
    const vec3 size = max(box.max - box.min, vec3(0));
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

/// A ray prepared for the slab test: one division per axis instead of one per box.
struct SlabRay {
    vec3 origin;
    vec3 inverse_direction; ///< 1 / direction; +-infinity along an axis where the ray stands still
};

inline SlabRay slab_ray(const Ray& ray) {
    return {ray.origin, 1.0f / ray.direction};
}

/// Returns the t at which a ray enters the box, or nothing if it misses it within [t_min, t_max] (Kay and
/// Kajiya 1986). A ray in the plane of a face hits: there 0 * infinity gives NaN, and a comparison with NaN,
/// in this order, changes nothing. The exit is padded by two roundings, so that no hit on an edge is lost
/// (Ize 2013).
inline std::optional<float> intersect(const Aabb& box, const SlabRay& ray, float t_min, float t_max) {
    //> during which t is the ray inside all three pairs of planes, if it ever is?
    for (int axis = 0; axis < 3; ++axis) {
        const bool forward = ray.inverse_direction[axis] >= 0;
        const float near_plane = forward ? box.min[axis] : box.max[axis];
        const float far_plane = forward ? box.max[axis] : box.min[axis];
        const float t_near = (near_plane - ray.origin[axis]) * ray.inverse_direction[axis];
        const float t_far = (far_plane - ray.origin[axis]) * ray.inverse_direction[axis] * (1 + 0x1p-22f);
        if (t_near > t_min) t_min = t_near;
        if (t_far < t_max) t_max = t_far;
    }
    if (t_min <= t_max) return t_min;
    return std::nullopt;
    //< return t_min;
}

} // namespace rt
