// The wide tree: how nodes of N boxes and leaves of N primitives are stored, and the test of a node.
#pragma once

#include "accel/leaf_blocks.h"
#include "accel/simd.h"
#include "common/util/huge_page_vector.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace rt::accel {

/// N boxes, axis by axis, minima before maxima; and the children in them. The box of an empty lane is inside
/// out (min = infinity), so that no ray enters it.
struct alignas(2 * sizeof(FloatN)) WideNode {
    FloatN bounds[3][2];                            ///< axis, minimum or maximum
    std::array<std::uint32_t, simd_width> children; ///< index of a storage unit; leaf_bit marks a leaf
};

inline constexpr std::uint32_t leaf_bit = 0x80000000;

constexpr bool is_leaf(std::uint32_t child) {
    return (child & leaf_bit) != 0;
}

/// Allocation unit: the sizes of nodes and leaf blocks are multiples of it.
struct alignas(WideNode) StorageUnit {
    std::byte bytes[alignof(WideNode)];
};

/// Nodes and leaves in one array, each next to its parent: what is needed next is near, one pointer reaches
/// all, and a prefetch need not know which of the two it fetches. `Block` is TriangleN or SphereN, or another
/// type with a make_ray() and candidates() like theirs.
template <typename Block>
struct WideBvh {
    HugePageVector<StorageUnit> storage; ///< empty without primitives
    std::uint32_t root = 0;              ///< like a child
    std::size_t node_count = 0, leaf_count = 0;
};

template <typename Block>
const WideNode& node_at(const WideBvh<Block>& bvh, std::uint32_t child) {
    return *reinterpret_cast<const WideNode*>(bvh.storage.data() + child);
}

template <typename Block>
const Block& leaf_at(const WideBvh<Block>& bvh, std::uint32_t child) {
    return *reinterpret_cast<const Block*>(bvh.storage.data() + (child & ~leaf_bit));
}

/// Starts to fetch a child, so that it is there by its turn. A cache line has 64 bytes, and often two are
/// fetched together: if a StorageUnit is such a pair, its first half is enough.
template <typename Block>
void prefetch(const WideBvh<Block>& bvh, std::uint32_t child) {
    const std::byte* const begin = bvh.storage[child & ~leaf_bit].bytes;
    for (std::size_t byte = 0; byte < sizeof(Block); byte += std::max(sizeof(StorageUnit), std::size_t(64)))
        __builtin_prefetch(begin + byte);
}

/// A ray prepared for nodes. `near_offset` says which planes it hits first, as a distance in bytes from the
/// begin of a node: to choose the vectors once per ray is cheaper than to swap numbers once per box.
struct WideRay {
    FloatN origin[3];
    FloatN inverse_direction[3]; ///< plus or minus infinity along an axis on which the ray stands still
    FloatN padded_inverse_direction[3]; ///< larger by four roundings: exits move out (Ize 2013)
    std::uintptr_t near_offset[3];
    FloatN t_min;
};

[[gnu::always_inline]] inline WideRay wide_ray(const RayLike auto& ray) {
    const vec3 inverse = 1.0f / ray.direction;
    WideRay wide;
    for (int axis = 0; axis < 3; ++axis) {
        wide.origin[axis] = broadcast(ray.origin[axis]);
        wide.inverse_direction[axis] = broadcast(inverse[axis]);
        wide.padded_inverse_direction[axis] = broadcast(inverse[axis] * (1 + 0x1p-21f));
        wide.near_offset[axis] = sizeof(FloatN) * std::size_t(2 * axis + (inverse[axis] >= 0 ? 0 : 1));
    }
    wide.t_min = broadcast(ray.t_min);
    return wide;
}

/// The slab test (Kay and Kajiya 1986) for the N boxes of a node: returns those that the ray enters, and sets
/// `t_near` to the t of each entry. A ray in the plane of a face gives NaN: the order of the operands keeps
/// the other number.
[[gnu::always_inline]] inline unsigned intersect_children(const WideNode& node, const WideRay& ray,
                                                          FloatN t_max, FloatN& t_near) {
    const auto planes = [](std::uintptr_t address) { return *reinterpret_cast<const FloatN*>(address); };
    const auto begin = reinterpret_cast<std::uintptr_t>(&node);
    const auto [x, y, z] =
        std::array{begin + ray.near_offset[0], begin + ray.near_offset[1], begin + ray.near_offset[2]};
    const std::uintptr_t far = sizeof(FloatN); // minima and maxima are neighbours: one bit of the address
    const FloatN near_x = (planes(x) - ray.origin[0]) * ray.inverse_direction[0];
    const FloatN near_y = (planes(y) - ray.origin[1]) * ray.inverse_direction[1];
    const FloatN near_z = (planes(z) - ray.origin[2]) * ray.inverse_direction[2];
    const FloatN far_x = (planes(x ^ far) - ray.origin[0]) * ray.padded_inverse_direction[0];
    const FloatN far_y = (planes(y ^ far) - ray.origin[1]) * ray.padded_inverse_direction[1];
    const FloatN far_z = (planes(z ^ far) - ray.origin[2]) * ray.padded_inverse_direction[2];
    t_near = max(near_x, max(near_y, max(near_z, ray.t_min)));
    return less_equal(t_near, min(far_x, min(far_y, min(far_z, t_max))));
}

/// No path down a tree is longer: 48 levels of splits by cost and 28 of halving.
inline constexpr std::size_t max_depth = 80;

} // namespace rt::accel
