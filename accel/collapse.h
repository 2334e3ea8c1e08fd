// Collapses a binary tree into a wide one, in the way that costs a ray least.
#pragma once

#include "accel/wide_bvh.h"
#include "common/util/huge_page_vector.h"
#include "common/util/parallel.h"

#include <array>
#include <cstring>
#include <new>

namespace rt::accel {

/// A node of the binary tree; a leaf has no children. If it becomes a child of a wide node, then its subtree
/// becomes `nodes` wide nodes and `leaves` blocks.
struct alignas(64) BinaryNode {
    Bounds bounds;
    BinaryNode* children = nullptr; ///< two, next to each other
    std::uint32_t first = 0,
                  count = 0; ///< if its primitives fit into one block: where they are in the order of all
    std::uint32_t nodes = 0, leaves = 1;
    std::array<std::uint8_t, simd_width - 1> left_slots{}; ///< of k slots; 0: the same as with k - 1
};

/// Lane k - 1: the least cost of a subtree if it may occupy k child slots of a wide node above it, and how
/// many wide nodes and blocks it then becomes. k = simd_width never occurs: the sibling needs a slot too.
struct CollapseCost {
    FloatN cost;
    IntN nodes, leaves;
};

/// Returns the cost of the primitives of a node as one block.
inline CollapseCost leaf_cost(const BinaryNode& node) {
    return {broadcast(half_area(node.bounds)), IntN{}, IntN{} + 1};
}

/// Returns the concatenation of both vectors, shifted: lane i is lane i - count of the second one.
template <typename Vector>
Vector shift_lanes(const std::array<Vector, 2>& vectors, int count) {
    Vector shifted;
    const float* const second = reinterpret_cast<const float*>(vectors.data()) + simd_width;
    std::memcpy(&shifted, second - count, sizeof shifted);
    return shifted;
}

/// Ylitie, Karras and Laine 2017, section 3.2 ("Efficient Incoherent Ray Traversal on GPUs Through Compressed
/// Wide BVHs"): of all ways to collapse the tree, the least sum of areas, since the probability that a ray
/// visits a node is proportional to its area. A subtree with k slots distributes them among its children, or
/// takes one: as a block, or as a node of its own, which has all slots for what is below. Computed for all k
/// together, since the sums are the same.
inline CollapseCost collapse_cost(BinaryNode& node, const CollapseCost& left, const CollapseCost& right) {
    const std::array<FloatN, 2> right_cost{broadcast(infinity), right.cost};
    const std::array<IntN, 2> right_nodes{IntN{}, right.nodes}, right_leaves{IntN{}, right.leaves};
    FloatN cost = broadcast(infinity); // stays, with one slot for the left child, if all areas overflow
    IntN nodes = left.nodes[0] + shift_lanes(right_nodes, 1);
    IntN leaves = left.leaves[0] + shift_lanes(right_leaves, 1);
    IntN left_slots = IntN{} + 1;
    for (int slots = 1; slots < simd_width; ++slots) { // for the left child
        const FloatN sum = left.cost[slots - 1] + shift_lanes(right_cost, slots);
        const IntN better = sum < cost;
        cost = select(better, sum, cost);
        nodes = select(better, left.nodes[slots - 1] + shift_lanes(right_nodes, slots), nodes);
        leaves = select(better, left.leaves[slots - 1] + shift_lanes(right_leaves, slots), leaves);
        left_slots = select(better, IntN{} + slots, left_slots);
    }
    constexpr int all = simd_width - 1; // the lane of all slots
    CollapseCost result = leaf_cost(node);
    if (node.count == 0) result = {result.cost + cost[all], IntN{} + nodes[all] + 1, IntN{} + leaves[all]};
    node.nodes = std::uint32_t(result.nodes[0]);
    node.leaves = std::uint32_t(result.leaves[0]);
    node.left_slots[0] = std::uint8_t(left_slots[all]);
    for (int k = 1; k < all; ++k) {
        const bool better = cost[k] < result.cost[k - 1];
        result.cost[k] = better ? cost[k] : result.cost[k - 1];
        result.nodes[k] = better ? nodes[k] : result.nodes[k - 1];
        result.leaves[k] = better ? leaves[k] : result.leaves[k - 1];
        node.left_slots[std::size_t(k)] = better ? std::uint8_t(left_slots[k]) : std::uint8_t(0);
    }
    return result;
}

/// The binary nodes that become children of a wide one. Small boxes first: of two that a shadow ray enters,
/// the smaller one is likelier to be full.
struct WideChildren {
    std::array<const BinaryNode*, simd_width> nodes;
    std::array<float, simd_width> areas;
    std::size_t count = 0;

    explicit WideChildren(const BinaryNode& parent) { distribute(parent, simd_width, parent.left_slots[0]); }

    /// Gives `left_slots` of the slots to the left child and its subtree, the others to the right one.
    void distribute(const BinaryNode& parent, std::size_t slots, std::size_t left_slots) {
        fill(parent.children[0], left_slots);
        fill(parent.children[1], slots - left_slots);
    }
    void fill(const BinaryNode& below, std::size_t slots) {
        while (slots > 1 && below.left_slots[slots - 1] == 0) --slots;
        if (slots == 1 || !below.children) return insert(below);
        distribute(below, slots, below.left_slots[slots - 1]);
    }
    void insert(const BinaryNode& child) {
        const float area = half_area(child.bounds);
        std::size_t slot = count++;
        for (; slot > 0 && areas[slot - 1] > area; --slot) {
            nodes[slot] = nodes[slot - 1];
            areas[slot] = areas[slot - 1];
        }
        nodes[slot] = &child;
        areas[slot] = area;
    }
};

/// Returns a wide node with the bounds of its children.
inline WideNode make_wide_node(const WideChildren& children) {
    WideNode wide{};
    for (std::size_t lane = 0; lane < simd_width; ++lane) {
        const Bounds bounds = lane < children.count ? children.nodes[lane]->bounds : Bounds{};
        for (int axis = 0; axis < 3; ++axis) {
            wide.bounds[axis][0][lane] = bounds.min[axis];
            wide.bounds[axis][1][lane] = bounds.max[axis];
        }
    }
    return wide;
}

/// Writes the wide tree into its storage: every node is followed by its children.
template <typename Block, typename StorePrimitive>
struct Collapser {
    const HugePageVector<std::uint32_t>& primitive_indices;
    HugePageVector<StorageUnit>& storage;
    const StorePrimitive& store_primitive;

    /// Returns how many units the subtree takes.
    static std::size_t storage_size(const BinaryNode& node) {
        static_assert(sizeof(WideNode) % sizeof(StorageUnit) == 0 &&
                      sizeof(Block) % sizeof(StorageUnit) == 0);
        return (node.nodes * sizeof(WideNode) + node.leaves * sizeof(Block)) / sizeof(StorageUnit);
    }

    /// Writes the subtree of `node` from unit `unit` on; returns its value in WideNode::children.
    std::uint32_t emit(const BinaryNode& node, std::size_t unit) const {
        if (node.count > 0) {
            Block& block = *new (&storage[unit]) Block{};
            for (std::uint32_t k = 0; k < node.count; ++k)
                store_primitive(block, int(k), primitive_indices[node.first + k]);
            return std::uint32_t(unit) | leaf_bit;
        }
        const WideChildren children(node);
        WideNode& wide = *new (&storage[unit]) WideNode(make_wide_node(children));
        std::array<std::size_t, simd_width + 1> begin; // of each child
        begin[0] = unit + sizeof(WideNode) / sizeof(StorageUnit);
        for (std::size_t i = 0; i < children.count; ++i)
            begin[i + 1] = begin[i] + storage_size(*children.nodes[i]);
        const auto emit_some = [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) wide.children[i] = emit(*children.nodes[i], begin[i]);
        };
        if (node.leaves < 128)
            emit_some(0, children.count);
        else
            parallel_for(children.count, 1, emit_some);
        return std::uint32_t(unit);
    }
};

} // namespace rt::accel
