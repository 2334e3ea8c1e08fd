// A triangle mesh as the generators hand it on, in double precision, before it is rounded into an OBJ file.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace rt::assets {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;
using glm::ivec3;

/// Corners counter-clockwise seen from outside. A vertex on a seam of the texture has one position, many uvs.
struct Triangle {
    std::array<int, 3> vertex{}; ///< indices into positions and normals alike
    std::array<int, 3> uv{};     ///< indices into uvs
};

struct Mesh {
    std::vector<dvec3> positions;
    std::vector<dvec3> normals; ///< unit length, outward, one a position
    std::vector<dvec2> uvs;     ///< v = 0 is the bottom row of the picture, as OBJ has it
    std::vector<Triangle> triangles;
};

/// Twice the triangle's area, along its outward side.
inline dvec3 area_vector(const Mesh& mesh, const Triangle& triangle) {
    const dvec3 a = mesh.positions[triangle.vertex[0]];
    return cross(mesh.positions[triangle.vertex[1]] - a, mesh.positions[triangle.vertex[2]] - a);
}

} // namespace rt::assets
