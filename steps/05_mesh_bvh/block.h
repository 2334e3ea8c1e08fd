// A row of shapes side by side, so that one pass tests them all: the leaves of the wide tree.
#pragma once

#include "01_spheres/sphere.h"
#include "common/row.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace rt {

inline constexpr std::uint32_t no_shape = 0xffffffff;

/// Which shapes of a block the ray meets, a bit a lane, and where; t, u and v hold there alone.
struct BlockHits {
    unsigned hit;
    Row t, u, v;
};

/// A ray as triangles want it. It is fastest along the axis z; x and y are the other two.
struct TriangleRay {
    int x, y, z;
    Row origin_x, origin_y, origin_z;
    Row shear_x, shear_y, scale; ///< take the direction to the unit vector along z
};

/// A row of triangles. An empty lane has three equal corners, which no ray meets.
struct alignas(2 * sizeof(Row)) TriangleBlock {
    Row corners[3][3]{};                    ///< corner, axis
    std::array<std::uint32_t, lanes> shape; ///< the triangles' numbers

    static TriangleRay prepare(const Ray& ray);
};

[[gnu::always_inline]] inline TriangleRay TriangleBlock::prepare(const Ray& ray) {
    const vec3 inverse = 1.0f / ray.direction; // of which wide_ray() needs all three: the same divisions
    const vec3 d = absolute(ray.direction);
    const bool y_leads = d.y > d.x;
    const int z = d.z >= (y_leads ? d.y : d.x) ? 2 : int(y_leads);
    const int x = z == 2 ? 0 : z + 1, y = z == 0 ? 2 : z - 1;
    const float scale = inverse[z];
    return {x,
            y,
            z,
            row(ray.origin[x]),
            row(ray.origin[y]),
            row(ray.origin[z]),
            row(ray.direction[x] * scale),
            row(ray.direction[y] * scale),
            row(scale)};
}

inline void put(TriangleBlock& block, int lane, const std::array<vec3, 3>& corners, std::uint32_t shape) {
    for (std::size_t corner = 0; corner < 3; ++corner)
        for (int axis = 0; axis < 3; ++axis) block.corners[corner][axis][lane] = corners[corner][axis];
    block.shape[std::size_t(lane)] = shape;
}

/// Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection". Shear space so that the ray runs
/// along z from the origin: then it meets a triangle whose three edges all turn the same way around (0, 0).
/// The edge functions of two triangles that share an edge are each other's exact negatives, since a product
/// is rounded the same way on both sides: no ray slips through between them, in float and without an epsilon.
[[gnu::always_inline]] inline BlockHits intersect(const TriangleBlock& block, const TriangleRay& ray,
                                                  Row t_min, Row t_max) {
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
    const Row w =
        b_x * a_y - b_y * a_x; // and from c: the weights of these corners, times the sum of all three
    const Row inverse = 1.0f / (u + v + w);
    const Row t = (u * a_z + v * b_z + w * c_z) * ray.scale * inverse;
    const unsigned one_way =
        at_most(Row{}, least(least(u, v), w)) | at_most(greatest(greatest(u, v), w), Row{});
    return {one_way & less(t_min, t) & less(t, t_max), t, v * inverse, w * inverse};
}

/// A ray as spheres want it: in rows to sort out most of them, and as it is.
struct SphereRay {
    Row origin[3], direction[3], squared_length;
    Ray ray;
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
            row(dot(ray.direction, ray.direction)),
            ray};
}

inline void put(SphereBlock& block, int lane, const Sphere& sphere, std::uint32_t shape) {
    for (int axis = 0; axis < 3; ++axis) block.center[axis][lane] = sphere.center[axis];
    block.radius[lane] = sphere.radius;
    block.shape[std::size_t(lane)] = shape;
}

/// The sphere in a lane of a block, without its material.
inline Sphere sphere_at(const SphereBlock& block, std::size_t lane) {
    return {{block.center[0][lane], block.center[1][lane], block.center[2][lane]}, block.radius[lane], 0};
}

/// The spheres that the ray may meet: its line passes near them and they do not lie behind it. These are the
/// signs of the discriminant, of h and of c in intersect(const Sphere&, ...). Floats are off by less than
/// 2^-19 |C - O|^2, which is given away, and what is not a number counts: none is left out that is met.
[[gnu::always_inline]] inline unsigned candidates(const SphereBlock& block, const SphereRay& ray) {
    const Row x = block.center[0] - ray.origin[0];
    const Row y = block.center[1] - ray.origin[1];
    const Row z = block.center[2] - ray.origin[2];
    const Row h = x * ray.direction[0] + y * ray.direction[1] + z * ray.direction[2];
    const Row c = (x * x + y * y + z * z) * (1 - 0x1p-19f) - block.radius * block.radius;
    const unsigned filled = less(Row{}, block.radius);
    const unsigned apart = less(h * h, ray.squared_length * c), behind = less(h, Row{}) & less(Row{}, c);
    return filled & ~apart & ~behind;
}

/// Those that are left, most often one or none, decide by intersect(const Sphere&, ...), in double. The least t
/// is the ray's own.
[[gnu::always_inline]] inline BlockHits intersect(const SphereBlock& block, const SphereRay& ray, Row,
                                                  Row t_max) {
    BlockHits hits{};
    Ray shortened = ray.ray;
    shortened.t_max = t_max[0];
    for (unsigned left = candidates(block, ray); left != 0;) {
        const std::size_t lane = next_lane(left);
        if (const auto t = intersect(sphere_at(block, lane), shortened)) {
            hits.hit |= 1u << lane;
            hits.t[lane] = *t;
        }
    }
    return hits;
}

} // namespace rt
