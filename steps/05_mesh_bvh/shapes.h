// What a ray can hit, one vector per kind of shape, with trees over spheres and triangles; closest hit, any
// hit.
#pragma once

#include "01_spheres/plane.h"
#include "01_spheres/sphere.h"
#include "03_mirror/quad.h"
#include "05_mesh_bvh/bvh.h"
#include "05_mesh_bvh/mesh.h"
#include "accel/accel.h"
#include "common/util/match.h"
#include "common/util/ray_stats.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace rt {

/// How a ray finds what it hits: by testing every shape, by a binary tree, or by a wide tree with many boxes
/// per node and many shapes per leaf.
enum class Accel { brute, bvh, wide };

struct Shapes {
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    std::vector<Quad> quads;
    Mesh mesh;
    Accel accel = Accel::wide;
    bool count_tests = false; ///< of the wide trees too: it costs 2 to 3 % of the time
    Bvh sphere_bvh;           ///< made by build_bvhs(), if `accel` asks for it, as are
    Bvh triangle_bvh;
    accel::SphereBvh wide_spheres;
    accel::TriangleBvh wide_triangles; ///< those of the mesh, and then the two halves of each quad
};

/// Calls test(i) for all shapes that the ray may hit, until one returns true.
template <typename Test>
void for_each_candidate(Accel accel, const Bvh& tree, std::size_t count, const Ray& ray, Test&& test) {
    if (accel == Accel::bvh) return traverse(tree, ray, test);
    for (std::uint32_t i = 0; i < count; ++i)
        if (test(i)) return;
}

/// The closest shape so far; ray.t_max is where.
using ClosestShape = std::variant<std::monostate, const Sphere*, const Plane*, const Quad*, MeshHit>;

/// Tests spheres, quads and triangles, one by one or by their binary trees. A hit shrinks ray.t_max.
inline void closest_hit_binary(const Shapes& shapes, Ray& ray, ClosestShape& closest) {
    const auto test = [&](const auto& shape) {
        if (const auto t = intersect(shape, ray)) {
            ray.t_max = *t;
            closest = &shape;
        }
        return false;
    };
    for (const Quad& quad : shapes.quads) test(quad);
    for_each_candidate(shapes.accel, shapes.sphere_bvh, shapes.spheres.size(), ray,
                       [&](std::uint32_t i) { return test(shapes.spheres[i]); });
    const auto test_triangle = [&](std::uint32_t i) {
        ++ray_stats.triangle_tests;
        //> does the ray hit triangle i before everything else so far, and what is to remember of that?
        const auto [a, b, c] = vertices(shapes.mesh, i);
        if (const auto hit = intersect(a, b, c, ray)) {
            ray.t_max = hit->t;
            closest = MeshHit{&shapes.mesh, i, hit->u, hit->v};
        }
        //<
        return false;
    };
    for_each_candidate(shapes.accel, shapes.triangle_bvh, shapes.mesh.triangles.size(), ray, test_triangle);
}

/// Returns the quad of which a triangle of the wide tree is one half; null for a triangle of the mesh.
inline const Quad* quad_of(const Shapes& shapes, std::uint32_t i) {
    const std::size_t triangles = shapes.mesh.triangles.size();
    return i < triangles ? nullptr : &shapes.quads[(i - triangles) / 2];
}

/// Counts the tests of the wide trees in `ray_stats`.
struct RayStatsCounters {
    static void count_boxes(std::size_t count) { ray_stats.box_tests += count; }
    static void count_primitives(std::size_t count) { ray_stats.triangle_tests += count; }
};

/// The same by the wide trees. They find which shapes the ray may hit; where it hits them is computed in
/// double, as above, so every accelerator gives the same image.
template <typename Counters>
inline void closest_hit_wide(const Shapes& shapes, Ray& ray, ClosestShape& closest) {
    const auto shorten = [&](float t, auto shape) {
        ray.t_max = t;
        closest = shape;
    };
    accel::closest_hit<Counters>(shapes.wide_spheres, ray, [&](const auto& block, std::size_t lane) {
        const Sphere& sphere = shapes.spheres[block.primitive[lane]];
        if (const auto t = intersect(sphere, ray)) shorten(*t, &sphere);
    });
    accel::closest_hit<Counters>(shapes.wide_triangles, ray, [&](const auto& block, std::size_t lane) {
        const std::uint32_t i = block.primitive[lane];
        if (const Quad* quad = quad_of(shapes, i)) {
            if (const float t = float(plane_t(*quad, ray)); contains(ray, t)) shorten(t, quad);
        } else if (const auto hit = accel::exact_hit(primitive_at(block, lane), ray)) {
            shorten(hit->t, MeshHit{&shapes.mesh, i, hit->u, hit->v});
        }
    });
}

/// Returns the closest hit. Each hit shrinks t_max, so the last accepted hit is the closest. Full surface
/// data are computed for that one only.
inline std::optional<Hit> intersect(const Shapes& shapes, Ray ray) {
    ClosestShape closest;
    for (const Plane& plane : shapes.planes) {
        if (const auto t = intersect(plane, ray)) {
            ray.t_max = *t;
            closest = &plane;
        }
    }
    if (shapes.accel != Accel::wide)
        closest_hit_binary(shapes, ray, closest);
    else if (shapes.count_tests)
        closest_hit_wide<RayStatsCounters>(shapes, ray, closest);
    else
        closest_hit_wide<accel::NoCounters>(shapes, ray, closest);
    return match(
        closest, [](std::monostate) { return std::optional<Hit>(); },
        [&](const auto* shape) { return std::optional(surface_hit(*shape, ray)); },
        [&](const MeshHit& mesh_hit) { return std::optional(surface_hit(mesh_hit, ray)); });
}

/// The part of occluded() that uses the wide trees.
template <typename Counters>
inline bool occluded_wide(const Shapes& shapes, const Ray& ray) {
    const auto meets_triangle = [&](const auto& block, std::size_t lane) {
        const Quad* quad = quad_of(shapes, block.primitive[lane]);
        return quad ? contains(ray, float(plane_t(*quad, ray)))
                    : accel::exact_hit(primitive_at(block, lane), ray).has_value();
    };
    const auto meets_sphere = [&](const auto& block, std::size_t lane) {
        return intersect(shapes.spheres[block.primitive[lane]], ray).has_value();
    };
    return accel::any_hit<Counters>(shapes.wide_triangles, ray, meets_triangle) ||
           accel::any_hit<Counters>(shapes.wide_spheres, ray, meets_sphere);
}

/// Returns whether any shape is hit in the ray's interval; the first one found ends the search.
inline bool occluded(const Shapes& shapes, const Ray& ray) {
    bool hit = false;
    const auto test = [&](const auto& shape) { return hit = intersect(shape, ray).has_value(); };
    if (std::ranges::any_of(shapes.planes, test)) return true;
    if (shapes.accel == Accel::wide)
        return shapes.count_tests ? occluded_wide<RayStatsCounters>(shapes, ray)
                                  : occluded_wide<accel::NoCounters>(shapes, ray);
    if (std::ranges::any_of(shapes.quads, test)) return true;
    for_each_candidate(shapes.accel, shapes.sphere_bvh, shapes.spheres.size(), ray,
                       [&](std::uint32_t i) { return test(shapes.spheres[i]); });
    if (hit) return true;
    const auto test_triangle = [&](std::uint32_t i) {
        ++ray_stats.triangle_tests;
        const auto [a, b, c] = vertices(shapes.mesh, i);
        return hit = intersect(a, b, c, ray).has_value();
    };
    for_each_candidate(shapes.accel, shapes.triangle_bvh, shapes.mesh.triangles.size(), ray, test_triangle);
    return hit;
}

} // namespace rt
