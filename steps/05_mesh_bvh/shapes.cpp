// How the trees over the shapes are built. Compiled once for all programs: it takes the compiler long, and few want to
// change it.
#include "05_mesh_bvh/shapes.h"

#include "05_mesh_bvh/wide_build.h"

#include <array>
#include <vector>

namespace rt {

namespace {

/// A quad as two triangles, so that the wide tree need not know it: `half` is 0 or 1.
std::array<vec3, 3> quad_triangle(const Quad& quad, std::size_t half) {
    const vec3 opposite = quad.corner + quad.edge_u + quad.edge_v;
    if (half == 0) return {quad.corner, quad.corner + quad.edge_u, opposite};
    return {quad.corner, opposite, quad.corner + quad.edge_v};
}

/// Triangle number i of the wide tree.
std::array<vec3, 3> wide_vertices(const Shapes& shapes, std::uint32_t i) {
    const std::size_t triangles = shapes.mesh.triangles.size();
    if (i < triangles) return vertices(shapes.mesh, i);
    return quad_triangle(shapes.quads[(i - triangles) / 2], (i - triangles) % 2);
}

void build_wide_trees(Shapes& shapes) {
    shapes.wide_spheres = build_wide_bvh<SphereBlock>(
        shapes.spheres.size(), [&](std::uint32_t i) { return bounds(shapes.spheres[i]); },
        [&](SphereBlock& block, int lane, std::uint32_t i) { put(block, lane, shapes.spheres[i], i); });
    shapes.wide_triangles = build_wide_bvh<TriangleBlock>(
        shapes.mesh.triangles.size() + 2 * shapes.quads.size(),
        [&](std::uint32_t i) { return bounds(wide_vertices(shapes, i)); },
        [&](TriangleBlock& block, int lane, std::uint32_t i) {
            put(block, lane, wide_vertices(shapes, i), i);
        });
}

void build_binary_trees(Shapes& shapes) {
    std::vector<Aabb> boxes;
    for (const Sphere& sphere : shapes.spheres) boxes.push_back(bounds(sphere));
    shapes.sphere_bvh = build_bvh(boxes);
    boxes.clear();
    for (std::uint32_t i = 0; i < shapes.mesh.triangles.size(); ++i) boxes.push_back(bounds(shapes.mesh, i));
    shapes.triangle_bvh = build_bvh(boxes);
}

} // namespace

void build_bvhs(Shapes& shapes) {
    if (shapes.accel == Accel::bvh) build_binary_trees(shapes);
    if (shapes.accel == Accel::wide) build_wide_trees(shapes);
}

} // namespace rt
