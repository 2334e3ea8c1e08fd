// Offsets the origin of a secondary ray so that it does not hit the surface it starts on (shadow acne).
#pragma once

#include "01_spheres/hit.h"

namespace rt {

/// Returns the hit's position, moved off the surface by its error bound, to the side that `direction` points
/// to; along the geometric normal, since an interpolated one may lean into the surface.
inline vec3 offset_ray_origin(const Hit& hit, vec3 direction) {
    //> in which direction, and how far, is a start that is safely on the right side of the surface?
    const float sign = dot(direction, hit.geometric_normal) < 0 ? -1.0f : 1.0f;
    return hit.position + sign * hit.position_error * hit.geometric_normal;
    //< return hit.position;
}

/// Returns a ray from the hit in this direction, unbounded.
inline Ray spawn_ray(const Hit& hit, vec3 direction) {
    return {offset_ray_origin(hit, direction), direction};
}

/// Returns the segment from the hit to `target`: t runs from 0 to 1, so nothing beyond the target counts. It
/// starts on the side that the ray came from, which is the lit one: the surface hides a target behind it.
inline Ray spawn_ray_to(const Hit& hit, vec3 target) {
    //> which ray is just the way from beside the surface to the target, and no longer?
    const vec3 start = offset_ray_origin(hit, hit.geometric_normal);
    return {start, target - start, 0, 1};
    //< return {hit.position, target - hit.position};
}

} // namespace rt
