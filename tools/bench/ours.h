// Our side of the comparison: the one place that knows which of our structures is measured.
#pragma once

#include "05_mesh_bvh/mesh.h"
#include "05_mesh_bvh/triangle.h"
#include "accel/accel.h"
#include "common/util/parallel.h"

#include <cstdint>
#include <vector>

namespace rt::bench {

inline constexpr std::uint32_t no_primitive = 0xffffffff;

/// The closest hit of a ray; `primitive` is `no_primitive` if there is none.
struct ClosestHit {
    float t = infinity, u = 0, v = 0;
    std::uint32_t primitive = no_primitive;
};

using Ours = accel::TriangleBvh;

inline Ours build_ours(const Mesh& mesh, int threads) {
    set_thread_count(threads);
    return accel::build_triangle_bvh(accel::TriangleMesh{mesh.positions, mesh.triangles});
}

inline ClosestHit closest_hit(const Ours& ours, const Ray& ray) {
    const auto hit = accel::closest_hit(ours, ray);
    return hit ? ClosestHit{hit->t, hit->u, hit->v, hit->primitive} : ClosestHit{};
}

inline bool any_hit(const Ours& ours, const Ray& ray) {
    return accel::any_hit(ours, ray);
}

/// The true closest hit, by a test of every triangle.
inline ClosestHit brute_force_closest_hit(const Mesh& mesh, Ray ray) {
    ClosestHit closest;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto [a, b, c] = vertices(mesh, i);
        if (const auto hit = intersect(a, b, c, ray)) {
            ray.t_max = hit->t;
            closest = {hit->t, hit->u, hit->v, i};
        }
    }
    return closest;
}

/// What a scene keeps of the mesh itself.
inline std::size_t mesh_bytes(const Mesh& mesh) {
    return mesh.positions.size() * (2 * sizeof(vec3) + sizeof(vec2)) +
           mesh.triangles.size() * (sizeof(mesh.triangles[0]) + sizeof(mesh.materials[0]));
}

} // namespace rt::bench
