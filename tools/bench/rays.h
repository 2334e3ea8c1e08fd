// The three kinds of rays of a path tracer: camera rays, diffuse bounces, and shadow rays to a light.
#pragma once

#include "02_shadows/spawn_ray.h"
#include "08_indirect/hemisphere.h"
#include "common/math/random.h"
#include "tools/bench/meshes.h"
#include "tools/bench/ours.h"

#include <string>
#include <vector>

namespace rt::bench {

/// The same rays for both sides, in the order in which they are traced.
struct RaySets {
    std::vector<Ray> primary; ///< coherent: neighbours follow each other
    std::vector<Ray> bounce;  ///< incoherent: cosine-distributed from the primary hits
    std::vector<Ray> shadow;  ///< segments from the primary hits to points of the light
};

/// The rays of `size` x `size` pixels, in tiles of 16 x 16 (`size` is a multiple of 16).
inline std::vector<Ray> primary_rays(const BenchScene& scene, int size) {
    const Camera camera = make_camera(scene.look_at, size, size);
    const int tile = 16, columns = size / tile;
    std::vector<Ray> rays;
    rays.reserve(std::size_t(size) * std::size_t(size));
    for (int i = 0; i < size * size; ++i) {
        const int number = i / (tile * tile), within = i % (tile * tile);
        const int x = number % columns * tile + within % tile;
        const int y = number / columns * tile + within / tile;
        rays.push_back(camera_ray(camera, vec2(x, y) + 0.5f));
    }
    return rays;
}

/// The rays from the primary hits; a shadow ray only where the surface faces the light, as in a renderer.
inline RaySets make_rays(const BenchScene& scene, const Ours& ours, int size) {
    RaySets sets{primary_rays(scene, size), {}, {}};
    sets.bounce.reserve(sets.primary.size());
    sets.shadow.reserve(sets.primary.size());
    Random random(2);
    for (const Ray& ray : sets.primary) {
        const ClosestHit hit = closest_hit(ours, ray);
        if (hit.primitive == no_primitive) continue;
        const vec3 outward = vec3(normalize(area_normal(vertices(scene.mesh, hit.primitive))));
        const vec3 normal = dot(ray.direction, outward) > 0 ? -outward : outward;
        const vec3 position = at(ray, hit.t);
        const vec3 start = position + position_error(ray.origin, position) * normal;
        sets.bounce.push_back({start, sample_cosine_hemisphere(normal, random.uniform2())});
        const vec2 u = random.uniform2();
        const vec3 to_light = scene.light_corner + u.x * scene.light_u + u.y * scene.light_v - start;
        if (dot(to_light, normal) > 0) sets.shadow.push_back({start, to_light, 0, 1});
    }
    return sets;
}

} // namespace rt::bench
