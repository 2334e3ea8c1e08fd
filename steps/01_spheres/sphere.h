// A sphere: where a ray hits it, its normal there, and its longitude and latitude as uv.
#pragma once

#include "01_spheres/hit.h"

#include <cmath>
#include <utility>

namespace rt {

struct Sphere {
    vec3 center;
    float radius; ///< > 0
    int material;
};

/// Returns the smallest t in the ray's interval with |O + tD - C|^2 = r^2, which is a t^2 - 2 h t + c = 0
/// with
///     a = D.D,   h = D.(C - O),   c = |C - O|^2 - r^2.
/// The roots are q/a and c/q with q = h + sign(h) sqrt(h^2 - a c): neither subtracts two nearly equal numbers
/// (Press et al., Numerical Recipes, 5.6). In double, since c cancels for a ray close to a sphere of 10 km.
inline std::optional<float> intersect(const Sphere& sphere, const Ray& ray) {
    //> where does the ray meet the sphere, and which of these points is the first that it contains?
    const glm::dvec3 to_center = glm::dvec3(sphere.center) - glm::dvec3(ray.origin);
    const glm::dvec3 direction(ray.direction);
    const double radius = sphere.radius;
    const double a = dot(direction, direction);
    const double h = dot(direction, to_center);
    const double c = dot(to_center, to_center) - radius * radius;
    const double discriminant = h * h - a * c;
    if (discriminant < 0) return std::nullopt;

    const double q = h + std::copysign(std::sqrt(discriminant), h);
    float near = float(q / a), far = float(c / q);
    if (far < near) std::swap(near, far);
    if (contains(ray, near)) return near;
    if (contains(ray, far)) return far;
    return std::nullopt;
    //< return std::nullopt;
}

/// Returns longitude and latitude of a point on the unit sphere as (u, v) in [0, 1]^2: v is 0 at the south
/// pole (-y) and 1 at the north pole; u grows eastward, to the right as seen from outside with north up.
inline vec2 sphere_uv(vec3 p) {
    const float longitude = std::atan2(-p.z, p.x);
    const float latitude = std::asin(glm::clamp(p.y, -1.0f, 1.0f));
    return {0.5f + longitude / (2 * pi), 0.5f + latitude / pi};
}

/// Returns the surface data of the hit with `sphere` at ray.t_max.
inline Hit surface_hit(const Sphere& sphere, const Ray& ray) {
    //> which way is out, at the point where the ray ends?
    const vec3 outward_normal = normalize(at(ray, ray.t_max) - sphere.center);
    //< const vec3 outward_normal = vec3(0, 1, 0);
    return make_hit(ray, outward_normal, sphere_uv(outward_normal), sphere.material);
}

} // namespace rt
