// What a ray can meet, and how it finds the nearest: one vector per kind of shape, and trees over those that
// are many.
#pragma once

#include "01_spheres/plane.h"
#include "01_spheres/sphere.h"
#include "03_mirror/quad.h"
#include "05_mesh_bvh/bvh.h"
#include "05_mesh_bvh/mesh.h"
#include "accel/accel.h"
#include "common/util/match.h"
#include "common/cli/options.h"
#include "common/util/tally.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace rt {

/// How a ray looks for what it meets: by asking every shape, by descending a binary tree, or one with rows of
/// boxes in its nodes and rows of shapes in its leaves.
enum class Accel { brute, bvh, wide };

inline Choice<Accel> accel_knob(Options& options, Accel initial) {
    return options.choice(
        "accel", {"brute", "bvh", "wide"}, initial,
        "how a ray finds what it meets: ask every shape, descend a tree, or a tree that tests "
        "many at once");
}

struct Shapes {
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    std::vector<Quad> quads;
    Mesh mesh;
    Accel accel = Accel::wide;
    bool count_tests = false; ///< of the wide trees too: it costs 2 to 3 % of the time
    Bvh sphere_tree;          ///< made by prepare(), if `accel` asks for it, as are
    Bvh triangle_tree;
    accel::SphereBvh wide_spheres;
    accel::TriangleBvh wide_triangles; ///< those of the mesh, and then the two halves of each quad
};

/// Builds the trees that `accel` asks for. Call it once, when all shapes are in place. It stands in shapes.cpp, which
/// is compiled once for all programs.
void prepare(Shapes& shapes);

/// Calls test(i) for all shapes that the ray may meet, until one returns true.
template <typename Test>
void search(Accel accel, const Bvh& tree, std::size_t count, const Ray& ray, Test&& test) {
    if (accel == Accel::bvh) return traverse(tree, ray, test);
    for (std::uint32_t i = 0; i < count; ++i)
        if (test(i)) return;
}

/// What a search keeps of the nearest shape; the end of the ray says where.
using Met = std::variant<std::monostate, const Sphere*, const Plane*, const Quad*, MeshHit>;

/// Asks spheres, quads and triangles, one by one or by their binary trees. A hit shortens the ray.
inline void search_shapes(const Shapes& shapes, Ray& ray, Met& met) {
    const auto test = [&](const auto& shape) {
        if (const auto t = intersect(shape, ray)) {
            ray.t_max = *t;
            met = &shape;
        }
        return false;
    };
    for (const Quad& quad : shapes.quads) test(quad);
    search(shapes.accel, shapes.sphere_tree, shapes.spheres.size(), ray,
           [&](std::uint32_t i) { return test(shapes.spheres[i]); });
    search(shapes.accel, shapes.triangle_tree, shapes.mesh.triangles.size(), ray, [&](std::uint32_t i) {
        //> a triangle that is hit shortens the ray too
        const auto [a, b, c] = corners(shapes.mesh, i);
        if (const auto hit = intersect(a, b, c, ray)) {
            ray.t_max = hit->t;
            met = MeshHit{&shapes.mesh, i, hit->u, hit->v};
        }
        //<
        return false;
    });
}

/// The quad of which a triangle of the wide tree is one half; null for a triangle of the mesh.
inline const Quad* quad_of(const Shapes& shapes, std::uint32_t i) {
    const std::size_t triangles = shapes.mesh.triangles.size();
    return i < triangles ? nullptr : &shapes.quads[(i - triangles) / 2];
}

/// Counts the tests of the wide trees as those of the others are.
struct TallyCounters {
    static void count_boxes(std::size_t count) { tally.box_tests += count; }
    static void count_primitives(std::size_t count) { tally.triangle_tests += count; }
};

/// The same by the wide trees. They know which shapes the ray may meet; where it meets them is worked out in
/// double, as above. So all ways give the same picture.
template <typename Counters>
inline void search_wide(const Shapes& shapes, Ray& ray, Met& met) {
    const auto shorten = [&](float t, auto found) {
        ray.t_max = t;
        met = found;
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

/// What the ray meets first. Each hit shortens the ray, so the last one found is the nearest; only that one
/// is worked out in full.
inline std::optional<Hit> intersect(const Shapes& shapes, Ray ray) {
    ++tally.rays;
    Met met;
    for (const Plane& plane : shapes.planes) {
        if (const auto t = intersect(plane, ray)) {
            ray.t_max = *t;
            met = &plane;
        }
    }
    if (shapes.accel != Accel::wide)
        search_shapes(shapes, ray, met);
    else if (shapes.count_tests)
        search_wide<TallyCounters>(shapes, ray, met);
    else
        search_wide<accel::NoCounters>(shapes, ray, met);
    return match(
        met, [](std::monostate) { return std::optional<Hit>(); },
        [&](const auto* shape) { return std::optional(surface_hit(*shape, ray)); },
        [&](const MeshHit& found) { return std::optional(surface_hit(found, ray)); });
}

/// The wide trees' part of occluded().
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

/// Whether anything at all stands in the ray's interval: the first shape that does ends the search.
inline bool occluded(const Shapes& shapes, const Ray& ray) {
    ++tally.rays;
    bool found = false;
    const auto test = [&](const auto& shape) { return found = intersect(shape, ray).has_value(); };
    if (std::ranges::any_of(shapes.planes, test)) return true;
    if (shapes.accel == Accel::wide)
        return shapes.count_tests ? occluded_wide<TallyCounters>(shapes, ray)
                                  : occluded_wide<accel::NoCounters>(shapes, ray);
    if (std::ranges::any_of(shapes.quads, test)) return true;
    search(shapes.accel, shapes.sphere_tree, shapes.spheres.size(), ray,
           [&](std::uint32_t i) { return test(shapes.spheres[i]); });
    if (found) return true;
    search(shapes.accel, shapes.triangle_tree, shapes.mesh.triangles.size(), ray, [&](std::uint32_t i) {
        const auto [a, b, c] = corners(shapes.mesh, i);
        return found = intersect(a, b, c, ray).has_value();
    });
    return found;
}

} // namespace rt
