// Builds the trees over the shapes. Compiled once for all programs, since few learners change it.
#include "05_mesh_bvh/shapes.h"

#include <array>
#include <vector>

namespace rt {

namespace {

/// The quads as two triangles each, so that the wide tree needs no quads.
struct QuadTriangles {
    std::vector<vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;

    explicit QuadTriangles(const std::vector<Quad>& quads) {
        for (const Quad& quad : quads) {
            const auto first = std::uint32_t(vertices.size());
            vertices.insert(vertices.end(),
                            {quad.corner, quad.corner + quad.edge_u, quad.corner + quad.edge_u + quad.edge_v,
                             quad.corner + quad.edge_v});
            triangles.push_back({first, first + 1, first + 2});
            triangles.push_back({first, first + 2, first + 3});
        }
    }
};

void build_wide_trees(Shapes& shapes) {
    std::vector<accel::Sphere> spheres;
    for (const Sphere& sphere : shapes.spheres) spheres.push_back({sphere.center, sphere.radius});
    shapes.wide_spheres = accel::build_sphere_bvh(spheres);
    const QuadTriangles quads(shapes.quads);
    shapes.wide_triangles = accel::build_triangle_bvh(
        std::array{accel::TriangleMesh{shapes.mesh.positions, shapes.mesh.triangles},
                   accel::TriangleMesh{quads.vertices, quads.triangles}});
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
