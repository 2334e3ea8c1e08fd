// A triangle mesh in double precision, as the generators produce it for the OBJ writer.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace rt::assets {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

/// A triangle, counter-clockwise seen from outside. A vertex on a texture seam has one
/// position and several uvs.
struct Triangle {
    std::array<int, 3> vertex{}; ///< indices into both positions and normals
    std::array<int, 3> uv{};     ///< indices into uvs
};

struct Mesh {
    std::vector<dvec3> positions;
    std::vector<dvec3> normals; ///< unit length, outward, one per position
    std::vector<dvec2> uvs;     ///< v = 0 is the bottom row of the texture, as in OBJ
    std::vector<Triangle> triangles;
};

/// Returns the outward vector whose length is twice the triangle's area.
inline dvec3 area_vector(const Mesh& mesh, const Triangle& triangle) {
    const dvec3 a = mesh.positions[triangle.vertex[0]];
    return cross(mesh.positions[triangle.vertex[1]] - a, mesh.positions[triangle.vertex[2]] - a);
}

} // namespace rt::assets
