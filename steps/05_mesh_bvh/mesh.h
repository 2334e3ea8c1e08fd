// Triangle meshes: shared vertices by index, and normals that make them look smooth.
#pragma once

#include "01_spheres/hit.h"
#include "03_mirror/mirror.h"
#include "05_mesh_bvh/aabb.h"
#include "05_mesh_bvh/triangle.h"
#include "common/model/vertex_normals.h"
#include "common/model/index_map.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace rt {

/// All meshes of a scene in one: flat arrays, and indices instead of pointers.
struct Mesh {
    std::vector<vec3> positions;                         ///< one a vertex
    std::vector<vec3> normals;                           ///< unit, one a vertex
    std::vector<vec2> uvs;                               ///< one a vertex
    std::vector<vec3> colors;                            ///< linear RGB, one per vertex, or none at all
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< counter-clockwise from outside
    std::vector<std::int32_t> materials;                 ///< one a triangle
    dvec3 origin{0}; ///< of the positions, in the coordinates of the file that came first
};

/// What traversal keeps of a hit; the rest is computed for the closest one only.
struct MeshHit {
    const Mesh* mesh;
    std::uint32_t triangle;
    float u, v;
};

inline std::array<vec3, 3> vertices(const Mesh& mesh, std::uint32_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

inline Aabb bounds(const std::array<vec3, 3>& triangle) {
    Aabb box;
    for (const vec3 corner : triangle) extend(box, corner);
    return box;
}

inline Aabb bounds(const Mesh& mesh, std::uint32_t triangle) {
    return bounds(vertices(mesh, triangle));
}

inline Aabb bounds(const Mesh& mesh) {
    Aabb box;
    for (const vec3 position : mesh.positions) extend(box, position);
    return box;
}

/// Interpolates a value given at the vertices, at the point with these barycentric weights.
template <typename Value>
Value interpolate_barycentric(const std::vector<Value>& values, const std::array<std::uint32_t, 3>& corner,
                              float u, float v) {
    //> how much does each of the three corners count at (u, v)?
    return (1 - u - v) * values[corner[0]] + u * values[corner[1]] + v * values[corner[2]];
    //< return values[corner[0]];
}

/// Returns the shading normal, bent toward the geometric one as far as is needed for a reflected ray to leave
/// the surface. All vectors are unit, both normals on the ray's side.
inline vec3 ensure_valid_reflection(vec3 direction, vec3 shading_normal, vec3 geometric_normal) {
    const vec3 reflected = reflect(direction, shading_normal);
    const float cos_reflected = dot(reflected, geometric_normal);
    const float min_cos = 0.01f;
    if (cos_reflected >= min_cos) return shading_normal;
    return normalize(normalize(reflected + (min_cos - cos_reflected) * geometric_normal) - direction);
}

/// Returns the surface data of the hit with a triangle at ray.t_max.
inline Hit surface_hit(const MeshHit& mesh_hit, const Ray& ray) {
    const Mesh& mesh = *mesh_hit.mesh;
    const auto& corner = mesh.triangles[mesh_hit.triangle];
    const vec3 outward_normal = vec3(normalize(area_normal(vertices(mesh, mesh_hit.triangle))));
    const vec3 shading_normal =
        normalize(interpolate_barycentric(mesh.normals, corner, mesh_hit.u, mesh_hit.v));
    const vec2 uv = interpolate_barycentric(mesh.uvs, corner, mesh_hit.u, mesh_hit.v);
    Hit hit = make_hit(ray, outward_normal, shading_normal, uv, mesh.materials[mesh_hit.triangle]);
    hit.shading_normal =
        ensure_valid_reflection(normalize(ray.direction), hit.shading_normal, hit.geometric_normal);
    if (!mesh.colors.empty())
        hit.vertex_color = interpolate_barycentric(mesh.colors, corner, mesh_hit.u, mesh_hit.v);
    return hit;
}

/// Appends a model to `mesh`; its material m becomes material_ids[m]. Missing normals are computed by
/// smooth_normals(), missing uvs are (0, 0). A model with another origin than the mesh is moved.
inline void append_model(Mesh& mesh, const ObjModel& file, const std::vector<int>& material_ids,
                         float crease_angle) {
    const bool has_all_normals = std::ranges::all_of(file.triangles, [](const auto& triangle) {
        return std::ranges::all_of(triangle, [](const ObjIndex& corner) { return corner.normal >= 0; });
    });
    const auto computed_normals =
        has_all_normals ? std::vector<std::array<vec3, 3>>() : smooth_normals(file, crease_angle);

    const std::size_t begin = mesh.positions.size();
    if (begin == 0) mesh.origin = file.origin;
    const auto moved = [&, translation = file.origin - mesh.origin](vec3 p) {
        return vec3(dvec3(p) + translation);
    };
    if (!file.colors.empty()) mesh.colors.resize(begin, vec3(1)); // earlier models have none
    IndexMap vertex_map(file.positions.size());
    std::vector<ObjIndex> vertices; // one per vertex of this file: a corner that refers to it
    const auto vertex = [&](const ObjIndex& corner, vec3 normal) {
        const auto same = [&](std::uint32_t n) {
            return vertices[n].position == corner.position && vertices[n].uv == corner.uv &&
                   mesh.normals[begin + n] == normal;
        };
        // Hash mostly by position, so that nearby vertices share cache lines; mix in some bits of the normal,
        // so that a vertex with many normals (the tip of a cone) does not become one long chain.
        const std::uint32_t n = vertex_map(hash_vec3(normal) % 1024 + std::uint64_t(corner.position), same);
        if (n == vertices.size()) {
            vertices.push_back(corner);
            mesh.positions.push_back(moved(file.positions[std::size_t(corner.position)]));
            if (!file.colors.empty()) mesh.colors.push_back(file.colors[std::size_t(corner.position)]);
            mesh.normals.push_back(normal);
            mesh.uvs.push_back(corner.uv >= 0 ? file.uvs[std::size_t(corner.uv)] : vec2(0));
        }
        return std::uint32_t(begin + n);
    };
    for (std::size_t i = 0; i < file.triangles.size(); ++i) {
        std::array<std::uint32_t, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            const ObjIndex& corner = file.triangles[i][k];
            const bool has_normal = corner.normal >= 0;
            triangle[k] = vertex(corner, has_normal ? normalize(file.normals[std::size_t(corner.normal)])
                                                    : computed_normals[i][k]);
        }
        mesh.triangles.push_back(triangle);
        mesh.materials.push_back(material_ids[std::size_t(file.triangle_materials[i])]);
    }
    if (!mesh.colors.empty()) mesh.colors.resize(mesh.positions.size(), vec3(1));
}

} // namespace rt
