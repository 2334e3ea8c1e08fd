// A tree for speed: a row of boxes a node and a row of shapes a leaf, tested at once. The same idea as in bvh.h;
// what is new is how the numbers lie in memory.
#pragma once

#include "05_mesh_bvh/block.h"
#include "common/util/big_vector.h"
#include "common/math/row.h"
#include "common/util/ray_stats.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace rt {

/// A row of boxes, axis by axis, low planes before high ones; and what is in them. An empty lane's box is
/// inside out (low = infinity), so that no ray enters it.
struct alignas(2 * sizeof(Row)) WideNode {
    Row planes[3][2];
    std::array<std::uint32_t, lanes>
        child; ///< the line at which a node begins, or a block with the highest bit set
};

inline constexpr std::uint32_t block_bit = 0x80000000;

constexpr bool is_block(std::uint32_t child) {
    return (child & block_bit) != 0;
}

/// What memory is counted by: nodes and blocks are whole numbers of it.
struct alignas(WideNode) Line {
    std::byte bytes[alignof(WideNode)];
};

/// Nodes and blocks in one array, each beside its parent: what is needed next is near, one pointer reaches
/// all, and fetching ahead need not know which of the two it fetches. `Block` is TriangleBlock or
/// SphereBlock, or whatever has a prepare() and candidates() like theirs.
template <typename Block>
struct WideBvh {
    BigVector<Line> lines;             ///< none without shapes
    std::uint32_t root = 0;            ///< like a child
    std::size_t nodes = 0, blocks = 0; ///< how many there are
};

template <typename Block>
const WideNode& node_at(const WideBvh<Block>& bvh, std::uint32_t child) {
    return *reinterpret_cast<const WideNode*>(bvh.lines.data() + child);
}

template <typename Block>
const Block& block_at(const WideBvh<Block>& bvh, std::uint32_t child) {
    return *reinterpret_cast<const Block*>(bvh.lines.data() + (child & ~block_bit));
}

/// Starts fetching what a child refers to: by the time it is its turn, it is there. Memory comes in 64 bytes,
/// and often in pairs of these: where a Line is such a pair, its first half is enough.
template <typename Block>
void prefetch(const WideBvh<Block>& bvh, std::uint32_t child) {
    const std::byte* const begin = bvh.lines[child & ~block_bit].bytes;
    for (std::size_t byte = 0; byte < sizeof(Block); byte += std::max(sizeof(Line), std::size_t(64)))
        __builtin_prefetch(begin + byte);
}

/// A ray as the nodes want it. `near` tells which planes it meets first, as their distance in bytes from the
/// node's begin: choosing rows once a ray is cheaper than swapping numbers once a box.
struct WideRay {
    Row origin[3];
    Row inverse[3];     ///< 1 / direction; plus or minus infinity along an axis where the ray stands still
    Row inverse_out[3]; ///< larger by four roundings: exits move out, as in intersect() of aabb.h
    std::uintptr_t near[3];
    Row t_min;
};

[[gnu::always_inline]] inline WideRay wide_ray(const Ray& ray) {
    const vec3 inverse = 1.0f / ray.direction;
    WideRay wide;
    for (int axis = 0; axis < 3; ++axis) {
        wide.origin[axis] = row(ray.origin[axis]);
        wide.inverse[axis] = row(inverse[axis]);
        wide.inverse_out[axis] = row(inverse[axis] * (1 + 0x1p-21f));
        wide.near[axis] = sizeof(Row) * std::size_t(2 * axis + (inverse[axis] >= 0 ? 0 : 1));
    }
    wide.t_min = row(ray.t_min);
    return wide;
}

/// The slab test of aabb.h for a row of boxes: which ones the ray enters, and at which t. A plane in which the
/// ray lies gives NaN, and the order of the operands lets the other number through.
[[gnu::always_inline]] inline unsigned enter(const WideNode& node, const WideRay& ray, Row t_max, Row& t) {
    const auto plane = [](std::uintptr_t address) { return *reinterpret_cast<const Row*>(address); };
    const auto begin = reinterpret_cast<std::uintptr_t>(&node);
    const std::uintptr_t x = begin + ray.near[0], y = begin + ray.near[1], z = begin + ray.near[2];
    const std::uintptr_t other = sizeof(Row); // low and high planes lie side by side: one bit of the address
    const Row in_x = (plane(x) - ray.origin[0]) * ray.inverse[0];
    const Row in_y = (plane(y) - ray.origin[1]) * ray.inverse[1];
    const Row in_z = (plane(z) - ray.origin[2]) * ray.inverse[2];
    const Row out_x = (plane(x ^ other) - ray.origin[0]) * ray.inverse_out[0];
    const Row out_y = (plane(y ^ other) - ray.origin[1]) * ray.inverse_out[1];
    const Row out_z = (plane(z ^ other) - ray.origin[2]) * ray.inverse_out[2];
    t = greatest(in_x, greatest(in_y, greatest(in_z, ray.t_min)));
    return at_most(t, least(out_x, least(out_y, least(out_z, t_max))));
}

/// No path down a tree is longer: 48 levels of cuts and 28 of halving.
inline constexpr std::size_t wide_depth = 80;

/// What a ray has entered and not yet visited.
struct Waiting {
    std::uint32_t child;
    float t;
};

/// Puts the entry on the stack, below those from `begin` on that are nearer.
inline void insert(const Waiting* begin, Waiting*& top, Waiting entry) {
    Waiting* place = top++;
    for (; place > begin && place[-1].t < entry.t; --place) *place = place[-1];
    *place = entry;
}

/// Goes down from `child` to a block, always to the nearest box; the others that the ray enters wait. False
/// if a node is reached of which it enters none.
template <typename Block>
[[gnu::always_inline]] inline bool descend(const WideBvh<Block>& bvh, const WideRay& ray, Row t_max,
                                           Waiting*& top, std::uint32_t& child) {
    while (!is_block(child)) {
        const WideNode& node = node_at(bvh, child);
        ray_stats.box_tests += lanes;
        Row t_in;
        unsigned entered = enter(node, ray, t_max, t_in);
        if (entered == 0) return false;
        const std::size_t first = next_lane(entered);
        child = node.child[first];
        if (entered == 0) continue;
        prefetch(bvh, child);
        alignas(Row) float t[lanes];
        __builtin_memcpy(t, &t_in, sizeof t);
        Waiting nearest{child, t[first]};
        for (const Waiting* const begin = top; entered != 0;) {
            const std::size_t lane = next_lane(entered);
            Waiting entry{node.child[lane], t[lane]};
            prefetch(bvh, entry.child);
            if (entry.t < nearest.t) std::swap(entry, nearest);
            insert(begin, top, entry);
        }
        child = nearest.child;
    }
    return true;
}

/// Calls leaf(block, lane) for the shapes that the ray may meet, nearest boxes first. The leaf function says
/// where the ray meets the shape, if it does, and shortens `ray`; boxes beyond are then passed over.
template <typename Block, typename Leaf>
void nearest(const WideBvh<Block>& bvh, const Ray& ray, Leaf&& leaf) {
    if (bvh.lines.empty()) return;
    const WideRay wide = wide_ray(ray);
    const auto narrow = Block::prepare(ray);
    // A function of its own, so that it does not take the registers of the search.
    const auto test_all = [&](const Block& block, unsigned maybe) __attribute__((noinline)) {
        while (maybe != 0) leaf(block, next_lane(maybe));
    };
    std::array<Waiting, (lanes - 1) * wide_depth> stack; // a node leaves all children but one behind
    Waiting* top = stack.data();
    std::uint32_t child = bvh.root;
    while (true) {
        if (descend(bvh, wide, row(ray.t_max), top, child)) {
            const Block& block = block_at(bvh, child);
            ray_stats.triangle_tests += lanes;
            if (const unsigned maybe = candidates(block, narrow, ray.t_min, ray.t_max).maybe; maybe != 0)
                test_all(block, maybe);
        }
        do {
            if (top == stack.data()) return;
            --top;
        } while (top->t > ray.t_max);
        child = top->child;
    }
}

/// Whether the ray meets any shape at all; leaf(block, lane) decides where the block is not certain. It need not
/// know which child is nearer, so the stack holds nodes and the sets of their children that are not visited yet.
template <typename Block, typename Leaf>
bool any_hit(const WideBvh<Block>& bvh, const Ray& ray, Leaf&& leaf) {
    struct Lanes {
        const WideNode* node;
        unsigned entered;
    };
    if (bvh.lines.empty()) return false;
    const WideRay wide = wide_ray(ray);
    const auto narrow = Block::prepare(ray);
    // As above.
    const auto test_any = [&](const Block& block, unsigned maybe) __attribute__((noinline)) {
        while (maybe != 0)
            if (leaf(block, next_lane(maybe))) return true;
        return false;
    };
    const Row t_max = row(ray.t_max);
    std::array<Lanes, wide_depth> stack;
    Lanes* top = stack.data();
    std::uint32_t child = bvh.root;
    while (true) {
        if (is_block(child)) {
            const Block& block = block_at(bvh, child);
            ray_stats.triangle_tests += lanes;
            const Candidates found = candidates(block, narrow, ray.t_min, ray.t_max);
            if (found.certain != 0) return true;
            if (found.maybe != 0 && test_any(block, found.maybe)) return true;
        } else {
            ray_stats.box_tests += lanes;
            Row t;
            const WideNode& node = node_at(bvh, child);
            if (unsigned entered = enter(node, wide, t_max, t); entered != 0) {
                child = node.child[next_lane(entered)];
                if (entered != 0) *top++ = {&node, entered};
                continue;
            }
        }
        if (top == stack.data()) return false;
        --top;
        child = top->node->child[next_lane(top->entered)];
        if (top->entered != 0) ++top;
    }
}

} // namespace rt
