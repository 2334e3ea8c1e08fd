// Axis-aligned boxes: the cheap question asked before the dear one.
#pragma once

#include "01_spheres/sphere.h"

#include <optional>

namespace rt {

/// Empty until it has grown: low above high.
struct Box {
    vec3 low{infinity};
    vec3 high{-infinity};
};

inline void grow(Box& box, vec3 point) {
    box.low = min(box.low, point);
    box.high = max(box.high, point);
}

inline void grow(Box& box, const Box& other) {
    box.low = min(box.low, other.low);
    box.high = max(box.high, other.high);
}

inline Box bounds(const Sphere& sphere) {
    return {sphere.center - sphere.radius, sphere.center + sphere.radius};
}

inline vec3 middle(const Box& box) {
    return (box.low + box.high) / 2.0f;
}

/// Half the surface, which is in proportion to the chance that a random line through the parent meets it. 0
/// if empty.
inline float half_area(const Box& box) {
    const vec3 size = max(box.high - box.low, vec3(0));
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

/// A ray as the slab test wants it: one division an axis instead of one a box.
struct SlabRay {
    vec3 origin;
    vec3 inverse; ///< 1 / direction; plus or minus infinity along an axis where the ray stands still
};

inline SlabRay slab_ray(const Ray& ray) {
    return {ray.origin, 1.0f / ray.direction};
}

/// The t at which a ray enters the box, or nothing if it misses it within [t_min, t_max] (Kay and Kajiya
/// 1986). A ray in the plane of a face hits: there 0 * infinity gives NaN, and a comparison with NaN, in this
/// order, changes nothing. The exit is moved out by two roundings, so that no hit on the very edge is lost
/// (Ize 2013).
inline std::optional<float> entry(const Box& box, const SlabRay& ray, float t_min, float t_max) {
    //> for each axis: when does the ray come in, when does it go out? Keep the last entry and the first exit
    for (int axis = 0; axis < 3; ++axis) {
        const bool forward = ray.inverse[axis] >= 0;
        const float first = forward ? box.low[axis] : box.high[axis];
        const float last = forward ? box.high[axis] : box.low[axis];
        const float in = (first - ray.origin[axis]) * ray.inverse[axis];
        const float out = (last - ray.origin[axis]) * ray.inverse[axis] * (1 + 0x1p-22f);
        if (in > t_min) t_min = in;
        if (out < t_max) t_max = out;
    }
    if (t_min <= t_max) return t_min;
    return std::nullopt;
    //< return t_min;
}

} // namespace rt
