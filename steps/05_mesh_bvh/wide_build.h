// How the wide tree is made: cut in two by the surface area heuristic until a block's worth of shapes is left,
// then fold the binary tree into wide nodes in the way that costs a ray least.
#pragma once

#include "05_mesh_bvh/wide_bvh.h"
#include "05_mesh_bvh/wide_cut.h"
#include "common/util/parallel.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <list>
#include <new>
#include <span>
#include <vector>

namespace rt {

/// A node of the binary tree; a leaf has no children. If it becomes a child of a wide node, it and all below
/// it become `nodes` wide nodes and `leaves` blocks.
struct alignas(64) BinaryNode {
    Aabb box;
    BinaryNode* children = nullptr;     ///< two, side by side
    std::uint32_t first = 0, count = 0; ///< if its shapes fit into one block, their place in the order of all
    std::uint32_t nodes = 0, leaves = 1;
    std::array<std::uint8_t, lanes - 1> share{}; ///< how many of k places go left; 0: as with k - 1
};

/// In lane k - 1: what folding a subtree costs if it may take k of the places of a node above, and how many
/// wide nodes and blocks it becomes. Nothing takes all places.
struct Weight {
    Row cost;
    IntRow nodes, leaves;
};

/// That of shapes in one block.
inline Weight block_weight(const BinaryNode& node) {
    return {row(half_area(node.box)), IntRow{}, IntRow{} + 1};
}

/// What stands `count` lanes before the second row.
template <typename Lanes>
Lanes before(const std::array<Lanes, 2>& rows, int count) {
    Lanes moved;
    std::memcpy(&moved, reinterpret_cast<const float*>(rows.data()) + lanes - count, sizeof moved);
    return moved;
}

/// Ylitie, Karras and Laine 2017, section 3.2 ("Efficient Incoherent Ray Traversal on GPUs Through Compressed
/// Wide BVHs"): of all ways to fold the tree, the least sum of areas, since a ray visits a node with a chance
/// in proportion to its area. With k places a subtree shares them between its children, or takes one: as a
/// block, or as a node of its own with all places below. All k at once, as the sharing is the same for each.
inline Weight weigh(BinaryNode& node, const Weight& left, const Weight& right) {
    const std::array<Row, 2> right_cost{row(infinity), right.cost};
    const std::array<IntRow, 2> right_nodes{IntRow{}, right.nodes}, right_leaves{IntRow{}, right.leaves};
    Row cost = row(infinity); // of sharing; this stays, with one place for the left, if all areas overflow
    IntRow nodes = left.nodes[0] + before(right_nodes, 1), leaves = left.leaves[0] + before(right_leaves, 1);
    IntRow share = IntRow{} + 1;
    for (int places = 1; places < lanes; ++places) { // for the left
        const Row shared = left.cost[places - 1] + before(right_cost, places);
        const IntRow better = shared < cost;
        cost = better ? shared : cost;
        nodes = better ? left.nodes[places - 1] + before(right_nodes, places) : nodes;
        leaves = better ? left.leaves[places - 1] + before(right_leaves, places) : leaves;
        share = better ? IntRow{} + places : share;
    }
    Weight own = block_weight(node);
    if (node.count == 0)
        own = {own.cost + cost[lanes - 1], IntRow{} + nodes[lanes - 1] + 1, IntRow{} + leaves[lanes - 1]};
    node.nodes = std::uint32_t(own.nodes[0]);
    node.leaves = std::uint32_t(own.leaves[0]);
    node.share[0] = std::uint8_t(share[lanes - 1]);
    for (int k = 1; k < lanes - 1; ++k) {
        const bool better = cost[k] < own.cost[k - 1];
        own.cost[k] = better ? cost[k] : own.cost[k - 1];
        own.nodes[k] = better ? nodes[k] : own.nodes[k - 1];
        own.leaves[k] = better ? leaves[k] : own.leaves[k - 1];
        node.share[std::size_t(k)] = better ? std::uint8_t(share[k]) : std::uint8_t(0);
    }
    return own;
}

/// Memory for a node that is not there yet.
struct alignas(BinaryNode) Slot {
    std::byte bytes[sizeof(BinaryNode)];
};

/// Room for the nodes of a subtree: its share of one array and, where a tree is a bad one, more.
struct Shelf {
    std::span<Slot> free;
    std::list<BigVector<Slot>> more;

    BinaryNode* two_nodes() {
        if (free.size() < 2) free = more.emplace_back(1024);
        Slot* const memory = free.data();
        free = free.subspan(2);
        new (memory + 1) BinaryNode;
        return new (memory) BinaryNode;
    }
    /// Gives away `part` in `all` of what is free.
    Shelf split(std::size_t part, std::size_t all) {
        const std::size_t kept = free.size() - free.size() * part / all;
        Shelf other{free.subspan(kept), {}};
        free = free.first(kept);
        return other;
    }
};

/// So many shapes are not cut any further in a tree over `all`. In a small one, which is soon built, these are
/// half a block: the fold joins them again where that is cheaper.
constexpr std::size_t uncut(std::size_t all) {
    return all < 4096 ? lanes / 2 : lanes;
}

/// Makes the binary tree. The fragments move from one array to the other at each cut; `order` gets their
/// numbers when they arrive in a leaf.
struct BinaryBuilder {
    BigVector<std::uint32_t>& order;
    std::array<BigVector<Fragment>, 2> fragments{BigVector<Fragment>(order.size()),
                                                 BigVector<Fragment>(order.size())};
    const std::size_t few = uncut(order.size());

    /// Makes a fragment of each shape; answers the range of all.
    template <typename BoundsOf>
    Range fill(const BoundsOf& bounds_of) {
        const Parts parts{0, order.size()};
        std::vector<Range> ranges(parts.count());
        parts.each([&](std::size_t part, std::size_t begin, std::size_t end) {
            Range range;
            for (std::size_t i = begin; i < end; ++i)
                add(range, fragments[0][i] = fragment(bounds_of(std::uint32_t(i)), std::uint32_t(i)));
            ranges[part] = range;
        });
        Range all{0, order.size(), {}, {}};
        for (const Range& range : ranges) {
            grow(all.box, range.box);
            grow(all.middles, range.middles);
        }
        return all;
    }

    /// Makes `node` the tree of the range, which lies in fragments[side].
    Weight build(BinaryNode& node, const Range& range, int side, int depth, Shelf& shelf) {
        node.box = {vec3(range.box.low[0], range.box.low[1], range.box.low[2]),
                    vec3(range.box.high[0], range.box.high[1], range.box.high[2])};
        const Fragment* const from = fragments[std::size_t(side)].data();
        Fragment* const to = fragments[std::size_t(1 - side)].data();
        if (range.count() <= lanes) {
            node.first = std::uint32_t(range.begin);
            node.count = std::uint32_t(range.count());
        }
        if (range.count() <= few) {
            for (std::size_t i = range.begin; i < range.end; ++i) order[i] = shape_of(from[i]);
            return block_weight(node);
        }
        node.children = shelf.two_nodes();
        const auto ranges = depth >= 48          ? halves(range, from, to)
                            : range.count() < 64 ? cut<8>(range, from, to) // for few half the bins do as well
                                                 : cut<16>(range, from, to);
        std::array<Weight, 2> weights;
        const auto build_child = [&](std::size_t i, Shelf& its) {
            weights[i] = build(node.children[i], ranges[i], 1 - side, depth + 1, its);
        };
        if (range.count() < 2048) { // a matter of 100 microseconds, too little to share
            build_child(0, shelf);
            build_child(1, shelf);
        } else {
            Shelf other = shelf.split(ranges[1].count(), range.count());
            both([&] { build_child(0, shelf); }, [&] { build_child(1, other); });
            shelf.more.splice(shelf.more.end(), other.more);
        }
        return weigh(node, weights[0], weights[1]);
    }
};

/// The binary nodes that become children of a wide one. Small boxes first: of two that a shadow ray enters,
/// the smaller one is likelier to be full.
struct Children {
    std::array<const BinaryNode*, lanes> node;
    std::array<float, lanes> size;
    std::size_t count = 0;

    explicit Children(const BinaryNode& parent) { share(parent, lanes, parent.share[0]); }

    /// Gives `left_places` of so many places to the left child and what is below it, the others to the right.
    void share(const BinaryNode& parent, std::size_t places, std::size_t left_places) {
        fill(parent.children[0], left_places);
        fill(parent.children[1], places - left_places);
    }
    void fill(const BinaryNode& below, std::size_t places) {
        while (places > 1 && below.share[places - 1] == 0) --places;
        if (places == 1 || !below.children) return insert(below);
        share(below, places, below.share[places - 1]);
    }
    void insert(const BinaryNode& child) {
        const float child_size = half_area(child.box);
        std::size_t place = count++;
        for (; place > 0 && size[place - 1] > child_size; --place) {
            node[place] = node[place - 1];
            size[place] = size[place - 1];
        }
        node[place] = &child;
        size[place] = child_size;
    }
};

/// A wide node with the boxes of its children.
inline WideNode node_around(const Children& children) {
    WideNode wide{};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Aabb box = lane < children.count ? children.node[lane]->box : Aabb{};
        for (int axis = 0; axis < 3; ++axis) {
            wide.planes[axis][0][lane] = box.min[axis];
            wide.planes[axis][1][lane] = box.max[axis];
        }
    }
    return wide;
}

/// Folds the binary tree into the wide one: every node is followed by its children.
template <typename Block, typename PutInto>
struct Folding {
    const BigVector<std::uint32_t>& order;
    BigVector<Line>& lines;
    const PutInto& put_into;

    static std::size_t lines_of(const BinaryNode& node) {
        static_assert(sizeof(WideNode) % sizeof(Line) == 0 && sizeof(Block) % sizeof(Line) == 0);
        return (node.nodes * sizeof(WideNode) + node.leaves * sizeof(Block)) / sizeof(Line);
    }

    /// Writes the tree below `node` from `line` on; answers what a WideNode's `child` says of it.
    std::uint32_t place(const BinaryNode& node, std::size_t line) const {
        if (node.count > 0) {
            Block& block = *new (&lines[line]) Block{};
            for (std::uint32_t k = 0; k < node.count; ++k) put_into(block, int(k), order[node.first + k]);
            return std::uint32_t(line) | block_bit;
        }
        const Children children(node);
        WideNode& wide = *new (&lines[line]) WideNode(node_around(children));
        std::array<std::size_t, lanes + 1> begin; // of each child's lines
        begin[0] = line + sizeof(WideNode) / sizeof(Line);
        for (std::size_t i = 0; i < children.count; ++i)
            begin[i + 1] = begin[i] + lines_of(*children.node[i]);
        const auto place_some = [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) wide.child[i] = place(*children.node[i], begin[i]);
        };
        if (node.leaves < 128)
            place_some(0, children.count);
        else
            in_ranges(children.count, 1, place_some);
        return std::uint32_t(line);
    }
};

/// The wide tree over shapes 0 to count - 1 (at most 2^29): bounds_of(i) is the box of shape i, and
/// put_into(block, lane, i) writes it into a block. The same shapes give the same tree, on any number of
/// threads.
template <typename Block, typename BoundsOf, typename PutInto>
WideBvh<Block> build_wide_bvh(std::size_t count, const BoundsOf& bounds_of, const PutInto& put_into) {
    WideBvh<Block> bvh;
    if (count == 0) return bvh;
    BinaryNode root;
    BigVector<Slot> nodes(4 * count / uncut(count)); // more than enough: most leaves are more than half full
    Shelf shelf{nodes, {}};
    BigVector<std::uint32_t> order(count);
    {
        BinaryBuilder builder{order};
        builder.build(root, builder.fill(bounds_of), 0, 0, shelf);
    }
    const Folding<Block, PutInto> folding{order, bvh.lines, put_into};
    bvh.nodes = root.nodes;
    bvh.blocks = root.leaves;
    bvh.lines.resize(folding.lines_of(root));
    bvh.root = folding.place(root, 0);
    return bvh;
}

} // namespace rt
