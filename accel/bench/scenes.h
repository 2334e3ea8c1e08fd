// What the benchmarks trace: a mesh in a closed room, and the rays of a path tracer through it.
#pragma once

#include "accel/accel.h"
#include "common/math/random.h"
#include "common/model/obj_file.h"
#include "common/util/error.h"
#include "common/util/paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

namespace rt::bench {

// ---- meshes ----

/// A mesh in a room, a camera that sees it, and a flat light below the ceiling. Every ray hits something.
struct BenchScene {
    std::string name;
    std::vector<vec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    vec3 camera{0}, target{0};
    float fov = 50; ///< degrees
    accel::Bounds light{};

    accel::TriangleMesh mesh() const { return {vertices, triangles}; }
};

inline std::array<vec3, 3> triangle_at(const accel::TriangleMesh& mesh, std::uint32_t index) {
    const auto& [a, b, c] = mesh.triangles[index];
    return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

inline vec3 random_direction(Random& random) {
    const float z = 1 - 2 * random.get_1d(), angle = 2 * pi * random.get_1d();
    const float radius = std::sqrt(std::max(0.0f, 1 - z * z));
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// Adds the walls of a room, and a light in the middle of its ceiling, a tenth as wide.
inline void add_room(BenchScene& scene, const accel::Bounds& room) {
    const auto begin = std::uint32_t(scene.vertices.size());
    for (int corner = 0; corner < 8; ++corner) // bit i: at the minimum or at the maximum of axis i
        scene.vertices.push_back(mix(room.min, room.max, glm::bvec3(corner & 1, corner & 2, corner & 4)));
    for (unsigned axis = 0; axis < 3; ++axis) {
        const unsigned u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
        for (const unsigned corner : {begin, begin + (1u << axis)}) {
            scene.triangles.push_back({corner, corner + u, corner + u + v});
            scene.triangles.push_back({corner, corner + u + v, corner + v});
        }
    }
    scene.vertices.reserve(scene.vertices.size() + 1); // Embree reads the last vertex as four floats
    scene.light = {mix(room.min, room.max, vec3(0.45f, 0.998f, 0.45f)),
                   mix(room.min, room.max, vec3(0.55f, 0.998f, 0.55f))};
}

/// Returns the point at angle phi of a knot: a curve that winds turns.x times about the axis of a torus of
/// radius 2 and turns.y times about its core. With radius 0, returns the normal of the torus at that point.
inline vec3 knot_point(vec2 turns, float radius, float phi) {
    const float ring = radius + std::cos(turns.y * phi);
    return {ring * std::cos(turns.x * phi), ring * std::sin(turns.x * phi), -std::sin(turns.y * phi)};
}

/// Adds a tube around a knot, of 2 segments * sides triangles.
inline void add_knot(BenchScene& scene, vec2 turns, const glm::mat3& rotation, vec3 center,
                     std::uint32_t segments, std::uint32_t sides) {
    const float thickness = 0.28f, scale = 0.49f / (3 + thickness);
    const auto begin = std::uint32_t(scene.vertices.size());
    for (std::uint32_t i = 0; i < segments; ++i) {
        const float phi = 2 * pi * float(i) / float(segments);
        const vec3 ahead = knot_point(turns, 2, phi + 1e-3f), behind = knot_point(turns, 2, phi - 1e-3f);
        const vec3 normal = knot_point(turns, 0, phi), binormal = cross(normalize(ahead - behind), normal);
        for (std::uint32_t j = 0; j < sides; ++j) {
            const float angle = 2 * pi * float(j) / float(sides);
            const vec3 outward = std::cos(angle) * normal + std::sin(angle) * binormal;
            const vec3 point = knot_point(turns, 2, phi) + thickness * outward;
            scene.vertices.push_back(center + scale * (rotation * point));
            const auto vertex = [&](std::uint32_t segment, std::uint32_t side) {
                return begin + segment % segments * sides + side % sides;
            };
            scene.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i + 1, j)});
            scene.triangles.push_back({vertex(i, j), vertex(i, j + 1), vertex(i + 1, j + 1)});
        }
    }
}

inline glm::mat3 random_rotation(Random& random) {
    const vec3 x = random_direction(random);
    vec3 other = random_direction(random);
    while (length(cross(x, other)) < 0.1f) other = random_direction(random);
    const vec3 y = normalize(cross(x, other));
    return {x, y, cross(x, y)};
}

/// Returns about `triangles` triangles: eight knots, each in a cell of 1 m. The shapes are the same for any
/// number of triangles, and on every run.
inline BenchScene knot_field(const std::string& name, int triangles) {
    BenchScene scene{.name = name, .camera = {0.4f, 1.4f, 2.8f}, .target = {1.1f, 0.84f, 0.8f}, .fov = 55};
    const double quads = std::max(24.0, (double(triangles) - 12) / 16); // of a knot
    const int sides = std::max(3, int(std::lround(std::sqrt(quads / 16))));
    const int segments = std::max(8, int(std::lround(quads / sides)));
    const vec2 turns[] = {{2, 3}, {3, 2}, {2, 5}, {3, 4}, {1, 4}};
    Random random(1);
    for (std::size_t i = 0; i < 8; ++i)
        add_knot(scene, turns[i % 5], random_rotation(random), vec3(i & 1, i >> 1 & 1, i >> 2) + 0.5f,
                 std::uint32_t(segments), std::uint32_t(sides));
    add_room(scene, {vec3(-0.3f, -0.1f, -0.3f), vec3(2.3f, 2.2f, 2.9f)});
    return scene;
}

/// Returns one of the assets, on the floor of a room.
inline BenchScene animal_in_room(const std::string& name) {
    BenchScene scene{.name = name};
    const ObjModel model = read_obj(asset_path(name + ".obj"));
    scene.vertices = model.positions;
    for (const auto& [a, b, c] : model.triangles)
        scene.triangles.push_back({unsigned(a.position), unsigned(b.position), unsigned(c.position)});
    accel::Bounds box;
    for (const vec3 vertex : scene.vertices) extend(box, vertex);
    const vec3 center = (box.min + box.max) / 2.0f;
    const float radius = length(box.max - box.min) / 2;
    const vec3 floor(center.x, box.min.y - 0.001f * radius, center.z);
    add_room(scene, {floor - radius * vec3(2.5f, 0, 2.5f), floor + radius * vec3(2.5f, 3, 2.5f)});
    scene.camera = center + radius * vec3(0.7f, 0.6f, 1.5f);
    scene.target = center;
    return scene;
}

/// Returns the number in "10k", "5M" or "250000"; 0 if it is not one from 100 to 50 million.
inline int triangle_count(const std::string& name) {
    char* end = nullptr;
    const double number = std::strtod(name.c_str(), &end);
    const std::string unit = end;
    const double count = number * (unit.empty() ? 1 : unit == "k" ? 1e3 : unit == "M" ? 1e6 : 0);
    return count >= 100 && count <= 5e7 ? int(count) : 0;
}

inline BenchScene make_scene(const std::string& name) {
    if (name == "cat" || name == "cow") return animal_in_room(name);
    if (const int count = triangle_count(name)) return knot_field(name, count);
    throw Error("--meshes: " + name + " is neither cat nor cow nor a number from 100 to 50M, as 10k or 1M");
}

// ---- rays ----

/// Returns the rays of `size` x `size` pixels through a pinhole, in tiles of 16 x 16, so that neighbours
/// follow each other. `size` is a multiple of 16.
inline std::vector<accel::Ray> primary_rays(const BenchScene& scene, int size) {
    const vec3 forward = normalize(scene.target - scene.camera);
    const vec3 right = normalize(cross(forward, vec3(0, 1, 0))), up = cross(right, forward);
    const float half_height = std::tan(glm::radians(scene.fov) / 2); // of the image at distance 1
    const int tile = 16, columns = size / tile;
    std::vector<accel::Ray> rays;
    for (int i = 0; i < size * size; ++i) {
        const int number = i / (tile * tile), within = i % (tile * tile);
        const vec2 pixel(number % columns * tile + within % tile, number / columns * tile + within / tile);
        const vec2 point = half_height * (2.0f * (pixel + 0.5f) / float(size) - 1.0f);
        rays.push_back({scene.camera, normalize(forward + point.x * right - point.y * up)});
    }
    return rays;
}

/// Returns three kinds of rays. "primary": primary_rays(); "bounce": from their hits in cosine-weighted
/// directions; "shadow": segments from their hits to points on the light, where the surface faces it.
inline std::map<std::string, std::vector<accel::Ray>> make_rays(const BenchScene& scene,
                                                                const accel::TriangleBvh& bvh, int size) {
    std::map<std::string, std::vector<accel::Ray>> rays{{"primary", primary_rays(scene, size)}};
    Random random(2);
    for (const accel::Ray& ray : rays["primary"]) {
        const auto hit = accel::closest_hit(bvh, ray);
        if (!hit) continue;
        const auto [a, b, c] = triangle_at(scene.mesh(), hit->primitive);
        const vec3 outward = vec3(normalize(cross(dvec3(b) - dvec3(a), dvec3(c) - dvec3(a))));
        const vec3 normal = dot(ray.direction, outward) > 0 ? -outward : outward;
        const vec3 position = ray.origin + hit->t * ray.direction;
        const vec3 reach =
            max(abs(position), abs(ray.origin)); // rounding moves the hit by 2^-21 of it at most
        const vec3 start = position + 0x1p-21f * std::max({reach.x, reach.y, reach.z}) * normal;
        rays["bounce"].push_back({start, normalize(normal + random_direction(random))});
        const vec2 u = random.get_2d();
        const vec3 to_light = mix(scene.light.min, scene.light.max, vec3(u.x, 0, u.y)) - start;
        if (dot(to_light, normal) > 0) rays["shadow"].push_back({start, to_light, 0, 1});
    }
    return rays;
}

} // namespace rt::bench
