// An infinite plane: the floor under the spheres.
#pragma once

#include "01_spheres/hit.h"

namespace rt {

struct Plane {
    vec3 point;  ///< any point of it
    vec3 normal; ///< unit
    int material;
};

/// Returns the t with (O + tD - P).N = 0. A ray parallel to the plane has none: the division gives infinity
/// or NaN, which no interval contains. In double, like the sphere: P may be far away.
inline std::optional<float> intersect(const Plane& plane, const Ray& ray) {
    //> at which t does the ray meet the plane, and does the ray contain it?
    const dvec3 normal(plane.normal), to_plane = dvec3(plane.point) - dvec3(ray.origin);
    const float t = float(dot(to_plane, normal) / dot(dvec3(ray.direction), normal));
    if (contains(ray, t)) return t;
    return std::nullopt;
    //< return std::nullopt;
}

/// uv is in metres from plane.point; on a floor (normal +y) u runs along +x and v along -z.
inline Hit surface_hit(const Plane& plane, const Ray& ray) {
    const vec3 reference_axis = std::abs(plane.normal.z) > 0.9f ? vec3(0, 1, 0) : vec3(0, 0, -1);
    const vec3 u = normalize(cross(reference_axis, plane.normal));
    const vec3 v = cross(plane.normal, u);
    const vec3 offset = at(ray, ray.t_max) - plane.point;
    return make_hit(ray, plane.normal, {dot(offset, u), dot(offset, v)}, plane.material);
}

} // namespace rt
