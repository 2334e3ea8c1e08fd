// Eight shapes side by side, so that one pass tests them all: the leaves of the wide tree.
#pragma once

#include "01_spheres/sphere.h"
#include "common/row.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace rt {

inline constexpr std::uint32_t no_shape = 0xffffffff;

/// A ray as blocks want it.
struct BlockRay {
    Row origin[3];
    glm::dvec3 exact_origin, exact_direction;
    int x, y, z;                 ///< z: the axis along which the ray is fastest; x and y: the other two
    Row shear_x, shear_y, scale; ///< take the direction to the unit vector along z
};

[[gnu::always_inline]] inline BlockRay block_ray(const Ray& ray) {
    const vec3 inverse = 1.0f / ray.direction; // of which wide_ray() needs all three: the same divisions
    const vec3 d = absolute(ray.direction);
    const bool y_leads = d.y > d.x;
    const int z = d.z >= (y_leads ? d.y : d.x) ? 2 : int(y_leads);
    const int x = z == 2 ? 0 : z + 1, y = z == 0 ? 2 : z - 1;
    const float scale = inverse[z];
    return {{row(ray.origin.x), row(ray.origin.y), row(ray.origin.z)},
            glm::dvec3(ray.origin),
            glm::dvec3(ray.direction),
            x,
            y,
            z,
            row(ray.direction[x] * scale),
            row(ray.direction[y] * scale),
            row(scale)};
}

/// Where the ray meets each of eight shapes, in lanes of `hit`; t, u and v hold there alone.
struct BlockHits {
    Mask hit;
    Row t, u, v;
};

/// Eight triangles. An empty lane has three equal corners, which no ray meets.
struct alignas(64) TriangleBlock {
    Row corners[3][3]{};                    ///< corner, axis
    std::array<std::uint32_t, lanes> shape; ///< the triangles' numbers
};

inline void put(TriangleBlock& block, int lane, const std::array<vec3, 3>& corners, std::uint32_t shape) {
    for (std::size_t corner = 0; corner < 3; ++corner)
        for (int axis = 0; axis < 3; ++axis) block.corners[corner][axis][lane] = corners[corner][axis];
    block.shape[std::size_t(lane)] = shape;
}

/// Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection". Shear space so that the ray runs
/// along z from the origin: then it meets a triangle whose three edges all turn the same way around (0, 0).
/// The edge functions of two triangles that share an edge are each other's exact negatives, since a product
/// is rounded the same way on both sides: no ray slips through between them, in float and without an epsilon.
[[gnu::always_inline]] inline BlockHits intersect(const TriangleBlock& block, const BlockRay& ray, Row t_min,
                                                  Row t_max) {
    const auto& [a, b, c] = block.corners;
    const auto [x, y, z] = std::array{ray.x, ray.y, ray.z};
    const Row a_z = a[z] - ray.origin[z], b_z = b[z] - ray.origin[z], c_z = c[z] - ray.origin[z];
    const Row a_x = negative_multiply_add(ray.shear_x, a_z, a[x] - ray.origin[x]);
    const Row a_y = negative_multiply_add(ray.shear_y, a_z, a[y] - ray.origin[y]);
    const Row b_x = negative_multiply_add(ray.shear_x, b_z, b[x] - ray.origin[x]);
    const Row b_y = negative_multiply_add(ray.shear_y, b_z, b[y] - ray.origin[y]);
    const Row c_x = negative_multiply_add(ray.shear_x, c_z, c[x] - ray.origin[x]);
    const Row c_y = negative_multiply_add(ray.shear_y, c_z, c[y] - ray.origin[y]);
    const Row u = c_x * b_y - c_y * b_x; // twice the signed area across from a,
    const Row v = a_x * c_y - a_y * c_x; // from b
    const Row w =
        b_x * a_y - b_y * a_x; // and from c: the weights of these corners, times the sum of all three
    const Row inverse = 1.0f / (u + v + w);
    const Row t = (u * a_z + v * b_z + w * c_z) * ray.scale * inverse;
    const Mask one_way = (least(least(u, v), w) >= 0) | (greatest(greatest(u, v), w) <= 0);
    return {one_way & (t_min < t) & (t < t_max), t, v * inverse, w * inverse};
}

/// Eight spheres. An empty lane has a radius that is not a number, which no ray meets.
struct alignas(64) SphereBlock {
    Row center[3]{};
    Row radius = row(std::nanf(""));
    std::array<std::uint32_t, lanes> shape; ///< the spheres' numbers
};

inline void put(SphereBlock& block, int lane, const Sphere& sphere, std::uint32_t shape) {
    for (int axis = 0; axis < 3; ++axis) block.center[axis][lane] = sphere.center[axis];
    block.radius[lane] = sphere.radius;
    block.shape[std::size_t(lane)] = shape;
}

/// The roots of intersect(const Sphere&, ...), in double for the same reason.
[[gnu::always_inline]] inline BlockHits intersect(const SphereBlock& block, const BlockRay& ray, Row t_min,
                                                  Row t_max) {
    const auto exact = [](Row row) { return __builtin_convertvector(row, RowOfDoubles); };
    const RowOfDoubles x = exact(block.center[0]) - ray.exact_origin.x;
    const RowOfDoubles y = exact(block.center[1]) - ray.exact_origin.y;
    const RowOfDoubles z = exact(block.center[2]) - ray.exact_origin.z;
    const RowOfDoubles radius = exact(block.radius);
    const glm::dvec3& d = ray.exact_direction;
    const RowOfDoubles h = d.x * x + d.y * y + d.z * z;
    const RowOfDoubles c = x * x + y * y + z * z - radius * radius;
    const double a = dot(ray.exact_direction, ray.exact_direction);
    const RowOfDoubles discriminant = h * h - a * c;
    RowOfDoubles root{};
    for (int i = 0; i < lanes; ++i) root[i] = std::sqrt(discriminant[i]); // NaN where the ray misses
    const RowOfDoubles q = h + (h < 0 ? -root : root);
    const Row one = __builtin_convertvector(q / a, Row), other = __builtin_convertvector(c / q, Row);
    const Row near = least(one, other), far = greatest(one, other);
    const Mask near_counts = (t_min < near) & (near < t_max), far_counts = (t_min < far) & (far < t_max);
    return {near_counts | far_counts, near_counts ? near : far, Row{}, Row{}};
}

} // namespace rt
