// Triangles by the thousand: corners shared by number, normals that make them look smooth.
#pragma once

#include "01_spheres/hit.h"
#include "03_mirror/mirror.h"
#include "05_mesh_bvh/box.h"
#include "05_mesh_bvh/triangle.h"
#include "common/obj_file.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace rt {

/// All meshes of a scene in one: flat arrays, and numbers instead of pointers.
struct Mesh {
    std::vector<vec3> positions;                         ///< one a vertex
    std::vector<vec3> normals;                           ///< unit, one a vertex
    std::vector<vec2> uvs;                               ///< one a vertex
    std::vector<std::array<std::uint32_t, 3>> triangles; ///< counter-clockwise from outside
    std::vector<std::int32_t> materials;                 ///< one a triangle
};

/// The part of a hit that a search keeps.
struct MeshHit {
    const Mesh* mesh;
    std::uint32_t triangle;
    float u, v;
};

inline std::array<vec3, 3> corners(const Mesh& mesh, std::uint32_t triangle) {
    const auto& [a, b, c] = mesh.triangles[triangle];
    return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

inline Box bounds(const Mesh& mesh, std::uint32_t triangle) {
    Box box;
    for (const vec3 corner : corners(mesh, triangle)) grow(box, corner);
    return box;
}

inline Box bounds(const Mesh& mesh) {
    Box box;
    for (const vec3 position : mesh.positions) grow(box, position);
    return box;
}

/// Twice the area, along the outward normal.
inline vec3 area_normal(const std::array<vec3, 3>& corner) {
    return cross(corner[1] - corner[0], corner[2] - corner[0]);
}

/// A value given at the corners, at the point with these barycentric weights.
template <typename Value>
Value interpolate(const std::vector<Value>& values, const std::array<std::uint32_t, 3>& corner, float u,
                  float v) {
    //> (1 - u - v) A + u B + v C
    return (1 - u - v) * values[corner[0]] + u * values[corner[1]] + v * values[corner[2]];
    //< return values[corner[0]];
}

/// An interpolated normal may turn so far that a mirror would send the ray into the surface. Then it is bent
/// back until the reflected ray just clears the true surface. All unit, both normals on the ray's side.
inline vec3 clearing(vec3 direction, vec3 smooth, vec3 geometric) {
    const vec3 reflected = reflect(direction, smooth);
    const float height = dot(reflected, geometric);
    const float least = 0.01f;
    if (height >= least) return smooth;
    return normalize(normalize(reflected + (least - height) * geometric) - direction);
}

/// The hit at ray.t_max, where the ray was found to meet a triangle.
inline Hit surface(const MeshHit& found, const Ray& ray) {
    const Mesh& mesh = *found.mesh;
    const auto& corner = mesh.triangles[found.triangle];
    const vec3 outward = normalize(area_normal(corners(mesh, found.triangle)));
    const vec3 smooth = normalize(interpolate(mesh.normals, corner, found.u, found.v));
    const vec2 uv = interpolate(mesh.uvs, corner, found.u, found.v);
    Hit hit = make_hit(ray, outward, smooth, uv, mesh.materials[found.triangle]);
    hit.normal = clearing(normalize(ray.direction), hit.normal, hit.geometric_normal);
    return hit;
}

/// Numbers things 0, 1, 2 ... and finds those again that it has met: a hash table whose entries are chained.
struct Numbering {
    static constexpr std::uint32_t none = 0xffffffff;
    std::vector<std::uint32_t> newest; ///< by hash: the last thing numbered that has it,
    std::vector<std::uint32_t> older;  ///< by number: the one before it, and so on

    explicit Numbering(std::size_t size) : newest(std::bit_ceil(size), none) {}

    /// `same(n)` tells whether thing n is this one. Equal things must come with equal hashes.
    template <typename Same>
    std::uint32_t operator()(std::uint64_t hash, const Same& same) {
        std::uint32_t& head = newest[hash & (newest.size() - 1)];
        for (std::uint32_t n = head; n != none; n = older[n])
            if (same(n)) return n;
        older.push_back(head);
        return head = std::uint32_t(older.size() - 1);
    }
};

inline std::uint64_t hash(vec3 v) {
    std::uint64_t h = 0;
    for (int i = 0; i < 3; ++i) {
        h = (h ^ std::bit_cast<std::uint32_t>(v[i] + 0.0f)) * 0x9e3779b97f4a7c15; // -0 + 0 is 0, as -0 == 0
        h ^= h >> 32;
    }
    return h;
}

/// Corners of triangles (number 3 t + k for corner k of triangle t) by the point where they meet.
struct Meetings {
    std::vector<std::uint32_t> corner; ///< those of one point side by side, in ascending order
    std::vector<std::uint32_t> end;    ///< one a point: where its corners end and the next one's begin
};

/// Points count as one if their coordinates are equal, since many files repeat them for every face.
inline Meetings meetings(const ObjFile& file) {
    Numbering numbering(file.positions.size());
    std::vector<vec3> points;
    std::vector<std::uint32_t> point; // one a position
    for (const vec3 p : file.positions) {
        point.push_back(numbering(hash(p), [&](std::uint32_t n) { return points[n] == p; }));
        if (point.back() == points.size()) points.push_back(p);
    }
    const auto corners = std::uint32_t(3 * file.triangles.size());
    const auto point_of = [&](std::uint32_t c) {
        return point[std::size_t(file.triangles[c / 3][c % 3].position)];
    };
    Meetings meet{std::vector<std::uint32_t>(corners), std::vector<std::uint32_t>(points.size() + 1)};
    for (std::uint32_t c = 0; c < corners; ++c) ++meet.end[point_of(c) + 1]; // how many,
    std::partial_sum(meet.end.begin(), meet.end.end(), meet.end.begin());    // where they begin,
    for (std::uint32_t c = 0; c < corners; ++c)
        meet.corner[meet.end[point_of(c)]++] = c; // and where they end
    meet.end.pop_back();
    return meet;
}

/// The faces that meet in a point, as area normals: for each the sum of those, itself among them, that differ from
/// it by no more than the angle `crease`, in radians.
inline std::vector<vec3> smooth_sums(const std::vector<vec3>& faces, float crease) {
    const vec3 all = std::accumulate(faces.begin(), faces.end(), vec3(0));
    const float half = (std::cos(crease / 2) + 1e-5f) * length(all);
    const auto near_all = [&](vec3 face) { return dot(face, all) > half * length(face); };
    if (std::ranges::all_of(faces, near_all)) // none differs by half from their sum: no two by more than all
        return std::vector<vec3>(faces.size(), all);

    std::vector<float> lengths;
    for (const vec3 face : faces) lengths.push_back(length(face));
    std::vector<vec3> sums(faces.size());
    for (std::size_t i = 0; i < faces.size(); ++i) {
        const float least = std::cos(crease) * lengths[i];
        vec3 sum(0);
        for (std::size_t j = 0; j < faces.size(); ++j)
            if (dot(faces[i], faces[j]) >= least * lengths[j]) sum += faces[j];
        sums[i] = sum;
    }
    return sums;
}

/// A normal for each corner of each triangle of a file that gives none. Faces that meet in a point are
/// smoothed together, weighted by area, unless they differ by more than `crease` degrees: so a ball is round
/// and a cube keeps its edges.
inline std::vector<std::array<vec3, 3>> smooth_normals(const ObjFile& file, float crease) {
    const auto face = [&](std::uint32_t t) {
        const auto& [a, b, c] = file.triangles[t];
        return area_normal({file.positions[std::size_t(a.position)], file.positions[std::size_t(b.position)],
                            file.positions[std::size_t(c.position)]});
    };
    const Meetings meet = meetings(file);
    std::vector<std::array<vec3, 3>> normals(file.triangles.size());
    std::vector<vec3> faces;
    for (std::uint32_t begin = 0; const std::uint32_t end : meet.end) {
        faces.clear();
        for (std::uint32_t i = begin; i < end; ++i) faces.push_back(face(meet.corner[i] / 3));
        const std::vector<vec3> sums = smooth_sums(faces, glm::radians(crease));
        for (std::uint32_t i = begin; i < end; ++i) {
            const vec3 sum = sums[i - begin];
            normals[meet.corner[i] / 3][meet.corner[i] % 3] =
                normalize(length(sum) > 0 ? sum : faces[i - begin]);
        }
        begin = end;
    }
    return normals;
}

/// Appends what the file holds to `mesh`; its material m becomes number material_numbers[m]. Normals that it
/// does not give are made by smooth_normals(); uvs that it does not give are (0, 0).
inline void append(Mesh& mesh, const ObjFile& file, const std::vector<int>& material_numbers, float crease) {
    const bool complete = std::ranges::all_of(file.triangles, [](const auto& triangle) {
        return std::ranges::all_of(triangle, [](const ObjCorner& corner) { return corner.normal >= 0; });
    });
    const auto made = complete ? std::vector<std::array<vec3, 3>>() : smooth_normals(file, crease);

    const std::size_t begin = mesh.positions.size();
    Numbering numbering(file.positions.size());
    std::vector<ObjCorner> known; // one a vertex of this file: a corner where it stands
    const auto vertex = [&](const ObjCorner& corner, vec3 normal) {
        const auto same = [&](std::uint32_t n) {
            return known[n].position == corner.position && known[n].uv == corner.uv &&
                   mesh.normals[begin + n] == normal;
        };
        // Neighbours in the file stay neighbours in the table, and in the cache; yet a tip of many normals spreads.
        const std::uint32_t n = numbering(hash(normal) % 1024 + std::uint64_t(corner.position), same);
        if (n == known.size()) {
            known.push_back(corner);
            mesh.positions.push_back(file.positions[std::size_t(corner.position)]);
            mesh.normals.push_back(normal);
            mesh.uvs.push_back(corner.uv >= 0 ? file.uvs[std::size_t(corner.uv)] : vec2(0));
        }
        return std::uint32_t(begin + n);
    };
    for (std::size_t i = 0; i < file.triangles.size(); ++i) {
        std::array<std::uint32_t, 3> triangle{};
        for (std::size_t k = 0; k < 3; ++k) {
            const ObjCorner& corner = file.triangles[i][k];
            const bool given = corner.normal >= 0;
            triangle[k] =
                vertex(corner, given ? normalize(file.normals[std::size_t(corner.normal)]) : made[i][k]);
        }
        mesh.triangles.push_back(triangle);
        mesh.materials.push_back(material_numbers[std::size_t(file.materials[i])]);
    }
}

/// Moves a model before it is added to a scene: scaled, turned about the y axis (degrees, from +z towards
/// +x), shifted.
inline void place(ObjFile& file, float scale, float turn, vec3 shift) {
    const float c = std::cos(glm::radians(turn)), s = std::sin(glm::radians(turn));
    const auto turned = [&](vec3 p) { return vec3(c * p.x + s * p.z, p.y, c * p.z - s * p.x); };
    for (vec3& position : file.positions) position = scale * turned(position) + shift;
    for (vec3& normal : file.normals) normal = turned(normal);
}

} // namespace rt
