// Builds a wide tree: a binary tree by the surface area heuristic, down to leaves of one block, is collapsed.
#pragma once

#include "accel/binned_sah.h"
#include "accel/collapse.h"

#include <array>
#include <list>
#include <new>
#include <span>
#include <vector>

namespace rt::accel {

/// Uninitialised storage for one BinaryNode.
struct alignas(BinaryNode) NodeStorage {
    std::byte bytes[sizeof(BinaryNode)];
};

/// Bump allocator for a subtree's nodes: a slice of one array, plus overflow chunks for unbalanced trees.
struct NodeArena {
    std::span<NodeStorage> unused;
    std::list<HugePageVector<NodeStorage>> overflow;

    BinaryNode* allocate_pair() {
        if (unused.size() < 2) unused = overflow.emplace_back(1024);
        NodeStorage* const memory = unused.data();
        unused = unused.subspan(2);
        new (memory + 1) BinaryNode;
        return new (memory) BinaryNode;
    }
    /// Cuts off part/all of what is unused, for another thread.
    NodeArena split(std::size_t part, std::size_t all) {
        const std::size_t kept = unused.size() - unused.size() * part / all;
        NodeArena other{unused.subspan(kept), {}};
        unused = unused.first(kept);
        return other;
    }
};

/// Returns the maximum leaf size of the binary tree over `all` primitives. In a small tree, which is built
/// quickly, it is half a block: collapsing joins leaves where that is cheaper.
constexpr std::size_t max_leaf_size(std::size_t all) {
    return all < 4096 ? simd_width / 2 : simd_width;
}

/// Builds the binary tree. The references move from one array to the other at each split; `primitive_indices`
/// gets their indices when they arrive in a leaf.
struct BinaryBuilder {
    HugePageVector<std::uint32_t>& primitive_indices;
    std::array<HugePageVector<PrimRef>, 2> refs{HugePageVector<PrimRef>(primitive_indices.size()),
                                                HugePageVector<PrimRef>(primitive_indices.size())};
    const std::size_t leaf_size = max_leaf_size(primitive_indices.size());

    /// Makes a reference to each primitive; returns the range of all.
    template <typename BoundsOf>
    PrimRange fill(const BoundsOf& primitive_bounds) {
        const Chunks chunks{0, primitive_indices.size()};
        std::vector<PrimRange> ranges(chunks.count());
        chunks.parallel_for_each([&](std::size_t chunk, std::size_t begin, std::size_t end) {
            PrimRange range;
            for (std::size_t i = begin; i < end; ++i)
                add(range, refs[0][i] = prim_ref(primitive_bounds(std::uint32_t(i)), std::uint32_t(i)));
            ranges[chunk] = range;
        });
        PrimRange all{0, primitive_indices.size(), {}, {}};
        for (const PrimRange& range : ranges) {
            extend(all.bounds, range.bounds);
            extend(all.centroid_bounds, range.centroid_bounds);
        }
        return all;
    }

    /// Makes `node` the tree of the range, which is in refs[side].
    CollapseCost build(BinaryNode& node, const PrimRange& range, int side, int depth, NodeArena& arena) {
        node.bounds = {vec3(range.bounds.min[0], range.bounds.min[1], range.bounds.min[2]),
                       vec3(range.bounds.max[0], range.bounds.max[1], range.bounds.max[2])};
        const PrimRef* const from = refs[std::size_t(side)].data();
        PrimRef* const to = refs[std::size_t(1 - side)].data();
        if (range.count() <= simd_width) {
            node.first = std::uint32_t(range.begin);
            node.count = std::uint32_t(range.count());
        }
        if (range.count() <= leaf_size) {
            for (std::size_t i = range.begin; i < range.end; ++i)
                primitive_indices[i] = primitive_index(from[i]);
            return leaf_cost(node);
        }
        node.children = arena.allocate_pair();
        const auto ranges = depth >= 48 ? split_in_half(range, from, to)
                            : range.count() < 64
                                ? split<8>(range, from, to) // half the bins suffice for few primitives
                                : split<16>(range, from, to);
        const auto costs = build_children(node, range, ranges, 1 - side, depth + 1, arena);
        return collapse_cost(node, costs[0], costs[1]);
    }

    std::array<CollapseCost, 2> build_children(const BinaryNode& node, const PrimRange& range,
                                               const std::array<PrimRange, 2>& ranges, int side, int depth,
                                               NodeArena& arena) {
        std::array<CollapseCost, 2> costs;
        const auto build_child = [&](std::size_t i, NodeArena& child_arena) {
            costs[i] = build(node.children[i], ranges[i], side, depth, child_arena);
        };
        if (range.count() < 2048) { // takes some 100 microseconds: too little to share
            build_child(0, arena);
            build_child(1, arena);
        } else {
            NodeArena other = arena.split(ranges[1].count(), range.count());
            parallel_invoke([&] { build_child(0, arena); }, [&] { build_child(1, other); });
            arena.overflow.splice(arena.overflow.end(), other.overflow);
        }
        return costs;
    }
};

/// Builds the wide tree over primitives 0 to count - 1 (at most 2^29): primitive_bounds(i) returns the bounds
/// of primitive i, and store_primitive(block, lane, i) writes it into a block. The same primitives give the
/// same tree, on any number of threads.
template <typename Block, typename BoundsOf, typename StorePrimitive>
WideBvh<Block> build_wide_bvh(std::size_t count, const BoundsOf& primitive_bounds,
                              const StorePrimitive& store_primitive) {
    WideBvh<Block> bvh;
    if (count == 0) return bvh;
    BinaryNode root;
    // More than enough: most leaves are more than half full.
    HugePageVector<NodeStorage> nodes(4 * count / max_leaf_size(count));
    NodeArena arena{nodes, {}};
    HugePageVector<std::uint32_t> primitive_indices(count);
    {
        BinaryBuilder builder{primitive_indices};
        builder.build(root, builder.fill(primitive_bounds), 0, 0, arena);
    }
    const Collapser<Block, StorePrimitive> collapser{primitive_indices, bvh.storage, store_primitive};
    bvh.node_count = root.nodes;
    bvh.leaf_count = root.leaves;
    bvh.storage.resize(collapser.storage_size(root));
    bvh.root = collapser.emit(root, 0);
    return bvh;
}

} // namespace rt::accel
