// Our side of the comparison: the one place that knows which of our structures is measured.
#pragma once

#include "05_mesh_bvh/mesh.h"
#include "05_mesh_bvh/triangle.h"
#include "accel/accel.h"
#include "common/util/parallel.h"

#include <cstdint>
#include <vector>

namespace rt::bench {

inline constexpr std::uint32_t nothing = 0xffffffff;

/// What a ray meets first; `primitive` is `nothing` if it meets none.
struct Found {
    float t = infinity, u = 0, v = 0;
    std::uint32_t primitive = nothing;
};

using Ours = accel::TriangleBvh;

inline Ours build_ours(const Mesh& mesh, int threads) {
    set_thread_count(threads);
    return accel::build_triangle_bvh(accel::TriangleMesh{mesh.positions, mesh.triangles});
}

inline Found nearest(const Ours& ours, const Ray& ray) {
    const auto hit = accel::closest_hit(ours, ray);
    return hit ? Found{hit->t, hit->u, hit->v, hit->primitive} : Found{};
}

inline bool any_hit(const Ours& ours, const Ray& ray) {
    return accel::any_hit(ours, ray);
}

/// The truth, by asking every triangle.
inline Found brute_nearest(const Mesh& mesh, Ray ray) {
    Found found;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto [a, b, c] = vertices(mesh, i);
        if (const auto hit = intersect(a, b, c, ray)) {
            ray.t_max = hit->t;
            found = {hit->t, hit->u, hit->v, i};
        }
    }
    return found;
}

/// All that a scene keeps of the mesh itself.
inline std::size_t mesh_bytes(const Mesh& mesh) {
    return mesh.positions.size() * (2 * sizeof(vec3) + sizeof(vec2)) +
           mesh.triangles.size() * (sizeof(mesh.triangles[0]) + sizeof(mesh.materials[0]));
}

} // namespace rt::bench
