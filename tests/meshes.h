// Meshes and boxes to test trees on: random triangles, a flat grid, an icosphere, exponentially spaced boxes.
#pragma once

#include "05_mesh_bvh/aabb.h"
#include "common/model/obj_file.h"
#include "tests/05_mesh_bvh/rays.h"

#include <cmath>
#include <map>
#include <vector>

namespace rt {

inline void add_triangle(ObjModel& file, vec3 a, vec3 b, vec3 c) {
    const int first = int(file.positions.size());
    file.positions.insert(file.positions.end(), {a, b, c});
    file.triangles.push_back({{{first}, {first + 1}, {first + 2}}});
    file.triangle_materials.push_back(0);
}

inline ObjModel empty_file() {
    ObjModel file;
    file.materials.resize(1);
    return file;
}

/// Builds triangles with edges of about `size`, scattered over the unit cube.
inline ObjModel random_triangles(int count, float size, std::uint64_t seed = 1) {
    ObjModel file = empty_file();
    Random random(seed);
    for (int i = 0; i < count; ++i) {
        const vec3 a = random_point(random);
        const vec3 b = a + size * (random_point(random) - 0.5f);
        const vec3 c = a + size * (random_point(random) - 0.5f);
        add_triangle(file, a, b, c);
    }
    return file;
}

/// Builds 2 size^2 triangles that tile the unit square of the plane z = .3 and share their vertices.
inline ObjModel flat_grid(int size) {
    ObjModel file = empty_file();
    for (int y = 0; y <= size; ++y)
        for (int x = 0; x <= size; ++x)
            file.positions.push_back({float(x) / float(size), float(y) / float(size), 0.3f});
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const int a = y * (size + 1) + x, b = a + 1, c = a + size + 1, d = c + 1;
            file.triangles.push_back({{{a}, {b}, {d}}});
            file.triangles.push_back({{{a}, {d}, {c}}});
            file.triangle_materials.insert(file.triangle_materials.end(), {0, 0});
        }
    }
    return file;
}

/// Builds a unit sphere of 20 * 4^level triangles: an icosahedron, each face split in four, the vertices
/// moved to radius 1.
inline ObjModel icosphere(int level) {
    const float g = (1 + std::sqrt(5.0f)) / 2;
    ObjModel file = empty_file();
    file.positions = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (vec3& p : file.positions) p = normalize(p);
    std::vector<std::array<int, 3>> faces = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                             {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                             {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                             {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (; level > 0; --level) {
        std::map<std::pair<int, int>, int> known;
        const auto half_way = [&](int a, int b) {
            const auto [place, is_new] = known.emplace(std::minmax(a, b), int(file.positions.size()));
            if (is_new)
                file.positions.push_back(
                    normalize(file.positions[std::size_t(a)] + file.positions[std::size_t(b)]));
            return place->second;
        };
        std::vector<std::array<int, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const int ab = half_way(a, b), bc = half_way(b, c), ca = half_way(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        faces = finer;
    }
    for (const auto& [a, b, c] : faces) {
        file.triangles.push_back({{{a}, {b}, {c}}});
        file.triangle_materials.push_back(0);
    }
    return file;
}

/// Builds the cube [-1, 1]^3: two triangles per face, eight shared vertices, no normals.
inline ObjModel cube() {
    ObjModel file = empty_file();
    for (int i = 0; i < 8; ++i)
        file.positions.push_back(vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    const std::array<int, 4> faces[] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (const auto& [a, b, c, d] : faces) {
        file.triangles.push_back({{{a}, {b}, {c}}});
        file.triangles.push_back({{{a}, {c}, {d}}});
        file.triangle_materials.insert(file.triangle_materials.end(), {0, 0});
    }
    return file;
}

inline void transform(ObjModel& file, float scale, vec3 shift) {
    for (vec3& position : file.positions) position = scale * position + shift;
}

inline std::vector<Aabb> boxes_of(const ObjModel& file) {
    std::vector<Aabb> boxes;
    for (const auto& triangle : file.triangles) {
        Aabb box;
        for (const ObjIndex& corner : triangle) extend(box, file.positions[std::size_t(corner.position)]);
        boxes.push_back(box);
    }
    return boxes;
}

inline bool encloses(const Aabb& outer, const Aabb& inner) {
    return all(lessThanEqual(outer.min, inner.min)) && all(greaterThanEqual(outer.max, inner.max));
}

/// Returns boxes at 2^k along an axis, so that each split by equal bins separates only a few of them.
inline std::vector<Aabb> exponential_chain(int from, int to, vec3 axis) {
    std::vector<Aabb> boxes;
    for (int k = from; k <= to; ++k) {
        const vec3 p = std::ldexp(1.0f, k) * axis;
        boxes.push_back({min(p, 1.01f * p), max(p, 1.01f * p)});
    }
    return boxes;
}

} // namespace rt
