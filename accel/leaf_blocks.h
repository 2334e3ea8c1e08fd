// The leaves of the wide tree: blocks of triangles or spheres, one per lane, all tested in one pass.
#pragma once

#include "accel/ray.h"
#include "accel/simd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace rt::accel {

/// Which primitives of a block a ray hits within its interval, one bit per lane: those that it may hit, and
/// those of them that it certainly does.
struct Candidates {
    unsigned maybe, certain;
};

/// A ray prepared for the watertight triangle test: sheared so that it runs along axis z, the axis of its
/// largest direction component. x and y are the other two.
struct WatertightRay {
    int x, y, z;
    FloatN origin_x, origin_y, origin_z;
    FloatN shear_x, shear_y; ///< take the direction to axis z
    float direction_z;
};

struct Interval {
    float begin, end;
};

/// Returns each t of the interval times `scale`, which may be negative.
inline Interval scaled(Interval t, float scale) {
    return {std::min(t.begin * scale, t.end * scale), std::max(t.begin * scale, t.end * scale)};
}

/// N triangles. The vertices of an empty lane are NaN, which no ray hits.
struct alignas(2 * sizeof(FloatN)) TriangleN {
    FloatN vertices[3][3];                           ///< vertex, axis
    std::array<std::uint32_t, simd_width> primitive; ///< the triangles' indices

    TriangleN() {
        for (auto& vertex : vertices) std::ranges::fill(vertex, broadcast(std::nanf("")));
    }
    static WatertightRay make_ray(const RayLike auto& ray);
};

[[gnu::always_inline]] inline WatertightRay TriangleN::make_ray(const RayLike auto& ray) {
    const vec3 inverse = 1.0f / ray.direction; // wide_ray() needs all three: the same divisions
    const vec3 d(std::abs(ray.direction.x), std::abs(ray.direction.y), std::abs(ray.direction.z));
    const bool y_is_major = d.y > d.x;
    const int z = d.z >= (y_is_major ? d.y : d.x) ? 2 : int(y_is_major);
    const int x = z == 2 ? 0 : z + 1, y = z == 0 ? 2 : z - 1;
    return {x,
            y,
            z,
            broadcast(ray.origin[x]),
            broadcast(ray.origin[y]),
            broadcast(ray.origin[z]),
            broadcast(ray.direction[x] * inverse[z]),
            broadcast(ray.direction[y] * inverse[z]),
            ray.direction[z]};
}

inline void set_lane(TriangleN& block, int lane, const std::array<vec3, 3>& vertices,
                     std::uint32_t primitive) {
    for (std::size_t vertex = 0; vertex < 3; ++vertex)
        for (int axis = 0; axis < 3; ++axis) block.vertices[vertex][axis][lane] = vertices[vertex][axis];
    block.primitive[std::size_t(lane)] = primitive;
}

inline std::array<vec3, 3> primitive_at(const TriangleN& block, std::size_t lane) {
    const auto vertex = [&](const FloatN(&axes)[3]) {
        return vec3(axes[0][lane], axes[1][lane], axes[2][lane]);
    };
    return {vertex(block.vertices[0]), vertex(block.vertices[1]), vertex(block.vertices[2])};
}

/// Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection". Shear space so that the ray runs
/// along axis z from the origin: then it hits a triangle if (0, 0) is on the same side of its three edges.
/// The edge functions of two triangles that share an edge are each other's exact negatives, since a product
/// is rounded in the same way on both sides: no ray slips through between them, in float and without an
/// epsilon.
///
/// That says which triangles the ray hits. Floats do not say where: t would be off by some 2^-22 of the size
/// of the triangle, more than the whole distance if a large one is close by. It is between the z of the
/// nearest and of the farthest vertex, which are exact up to their last bits.
[[gnu::always_inline]] inline Candidates candidates(const TriangleN& block, const WatertightRay& ray,
                                                    float t_min, float t_max) {
    const auto& [a, b, c] = block.vertices;
    const auto [x, y, z] = std::array{ray.x, ray.y, ray.z};
    const FloatN a_z = a[z] - ray.origin_z, b_z = b[z] - ray.origin_z, c_z = c[z] - ray.origin_z;
    const FloatN a_x = fnmadd(ray.shear_x, a_z, a[x] - ray.origin_x);
    const FloatN a_y = fnmadd(ray.shear_y, a_z, a[y] - ray.origin_y);
    const FloatN b_x = fnmadd(ray.shear_x, b_z, b[x] - ray.origin_x);
    const FloatN b_y = fnmadd(ray.shear_y, b_z, b[y] - ray.origin_y);
    const FloatN c_x = fnmadd(ray.shear_x, c_z, c[x] - ray.origin_x);
    const FloatN c_y = fnmadd(ray.shear_y, c_z, c[y] - ray.origin_y);
    const FloatN u = c_x * b_y - c_y * b_x; // twice the signed area opposite a,
    const FloatN v = a_x * c_y - a_y * c_x; // b
    const FloatN w = b_x * a_y - b_y * a_x; // and c
    const FloatN smallest = min(min(u, v), w), largest = max(max(u, v), w);
    const unsigned same_sign = less_equal(FloatN{}, smallest) | less_equal(largest, FloatN{});

    const FloatN min_z = min(min(a_z, b_z), c_z), max_z = max(max(a_z, b_z), c_z);
    const Interval z_interval = scaled({t_min, t_max}, ray.direction_z);
    const FloatN begin = broadcast(z_interval.begin), end = broadcast(z_interval.end);
    const unsigned maybe = same_sign & less_equal(min_z, end) & less_equal(begin, max_z);
    if (maybe == 0) return {0, 0};
    const unsigned has_area = less(FloatN{}, smallest) | less(largest, FloatN{});
    return {maybe, maybe & has_area & less(begin, min_z) & less(max_z, end)};
}

/// A ray prepared for the sphere test.
struct SphereRay {
    FloatN origin[3], direction[3], length_squared;
};

/// N spheres. The radius of an empty lane is NaN, which no ray hits.
struct alignas(2 * sizeof(FloatN)) SphereN {
    FloatN center[3]{};
    FloatN radius = broadcast(std::nanf(""));
    std::array<std::uint32_t, simd_width> primitive; ///< the spheres' indices

    static SphereRay make_ray(const RayLike auto& ray);
};

[[gnu::always_inline]] inline SphereRay SphereN::make_ray(const RayLike auto& ray) {
    return {{broadcast(ray.origin.x), broadcast(ray.origin.y), broadcast(ray.origin.z)},
            {broadcast(ray.direction.x), broadcast(ray.direction.y), broadcast(ray.direction.z)},
            broadcast(dot(ray.direction, ray.direction))};
}

inline void set_lane(SphereN& block, int lane, const Sphere& sphere, std::uint32_t primitive) {
    for (int axis = 0; axis < 3; ++axis) block.center[axis][lane] = sphere.center[axis];
    block.radius[lane] = sphere.radius;
    block.primitive[std::size_t(lane)] = primitive;
}

inline Sphere primitive_at(const SphereN& block, std::size_t lane) {
    return {{block.center[0][lane], block.center[1][lane], block.center[2][lane]}, block.radius[lane]};
}

/// The spheres that the ray may hit: its line passes near them and they are not behind it. These are the
/// signs of the discriminant, of h and of c in exact_hit(). Conservative: the test is relaxed by the error
/// bound of float, 2^-19 |C - O|^2, and NaN passes, so no sphere that is hit is rejected.
[[gnu::always_inline]] inline Candidates candidates(const SphereN& block, const SphereRay& ray, float,
                                                    float) {
    const FloatN x = block.center[0] - ray.origin[0];
    const FloatN y = block.center[1] - ray.origin[1];
    const FloatN z = block.center[2] - ray.origin[2];
    const FloatN h = x * ray.direction[0] + y * ray.direction[1] + z * ray.direction[2];
    const FloatN c = (x * x + y * y + z * z) * (1 - 0x1p-19f) - block.radius * block.radius;
    const unsigned filled = less(FloatN{}, block.radius);
    const unsigned misses = less(h * h, ray.length_squared * c);
    const unsigned behind = less(h, FloatN{}) & less(FloatN{}, c);
    return {filled & ~misses & ~behind, 0};
}

} // namespace rt::accel
