// What a ray can meet, and how it finds the nearest: one vector per kind of shape, and trees over those that are
// many.
#pragma once

#include "01_spheres/plane.h"
#include "01_spheres/sphere.h"
#include "03_mirror/quad.h"
#include "05_mesh_bvh/bvh.h"
#include "05_mesh_bvh/mesh.h"
#include "common/match.h"
#include "common/tally.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace rt {

/// How a ray looks for what it meets: by asking every shape, or by descending a tree.
enum class Accel { brute, bvh };

struct Shapes {
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    std::vector<Quad> quads;
    Mesh mesh;
    Accel accel = Accel::bvh;
    Bvh sphere_tree;   ///< made by prepare(), as is
    Bvh triangle_tree; ///< this one
};

/// Builds the trees. Call it once, when all shapes are in place.
inline void prepare(Shapes& shapes) {
    std::vector<Box> boxes;
    for (const Sphere& sphere : shapes.spheres) boxes.push_back(bounds(sphere));
    shapes.sphere_tree = build_bvh(boxes);
    boxes.clear();
    for (std::uint32_t i = 0; i < shapes.mesh.triangles.size(); ++i) boxes.push_back(bounds(shapes.mesh, i));
    shapes.triangle_tree = build_bvh(boxes);
}

/// Calls test(i) for all shapes that the ray may meet, until one answers true.
template <typename Test>
void search(Accel accel, const Bvh& tree, std::size_t count, const Ray& ray, Test&& test) {
    if (accel == Accel::bvh) return traverse(tree, ray, test);
    for (std::uint32_t i = 0; i < count; ++i)
        if (test(i)) return;
}

/// What the ray meets first. Each hit shortens the ray, so the last one found is the nearest; only that one
/// is worked out in full.
inline std::optional<Hit> intersect(const Shapes& shapes, Ray ray) {
    ++tally.rays;
    std::variant<std::monostate, const Sphere*, const Plane*, const Quad*, MeshHit> nearest;
    const auto test = [&](const auto& shape) {
        if (const auto t = intersect(shape, ray)) {
            ray.t_max = *t;
            nearest = &shape;
        }
        return false;
    };
    for (const Plane& plane : shapes.planes) test(plane);
    for (const Quad& quad : shapes.quads) test(quad);
    search(shapes.accel, shapes.sphere_tree, shapes.spheres.size(), ray,
           [&](std::uint32_t i) { return test(shapes.spheres[i]); });
    search(shapes.accel, shapes.triangle_tree, shapes.mesh.triangles.size(), ray, [&](std::uint32_t i) {
        //> a triangle that is hit shortens the ray too
        const auto [a, b, c] = corners(shapes.mesh, i);
        if (const auto hit = intersect(a, b, c, ray)) {
            ray.t_max = hit->t;
            nearest = MeshHit{&shapes.mesh, i, hit->u, hit->v};
        }
        //<
        return false;
    });
    return match(
        nearest, [](std::monostate) { return std::optional<Hit>(); },
        [&](const auto* shape) { return std::optional(surface(*shape, ray)); },
        [&](const MeshHit& found) { return std::optional(surface(found, ray)); });
}

/// Whether anything at all stands in the ray's interval: the first shape that does ends the search.
inline bool occluded(const Shapes& shapes, const Ray& ray) {
    ++tally.rays;
    bool found = false;
    const auto test = [&](const auto& shape) { return found = intersect(shape, ray).has_value(); };
    if (std::ranges::any_of(shapes.planes, test) || std::ranges::any_of(shapes.quads, test)) return true;
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
