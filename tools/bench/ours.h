// Our side of the comparison: the one place that knows which of our structures is measured.
#pragma once

#include "05_mesh_bvh/bvh.h"
#include "05_mesh_bvh/mesh.h"
#include "05_mesh_bvh/triangle.h"

#include <cstdint>
#include <vector>

namespace rt::bench {

inline constexpr std::uint32_t nothing = 0xffffffff;

/// What a ray meets first; `primitive` is `nothing` if it meets none.
struct Found {
    float t = infinity, u = 0, v = 0;
    std::uint32_t primitive = nothing;
};

struct Ours {
    const Mesh* mesh;
    Bvh tree;
};

inline Ours build_ours(const Mesh& mesh, [[maybe_unused]] int threads) {
    std::vector<Box> boxes(mesh.triangles.size());
    for (std::uint32_t i = 0; i < boxes.size(); ++i) boxes[i] = bounds(mesh, i);
    return {&mesh, build_bvh(boxes)};
}

inline Found nearest(const Ours& ours, Ray ray) {
    Found found;
    traverse(ours.tree, ray, [&](std::uint32_t i) {
        const auto [a, b, c] = corners(*ours.mesh, i);
        if (const auto hit = intersect(a, b, c, ray)) {
            ray.t_max = hit->t;
            found = {hit->t, hit->u, hit->v, i};
        }
        return false;
    });
    return found;
}

inline bool any_hit(const Ours& ours, const Ray& ray) {
    bool found = false;
    traverse(ours.tree, ray, [&](std::uint32_t i) {
        const auto [a, b, c] = corners(*ours.mesh, i);
        return found = intersect(a, b, c, ray).has_value();
    });
    return found;
}

/// The truth, by asking every triangle.
inline Found brute_nearest(const Mesh& mesh, Ray ray) {
    Found found;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto [a, b, c] = corners(mesh, i);
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
