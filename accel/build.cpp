// The trees of accel.h. Compiled once, since it takes the compiler long.
#include "accel/accel.h"

#include "accel/build.h"

#include <algorithm>
#include <vector>

namespace rt::accel {

TriangleBvh build_triangle_bvh(std::span<const TriangleMesh> meshes) {
    std::vector<std::size_t> ends; // of each mesh's triangles, in the numbering through all meshes
    for (const TriangleMesh& mesh : meshes)
        ends.push_back((ends.empty() ? 0 : ends.back()) + mesh.triangles.size());
    const auto triangle = [&](std::uint32_t i) {
        const auto index = std::size_t(std::ranges::upper_bound(ends, std::size_t(i)) - ends.begin());
        const TriangleMesh& mesh = meshes[index];
        const auto& [a, b, c] = mesh.triangles[i - (ends[index] - mesh.triangles.size())];
        return std::array{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
    };
    return build_wide_bvh<TriangleN>(
        ends.empty() ? 0 : ends.back(), [&](std::uint32_t i) { return bounds_of(triangle(i)); },
        [&](TriangleN& block, int lane, std::uint32_t i) { set_lane(block, lane, triangle(i), i); });
}

TriangleBvh build_triangle_bvh(const TriangleMesh& mesh) {
    return build_triangle_bvh(std::span(&mesh, 1));
}

SphereBvh build_sphere_bvh(std::span<const Sphere> spheres) {
    return build_wide_bvh<SphereN>(
        spheres.size(), [&](std::uint32_t i) { return bounds_of(spheres[i]); },
        [&](SphereN& block, int lane, std::uint32_t i) { set_lane(block, lane, spheres[i], i); });
}

} // namespace rt::accel
