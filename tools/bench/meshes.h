// What the benchmarks trace: an animal, and fields of torus knots of any size, each in a closed room of 12
// triangles.
#pragma once

#include "01_spheres/camera.h"
#include "05_mesh_bvh/mesh.h"
#include "common/util/error.h"
#include "common/util/paths.h"
#include "common/math/random.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace rt::bench {

/// A mesh, a camera that sees it, and a small square light under the ceiling. Every ray meets something.
struct BenchScene {
    std::string name;
    Mesh mesh;
    LookAt look_at;
    vec3 light_corner, light_u, light_v; ///< the square's corner and edges
};

inline std::uint32_t add_vertex(Mesh& mesh, vec3 position, vec3 normal, vec2 uv) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.uvs.push_back(uv);
    return std::uint32_t(mesh.positions.size() - 1);
}

inline void add_triangle(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh.triangles.push_back({a, b, c});
    mesh.materials.push_back(0);
}

/// The six walls of a box, seen from inside.
inline void add_room(Mesh& mesh, const Aabb& box) {
    const vec3 size = box.max - box.min;
    for (int axis = 0; axis < 3; ++axis) {
        for (int side = 0; side < 2; ++side) {
            vec3 normal(0), u(0), v(0), corner = box.min;
            normal[axis] = side == 0 ? 1.0f : -1.0f;
            u[(axis + 1 + side) % 3] = size[(axis + 1 + side) % 3];
            v[(axis + 2 - side) % 3] = size[(axis + 2 - side) % 3];
            if (side == 1) corner[axis] = box.max[axis];
            const std::uint32_t a = add_vertex(mesh, corner, normal, {0, 0});
            const std::uint32_t b = add_vertex(mesh, corner + u, normal, {1, 0});
            const std::uint32_t c = add_vertex(mesh, corner + u + v, normal, {1, 1});
            const std::uint32_t d = add_vertex(mesh, corner + v, normal, {0, 1});
            add_triangle(mesh, a, b, c);
            add_triangle(mesh, a, c, d);
        }
    }
}

/// A curve that winds p times about the axis of a torus and q times about its core, at angle phi; and the
/// normal of the torus there, which is at right angles to the curve. It fits into a ball of radius 3.
struct Knot {
    float p, q;
};

inline vec3 knot_point(const Knot& knot, float phi) {
    const float ring = 2 + std::cos(knot.q * phi);
    return {ring * std::cos(knot.p * phi), ring * std::sin(knot.p * phi), -std::sin(knot.q * phi)};
}

inline vec3 knot_normal(const Knot& knot, float phi) {
    const float c = std::cos(knot.q * phi);
    return {c * std::cos(knot.p * phi), c * std::sin(knot.p * phi), -std::sin(knot.q * phi)};
}

/// From a knot's own coordinates to its place in the field.
struct Placement {
    vec3 axis_x, axis_y, axis_z, center;
};

inline vec3 rotated(const Placement& place, vec3 v) {
    return v.x * place.axis_x + v.y * place.axis_y + v.z * place.axis_z;
}

/// A tube round a knot, of 2 segments * sides triangles.
inline void add_knot(Mesh& mesh, const Knot& knot, const Placement& place, float scale, int segments,
                     int sides) {
    const float thickness = 0.28f;
    const auto begin = std::uint32_t(mesh.positions.size());
    for (int i = 0; i < segments; ++i) {
        const float phi = 2 * pi * float(i) / float(segments);
        const vec3 point = knot_point(knot, phi), n = knot_normal(knot, phi);
        const vec3 along = normalize(knot_point(knot, phi + 1e-3f) - knot_point(knot, phi - 1e-3f));
        const vec3 b = cross(along, n);
        for (int j = 0; j < sides; ++j) {
            const float angle = 2 * pi * float(j) / float(sides);
            const vec3 out = rotated(place, std::cos(angle) * n + std::sin(angle) * b);
            add_vertex(mesh, place.center + scale * (rotated(place, point) + thickness * out), normalize(out),
                       {float(i) / float(segments), float(j) / float(sides)});
        }
    }
    const auto number = [&](int i, int j) { return begin + std::uint32_t(i % segments * sides + j % sides); };
    for (int i = 0; i < segments; ++i) {
        for (int j = 0; j < sides; ++j) {
            add_triangle(mesh, number(i, j), number(i + 1, j + 1), number(i + 1, j));
            add_triangle(mesh, number(i, j), number(i, j + 1), number(i + 1, j + 1));
        }
    }
}

inline Placement random_placement(Random& random, vec3 center) {
    const auto direction = [&] {
        const float z = 1 - 2 * random.uniform(), angle = 2 * pi * random.uniform();
        const float r = std::sqrt(std::max(0.0f, 1 - z * z));
        return vec3(r * std::cos(angle), r * std::sin(angle), z);
    };
    const vec3 x = direction();
    vec3 other = direction();
    while (length(cross(x, other)) < 0.1f) other = direction();
    const vec3 y = normalize(cross(x, other));
    return {x, y, cross(x, y), center};
}

/// The light is a square of a tenth of the ceiling's width in its middle.
inline void furnish(BenchScene& scene, const Aabb& room) {
    add_room(scene.mesh, room);
    scene.mesh.positions.reserve(scene.mesh.positions.size() +
                                 1); // Embree reads the last vertex as four floats
    const vec3 size = room.max - room.min;
    const vec3 top(centroid(room).x, room.max.y - 0.002f * size.y, centroid(room).z);
    scene.light_u = vec3(0.1f * size.x, 0, 0);
    scene.light_v = vec3(0, 0, 0.1f * size.z);
    scene.light_corner = top - (scene.light_u + scene.light_v) / 2.0f;
}

/// About `triangles` of them: eight knots, each in a cell of 1 m, the same shapes however finely they are
/// cut. The same on every run.
inline BenchScene knot_field(const std::string& name, int triangles) {
    BenchScene scene;
    scene.name = name;
    const int side = 2;
    const double quads = std::max(24.0, (double(triangles) - 12) / 2 / (side * side * side));
    const int sides = std::max(3, int(std::lround(std::sqrt(quads / 16))));
    const int segments = std::max(8, int(std::lround(quads / sides)));
    constexpr std::array<Knot, 5> knots{{{2, 3}, {3, 2}, {2, 5}, {3, 4}, {1, 4}}};
    Random random(1);
    for (int i = 0; i < side * side * side; ++i) {
        const vec3 cell(i % side, i / side % side, i / (side * side));
        const Placement place = random_placement(random, cell + 0.5f);
        add_knot(scene.mesh, knots[std::size_t(i) % knots.size()], place, 0.49f / 3.28f, segments, sides);
    }
    const float s = float(side);
    furnish(scene, {vec3(-0.3f, -0.1f, -0.3f), vec3(s + 0.3f, s + 0.2f, s + 0.9f)});
    scene.look_at = {
        .from = {0.2f * s, 0.7f * s, s + 0.8f}, .at = {0.55f * s, 0.42f * s, 0.4f * s}, .fov = 55};
    return scene;
}

/// One of the assets, on the floor of a room three times as wide as it is long.
inline BenchScene animal_in_room(const std::string& name) {
    BenchScene scene;
    scene.name = name;
    const ObjModel file = read_obj(asset_path(name + ".obj"));
    append_model(scene.mesh, file, std::vector<int>(file.materials.size(), 0), 40);
    const Aabb box = bounds(scene.mesh);
    const vec3 center = centroid(box);
    const float r = length(box.max - box.min) / 2;
    const vec3 floor(center.x, box.min.y - 0.001f * r, center.z);
    furnish(scene, {floor - r * vec3(2.5f, 0, 2.5f), floor + r * vec3(2.5f, 3, 2.5f)});
    scene.look_at = {.from = center + r * vec3(0.7f, 0.6f, 1.5f), .at = center, .fov = 50};
    return scene;
}

/// The number in "10k", "5M" or "250000"; 0 if it is none between 100 and 50 million.
inline int triangle_count(const std::string& name) {
    std::size_t digits = 0;
    while (digits < name.size() && digits < 9 && name[digits] >= '0' && name[digits] <= '9') ++digits;
    if (digits == 0) return 0;
    const std::string unit = name.substr(digits);
    const double scale = unit.empty() ? 1 : unit == "k" ? 1e3 : unit == "M" ? 1e6 : 0;
    const double count = scale * std::stod(name.substr(0, digits));
    return count >= 100 && count <= 5e7 ? int(count) : 0;
}

inline BenchScene make_scene(const std::string& name) {
    if (name == "cat" || name == "cow") return animal_in_room(name);
    const int count = triangle_count(name);
    if (count == 0)
        throw Error("--meshes: " + name +
                    " is neither cat nor cow nor a number of triangles from 100 to 50M, as 10k or 1M");
    return knot_field(name, count);
}

} // namespace rt::bench
