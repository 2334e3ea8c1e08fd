// Metals that are polished more or less: a mirror whose rays stray, the farther the rougher it is.
#pragma once

#include "03_mirror/mirror.h"
#include "08_indirect/hemisphere.h"

#include <optional>

namespace rt {

struct Metal {
    vec3 reflectance; ///< the share of the light that comes back, in [0, 1]
    float fuzz = 0;   ///< in [0, 1]: 0 is a tinted mirror, 1 strays by up to a quarter turn
};

/// The ray that a metal sends on: mirrored, then moved to a random point on the sphere of radius `fuzz` around
/// where it pointed (Shirley, Black, Hollasch, Ray Tracing in One Weekend, version 4, section 10.6). Nothing
/// if it then points into the surface: such light is lost. A model by its looks, not by measurement. u in
/// [0, 1)^2.
inline std::optional<Ray> scatter_metal(const Metal& metal, const Ray& ray, const Hit& hit, vec2 u) {
    //> the mirrored direction at unit length, plus fuzz times a random unit vector, if it leaves the surface
    const vec3 reflected = normalize(reflect(ray.direction, hit.shading_normal));
    const vec3 direction = reflected + metal.fuzz * sample_uniform_sphere(u);
    if (dot(direction, hit.geometric_normal) <= 0) return std::nullopt;
    return spawn_ray(hit, direction);
    //< return reflected_ray(ray, hit);
}

} // namespace rt
