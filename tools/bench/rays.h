// The three kinds of rays that a path tracer sends: from the camera, onward from what it sees, and to a lamp.
#pragma once

#include "02_shadows/spawn_ray.h"
#include "08_indirect/hemisphere.h"
#include "common/math/random.h"
#include "tools/bench/meshes.h"
#include "tools/bench/ours.h"

#include <string>
#include <vector>

namespace rt::bench {

/// The same rays for both sides of a comparison, in the order in which they are traced.
struct RaySets {
    std::vector<Ray> primary; ///< coherent: neighbours stand side by side
    std::vector<Ray> bounce;  ///< incoherent: cosine-distributed from the primary hits
    std::vector<Ray> shadow;  ///< segments from the primary hits that face the light to points of it
};

/// A picture of `size` x `size` pixels, in tiles of 16 x 16 (`size` is a multiple of it) and rows within a
/// tile.
inline std::vector<Ray> primary_rays(const Subject& subject, int size) {
    const Camera camera = make_camera(subject.look_at, size, size);
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

/// The rays that leave the primary hits. Those that would start into the surface's shadow side are left out,
/// as a renderer does.
inline RaySets make_rays(const Subject& subject, const Ours& ours, int size) {
    RaySets sets{primary_rays(subject, size), {}, {}};
    sets.bounce.reserve(sets.primary.size());
    sets.shadow.reserve(sets.primary.size());
    Random random(2);
    for (const Ray& ray : sets.primary) {
        const Found found = nearest(ours, ray);
        if (found.primitive == nothing) continue;
        const vec3 outward = vec3(normalize(area_normal(vertices(subject.mesh, found.primitive))));
        const vec3 normal = dot(ray.direction, outward) > 0 ? -outward : outward;
        const vec3 position = at(ray, found.t);
        const vec3 start = position + position_error(ray.origin, position) * normal;
        sets.bounce.push_back({start, sample_cosine_hemisphere(normal, random.uniform2())});
        const vec2 u = random.uniform2();
        const vec3 way = subject.light_corner + u.x * subject.light_u + u.y * subject.light_v - start;
        if (dot(way, normal) > 0) sets.shadow.push_back({start, way, 0, 1});
    }
    return sets;
}

} // namespace rt::bench
