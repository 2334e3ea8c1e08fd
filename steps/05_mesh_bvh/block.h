// A row of shapes side by side, so that one pass tests them all: the leaves of the wide tree.
#pragma once

#include "01_spheres/sphere.h"
#include "05_mesh_bvh/triangle.h"
#include "common/math/row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace rt {

/// What a block says of a ray, one bit per lane: the shapes whose outline it passes through and that it may meet
/// within its interval, and those of them that it does meet there for certain.
struct Candidates {
    unsigned maybe, certain;
};

/// A ray as triangles need it. It is fastest along the axis z; x and y are the other two.
struct TriangleRay {
    int x, y, z;
    Row origin_x, origin_y, origin_z;
    Row shear_x, shear_y; ///< take the direction to the axis z
    float direction_z;
};

struct Interval {
    float begin, end;
};

/// Each t of the interval times `scale`, which may be negative.
inline Interval scaled(Interval t, float scale) {
    return {std::min(t.begin * scale, t.end * scale), std::max(t.begin * scale, t.end * scale)};
}

/// A row of triangles. An empty lane has corners that are not numbers, which no ray meets.
struct alignas(2 * sizeof(Row)) TriangleBlock {
    Row corners[3][3];                      ///< corner, axis
    std::array<std::uint32_t, lanes> shape; ///< the triangles' indices

    TriangleBlock() {
        for (auto& corner : corners) std::ranges::fill(corner, row(std::nanf("")));
    }
    static TriangleRay prepare(const Ray& ray);
};

[[gnu::always_inline]] inline TriangleRay TriangleBlock::prepare(const Ray& ray) {
    const vec3 inverse = 1.0f / ray.direction; // of which wide_ray() needs all three: the same divisions
    const vec3 d = abs(ray.direction);
    const bool y_leads = d.y > d.x;
    const int z = d.z >= (y_leads ? d.y : d.x) ? 2 : int(y_leads);
    const int x = z == 2 ? 0 : z + 1, y = z == 0 ? 2 : z - 1;
    return {x,
            y,
            z,
            row(ray.origin[x]),
            row(ray.origin[y]),
            row(ray.origin[z]),
            row(ray.direction[x] * inverse[z]),
            row(ray.direction[y] * inverse[z]),
            ray.direction[z]};
}

inline void put(TriangleBlock& block, int lane, const std::array<vec3, 3>& corners, std::uint32_t shape) {
    for (std::size_t corner = 0; corner < 3; ++corner)
        for (int axis = 0; axis < 3; ++axis) block.corners[corner][axis][lane] = corners[corner][axis];
    block.shape[std::size_t(lane)] = shape;
}

/// The triangle in a lane of a block.
inline std::array<vec3, 3> corners_at(const TriangleBlock& block, std::size_t lane) {
    const auto corner = [&](const Row(&axes)[3]) {
        return vec3(axes[0][lane], axes[1][lane], axes[2][lane]);
    };
    return {corner(block.corners[0]), corner(block.corners[1]), corner(block.corners[2])};
}

/// Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection". Shear space so that the ray runs along
/// z from the origin: then it meets a triangle whose three edges all turn the same way around (0, 0). The edge
/// functions of two triangles that share an edge are each other's exact negatives, since a product is rounded
/// the same way on both sides: no ray slips through between them, in float and without an epsilon.
///
/// That says which triangles the ray meets. Floats do not say where: t would be off by some 2^-22 of the size
/// of the triangle, more than the whole distance where a large one is close by. It lies between the z of the
/// nearest and of the farthest corner, which are exact up to their last bits.
[[gnu::always_inline]] inline Candidates candidates(const TriangleBlock& block, const TriangleRay& ray,
                                                    float t_min, float t_max) {
    const auto& [a, b, c] = block.corners;
    const auto [x, y, z] = std::array{ray.x, ray.y, ray.z};
    const Row a_z = a[z] - ray.origin_z, b_z = b[z] - ray.origin_z, c_z = c[z] - ray.origin_z;
    const Row a_x = negative_multiply_add(ray.shear_x, a_z, a[x] - ray.origin_x);
    const Row a_y = negative_multiply_add(ray.shear_y, a_z, a[y] - ray.origin_y);
    const Row b_x = negative_multiply_add(ray.shear_x, b_z, b[x] - ray.origin_x);
    const Row b_y = negative_multiply_add(ray.shear_y, b_z, b[y] - ray.origin_y);
    const Row c_x = negative_multiply_add(ray.shear_x, c_z, c[x] - ray.origin_x);
    const Row c_y = negative_multiply_add(ray.shear_y, c_z, c[y] - ray.origin_y);
    const Row u = c_x * b_y - c_y * b_x; // twice the signed area across from a,
    const Row v = a_x * c_y - a_y * c_x; // from b
    const Row w = b_x * a_y - b_y * a_x; // and from c
    const Row smallest = least(least(u, v), w), largest = greatest(greatest(u, v), w);
    const unsigned one_way = at_most(Row{}, smallest) | at_most(largest, Row{});

    const Row low = least(least(a_z, b_z), c_z), high = greatest(greatest(a_z, b_z), c_z);
    const Interval z_reach = scaled({t_min, t_max}, ray.direction_z);
    const Row begin = row(z_reach.begin), end = row(z_reach.end);
    const unsigned maybe = one_way & at_most(low, end) & at_most(begin, high);
    if (maybe == 0) return {0, 0};
    const unsigned clear = less(Row{}, smallest) | less(largest, Row{}); // no area is no hit
    return {maybe, maybe & clear & less(begin, low) & less(high, end)};
}

/// Where the ray meets a triangle whose outline it passes through, if it does so within its interval: t, u and v
/// as in triangle.h, in double. Where the rounding of the outline lets a point pass that is outside, the weights
/// are drawn in, and t is between those of the corners, also for a triangle that is seen edge-on.
inline std::optional<TriangleHit> meeting(const std::array<vec3, 3>& corners, const Ray& ray) {
    const dvec3 a(corners[0]), direction(ray.direction);
    const dvec3 edge_b = dvec3(corners[1]) - a, edge_c = dvec3(corners[2]) - a;
    const dvec3 p = cross(direction, edge_c), from_a = dvec3(ray.origin) - a, q = cross(from_a, edge_b);
    const double determinant = dot(edge_b, p), numerator = dot(edge_c, q);
    if (numerator * determinant <= 0)
        return std::nullopt; // behind the ray, as the triangle that it starts from
    const double inverse = 1 / determinant;
    double t = numerator * inverse;
    if (!contains(ray, float(t))) return std::nullopt;
    double u = dot(from_a, p) * inverse, v = dot(direction, q) * inverse;
    if (!(u >= 0 && v >= 0 && u + v <= 1)) [[unlikely]] {
        u = glm::clamp(u, 0.0, 1.0);
        v = glm::clamp(v, 0.0, 1 - u);
        const dvec3 along = direction / dot(direction, direction);
        const dvec3 t_of(-dot(from_a, along), dot(edge_b - from_a, along), dot(edge_c - from_a, along));
        t = glm::clamp(t, std::min({t_of.x, t_of.y, t_of.z}), std::max({t_of.x, t_of.y, t_of.z}));
        if (!contains(ray, float(t))) return std::nullopt;
    }
    return TriangleHit{float(t), float(u), float(v)};
}

/// A ray as spheres need it.
struct SphereRay {
    Row origin[3], direction[3], squared_length;
};

/// A row of spheres. An empty lane has a radius that is not a number, which no ray meets.
struct alignas(2 * sizeof(Row)) SphereBlock {
    Row center[3]{};
    Row radius = row(std::nanf(""));
    std::array<std::uint32_t, lanes> shape; ///< the spheres' numbers

    static SphereRay prepare(const Ray& ray);
};

[[gnu::always_inline]] inline SphereRay SphereBlock::prepare(const Ray& ray) {
    return {{row(ray.origin.x), row(ray.origin.y), row(ray.origin.z)},
            {row(ray.direction.x), row(ray.direction.y), row(ray.direction.z)},
            row(dot(ray.direction, ray.direction))};
}

inline void put(SphereBlock& block, int lane, const Sphere& sphere, std::uint32_t shape) {
    for (int axis = 0; axis < 3; ++axis) block.center[axis][lane] = sphere.center[axis];
    block.radius[lane] = sphere.radius;
    block.shape[std::size_t(lane)] = shape;
}

/// The spheres that the ray may meet: its line passes near them and they do not lie behind it. These
/// are the signs of the discriminant, of h and of c in intersect(const Sphere&, ...). Conservative: the test
/// is relaxed by the error bound of float, 2^-19 |C - O|^2, and NaN passes.
[[gnu::always_inline]] inline Candidates candidates(const SphereBlock& block, const SphereRay& ray, float,
                                                    float) {
    const Row x = block.center[0] - ray.origin[0];
    const Row y = block.center[1] - ray.origin[1];
    const Row z = block.center[2] - ray.origin[2];
    const Row h = x * ray.direction[0] + y * ray.direction[1] + z * ray.direction[2];
    const Row c = (x * x + y * y + z * z) * (1 - 0x1p-19f) - block.radius * block.radius;
    const unsigned filled = less(Row{}, block.radius);
    const unsigned apart = less(h * h, ray.squared_length * c), behind = less(h, Row{}) & less(Row{}, c);
    return {filled & ~apart & ~behind, 0};
}

} // namespace rt
