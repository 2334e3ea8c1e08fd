// Mirrors: light that leaves as it came, and surfaces that are a mirror in part.
#pragma once

#include "02_shadows/spawn_ray.h"

namespace rt {

struct Mirror {
    vec3 reflectance{1}; ///< the share of the light that comes back, in [0, 1]
};

/// A mirror laid over any other material: lacquer, glaze, a wet floor. One layer over another costs a ray
/// each.
struct Coated {
    float reflectivity; ///< in [0, 1]: 0 shows only the base, 1 only the mirror
    int base; ///< the material beneath; its number is lower than this one's, so layers come to an end
    vec3 reflectance{1};
};

/// d turned around the unit normal n: r = d - 2 (d.n) n. The length stays, the angle to n stays, and it does
/// not matter to which side n points.
inline vec3 reflect(vec3 direction, vec3 normal) {
    //> take away twice the part along the normal
    return direction - 2 * dot(direction, normal) * normal;
    //< return direction;
}

/// The ray that a mirror at the hit sends on.
inline Ray reflected_ray(const Ray& ray, const Hit& hit) {
    //> turn ray.direction around hit.shading_normal
    return spawn_ray(hit, reflect(ray.direction, hit.shading_normal));
    //< return {hit.position, ray.direction};
}

} // namespace rt
