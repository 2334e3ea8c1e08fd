// Fuzzy metal: a mirror reflection perturbed by a random offset that grows with roughness.
#pragma once

#include "03_mirror/mirror.h"
#include "08_indirect/hemisphere.h"

#include <optional>

namespace rt {

struct Metal {
    vec3 reflectance; ///< the share of the light that comes back, in [0, 1]
    float fuzz = 0;   ///< in [0, 1]: 0 is a tinted mirror, 1 strays by up to a quarter turn
};

/// Returns the reflected ray, its unit direction offset by a random point of the sphere of radius `fuzz`
/// (Shirley, Black, Hollasch, Ray Tracing in One Weekend, version 4, section 10.6), or nothing if it then
/// points into the surface: such light is lost. A model of the appearance, not of measurements. u in [0,
/// 1)^2.
inline std::optional<Ray> scatter_metal(const Metal& metal, const Ray& ray, const Hit& hit, vec2 u) {
    //> where does rough metal send the ray, and when does it swallow it?
    const vec3 reflected = normalize(reflect(ray.direction, hit.shading_normal));
    const vec3 direction = reflected + metal.fuzz * sample_uniform_sphere(u);
    if (dot(direction, hit.geometric_normal) <= 0) return std::nullopt;
    return spawn_ray(hit, direction);
    //< return reflected_ray(ray, hit);
}

} // namespace rt
