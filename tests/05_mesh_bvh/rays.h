// Random points and directions, and the box test: what the fastest checks of step 05 need.
#pragma once

#include "05_mesh_bvh/aabb.h"
#include "common/math/random.h"

#include <optional>

namespace rt {

inline vec3 random_point(Random& random) {
    const float x = random.get_1d();
    const float y = random.get_1d();
    const float z = random.get_1d();
    return {x, y, z};
}

inline vec3 random_direction(Random& random) {
    while (true) {
        const vec3 p = 2.0f * random_point(random) - 1.0f;
        if (dot(p, p) < 1 && dot(p, p) > 0.01f) return 1.7f * p; // of any length
    }
}

inline std::optional<float> intersect(const Aabb& box, const Ray& ray) {
    return intersect(box, slab_ray(ray), ray.t_min, ray.t_max);
}

} // namespace rt
