// The public header of the fast tree: builds a tree over triangles or spheres, finds what rays hit.
#pragma once

#include "accel/exact.h"
#include "accel/traverse.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace rt::accel {

using TriangleBvh = WideBvh<TriangleN>;
using SphereBvh = WideBvh<SphereN>;

/// Triangles as plain arrays, with three indices into `vertices` each.
struct TriangleMesh {
    std::span<const vec3> vertices;
    std::span<const std::array<std::uint32_t, 3>> triangles;
};

/// Builds the tree over the triangles of all meshes, at most 2^29, numbered from 0
/// through all of them. The tree holds copies. It is the same on any number of threads
/// (see set_thread_count() of common/util/parallel.h).
TriangleBvh build_triangle_bvh(std::span<const TriangleMesh> meshes);
TriangleBvh build_triangle_bvh(const TriangleMesh& mesh);

/// The same over spheres, which are numbered in their order.
SphereBvh build_sphere_bvh(std::span<const Sphere> spheres);

/// The hit of a ray with a primitive: at origin + t direction. u and v are the weights of a triangle's second
/// and third vertex; 0 for spheres.
struct Hit {
    float t, u, v;
    std::uint32_t primitive;
};

/// Returns the hit with the least t in the ray's interval. `ray` is a Ray or of a type with the same members.
template <typename Counters = NoCounters, typename Block>
std::optional<Hit> closest_hit(const WideBvh<Block>& bvh, RayLike auto ray) {
    constexpr std::uint32_t invalid_index = 0xffffffff;
    Hit closest{0, 0, 0, invalid_index};
    closest_hit<Counters>(bvh, ray, [&](const Block& block, std::size_t lane) {
        if (const auto hit = exact_hit(primitive_at(block, lane), ray)) {
            ray.t_max = hit->t;
            closest = {hit->t, hit->u, hit->v, block.primitive[lane]};
        }
    });
    return closest.primitive == invalid_index ? std::nullopt : std::optional(closest);
}

/// Returns whether the ray hits anything in its interval. Faster than closest_hit(): for shadow rays.
template <typename Counters = NoCounters, typename Block>
bool any_hit(const WideBvh<Block>& bvh, const RayLike auto& ray) {
    return any_hit<Counters>(bvh, ray, [&](const Block& block, std::size_t lane) {
        return exact_hit(primitive_at(block, lane), ray).has_value();
    });
}

} // namespace rt::accel
