// Perfect specular reflection, and coatings that reflect a fraction of the light.
#pragma once

#include "02_shadows/spawn_ray.h"

namespace rt {

struct Mirror {
    vec3 reflectance{1}; ///< the share of the light that comes back, in [0, 1]
};

/// A mirror over any other material: lacquer, glaze, a wet floor. Each layer costs one more ray.
struct Coated {
    float reflectivity; ///< in [0, 1]: 0 shows only the base, 1 only the mirror
    int base; ///< the material beneath; its number is lower than this one's, so layers come to an end
    vec3 reflectance{1};
};

/// Returns d reflected about the unit normal n: r = d - 2 (d.n) n. Keeps the length and the angle to n; n may
/// point to either side.
inline vec3 reflect(vec3 direction, vec3 normal) {
    //> what does a mirror do to the part of the direction along the normal?
    return direction - 2 * dot(direction, normal) * normal;
    //< return direction;
}

/// Returns the reflected ray of a mirror at the hit.
inline Ray reflected_ray(const Ray& ray, const Hit& hit) {
    //> where does the reflected ray start, and where does it go?
    return spawn_ray(hit, reflect(ray.direction, hit.shading_normal));
    //< return {hit.position, ray.direction};
}

} // namespace rt
