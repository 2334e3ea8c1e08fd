// How the wide tree is made: cut in two by the surface area heuristic until eight shapes are left, then fold
// the binary tree into nodes of eight children in the way that costs a ray least.
#pragma once

#include "05_mesh_bvh/box.h"
#include "05_mesh_bvh/wide_bvh.h"
#include "common/parallel.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <vector>

namespace rt {

using Four = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));

inline Four least(Four a, Four b) {
    return a < b ? a : b;
}
inline Four greatest(Four a, Four b) {
    return a > b ? a : b;
}

/// A box as one register for each end. The fourth lane counts for nothing.
struct FourBox {
    Four low = Four{} + infinity;
    Four high = Four{} - infinity;
};

inline void grow(FourBox& box, const FourBox& other) {
    box.low = least(box.low, other.low);
    box.high = greatest(box.high, other.high);
}

inline float half_area(const FourBox& box) {
    const Four size = greatest(box.high - box.low, Four{});
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

/// A shape on its way down the tree: its box, and in the fourth lane of `low` its number, dressed as an
/// ordinary float so that it can be computed with at no cost, and no sense.
struct Fragment {
    FourBox box;
};

inline Fragment fragment(const Box& box, std::uint32_t shape) {
    const float number = std::bit_cast<float>(shape | 0x40000000);
    return {{Four{box.low.x, box.low.y, box.low.z, number}, Four{box.high.x, box.high.y, box.high.z, 0}}};
}

inline std::uint32_t shape_of(const Fragment& fragment) {
    return std::bit_cast<std::uint32_t>(fragment.box.low[3]) & 0x3fffffff;
}

/// Twice the middle of the box: as good for telling left from right.
inline Four middle(const Fragment& fragment) {
    return fragment.box.low + fragment.box.high;
}

/// The fragments begin to end - 1, the box of all, and the box of their middles.
struct Range {
    std::size_t begin = 0, end = 0;
    FourBox box, middles;

    std::size_t count() const { return end - begin; }
};

/// `count` equal bins along each axis, over the box of the middles.
struct Binning {
    Four low, per_width;
    int last;

    Binning(const FourBox& middles, int count) : low(middles.low), last(count - 1) {
        const Four size = middles.high - middles.low;
        per_width = size > 0 ? (float(count) * (1 - 0x1p-20f)) / size : Four{};
    }
    /// The bin on each axis; the comparisons also catch what is not a number, in a box without end.
    FourInts operator()(Four place) const {
        const FourInts bin = __builtin_convertvector((place - low) * per_width, FourInts);
        const FourInts highest = FourInts{} + last;
        return bin < 0 ? FourInts{} : bin > highest ? highest : bin;
    }
};

/// Fragments left of bin `bin` along `axis` go left. Without an axis no cut tells them apart.
struct WideCut {
    int axis = -1;
    int bin = 0;
    float cost = infinity;
    FourBox left, right;
};

/// How many blocks so many shapes fill: what a leaf costs, however full its last block is.
inline float blocks_of(std::size_t shapes) {
    return float((shapes + lanes - 1) / lanes);
}

template <int count>
struct Bins {
    FourBox boxes[3][count];
    std::uint32_t counts[3][count] = {};

    void add(const Fragment& fragment, FourInts bin) {
        for (int axis = 0; axis < 3; ++axis) {
            grow(boxes[axis][bin[axis]], fragment.box);
            ++counts[axis][bin[axis]];
        }
    }

    void add(const Bins& other) {
        for (int axis = 0; axis < 3; ++axis) {
            for (int bin = 0; bin < count; ++bin) {
                grow(boxes[axis][bin], other.boxes[axis][bin]);
                counts[axis][bin] += other.counts[axis][bin];
            }
        }
    }

    /// Sweeps along the axis from both ends; `best` becomes the cheapest cut if that is cheaper.
    void sweep(int axis, std::size_t total, WideCut& best) const {
        std::array<FourBox, count> right;
        right[count - 1] = boxes[axis][count - 1];
        for (std::size_t i = count - 1; i > 1; --i) {
            right[i - 1] = right[i];
            grow(right[i - 1], boxes[axis][i - 1]);
        }
        FourBox left;
        std::size_t shapes = 0;
        for (std::size_t i = 1; i < count; ++i) {
            grow(left, boxes[axis][i - 1]);
            shapes += counts[axis][i - 1];
            if (shapes == 0 || shapes == total) continue;
            const float cost =
                half_area(left) * blocks_of(shapes) + half_area(right[i]) * blocks_of(total - shapes);
            if (cost < best.cost) best = {axis, int(i), cost, left, right[i]};
        }
    }
};

/// Of so many fragments two threads make short work. What they find does not depend on the order.
inline constexpr std::size_t many_fragments = 1 << 16;

template <int count>
Bins<count> fill_bins(std::span<const Fragment> fragments, const Binning& binning) {
    Bins<count> filled;
    if (fragments.size() < many_fragments) {
        for (const Fragment& fragment : fragments) filled.add(fragment, binning(middle(fragment)));
        return filled;
    }
    const std::size_t half = fragments.size() / 2;
    Bins<count> others;
    both([&] { filled = fill_bins<count>(fragments.first(half), binning); },
         [&] { others = fill_bins<count>(fragments.subspan(half), binning); });
    filled.add(others);
    return filled;
}

template <int count>
WideCut best_cut(std::span<const Fragment> fragments, const Binning& binning) {
    const Bins<count> filled = fill_bins<count>(fragments, binning);
    WideCut best;
    for (int axis = 0; axis < 3; ++axis)
        if (binning.per_width[axis] > 0) filled.sweep(axis, fragments.size(), best);
    return best;
}

/// A node of the binary tree, and what folding it into wide nodes would cost. A leaf has no children.
struct BinaryNode {
    Box box;
    std::uint32_t left = 0, right = 0;  ///< numbers of nodes
    std::uint32_t first = 0, count = 0; ///< a leaf's place in the order of the shapes
    std::array<float, 7> cost{};        ///< cost[k - 1]: if it may take k of the eight places of a node above
    std::array<std::uint8_t, 7> share{}; ///< how many of these go to the left child; 0: as with k - 1
};

/// Ylitie, Karras and Laine 2017, section 3.2 ("Efficient Incoherent Ray Traversal on GPUs Through Compressed
/// Wide BVHs"): of all ways to fold the tree, the least sum of areas, since a ray visits a node with a chance
/// in proportion to its area. With k places a subtree shares them between its children, or takes one as a
/// node of its own with eight places below.
inline void weigh(BinaryNode& node, const BinaryNode& left, const BinaryNode& right) {
    const auto shared = [&](std::size_t places) {
        std::pair<float, std::uint8_t> best{infinity, std::uint8_t(1)}; // which stays if all areas overflow
        for (std::size_t k = 1; k < places; ++k) {
            const float cost = left.cost[k - 1] + right.cost[places - k - 1];
            if (cost < best.first) best = {cost, std::uint8_t(k)};
        }
        return best;
    };
    std::tie(node.cost[0], node.share[0]) = shared(lanes);
    node.cost[0] += half_area(node.box);
    for (std::size_t places = 2; places <= 7; ++places) {
        const auto [cost, share] = shared(places);
        const bool better = cost < node.cost[places - 2];
        node.cost[places - 1] = better ? cost : node.cost[places - 2];
        node.share[places - 1] = better ? share : std::uint8_t(0);
    }
}

/// Makes the binary tree. The fragments move from one array to the other at each cut; `order` gets their
/// numbers when they arrive in a leaf.
struct BinaryBuilder {
    std::array<BigVector<Fragment>, 2> fragments;
    BigVector<std::uint32_t> order;

    /// The fragments begin to end - 1 of the first array.
    Range range_of(std::size_t begin, std::size_t end) const {
        Range range{begin, end, {}, {}};
        if (range.count() < many_fragments) {
            for (std::size_t i = begin; i < end; ++i) add(range, fragments[0][i]);
            return range;
        }
        Range others;
        both([&] { range = range_of(begin, begin + (end - begin) / 2); },
             [&] { others = range_of(begin + (end - begin) / 2, end); });
        grow(range.box, others.box);
        grow(range.middles, others.middles);
        range.end = end;
        return range;
    }
    static void add(Range& range, const Fragment& fragment) {
        grow(range.box, fragment.box);
        grow(range.middles, {middle(fragment), middle(fragment)});
    }

    /// Cuts the range, which lies in fragments[side], into two in the other array.
    std::array<Range, 2> cut(const Range& range, int side, bool halve) {
        const Fragment* const from = fragments[std::size_t(side)].data();
        Fragment* const to = fragments[std::size_t(1 - side)].data();
        const bool few = range.count() < 64; // for which half the bins do as well
        const Binning binning(range.middles, few ? 8 : 16);
        const std::span<const Fragment> all{from + range.begin, range.count()};
        const WideCut best = halve ? WideCut{} : few ? best_cut<8>(all, binning) : best_cut<16>(all, binning);
        if (best.axis < 0) return halves(range, from, to);
        std::size_t low = range.begin, high = range.end;
        FourBox left_middles, right_middles;
        for (std::size_t i = range.begin; i < range.end; ++i) {
            const Fragment fragment = from[i];
            const Four place = middle(fragment);
            const bool left = binning(place)[best.axis] < best.bin;
            to[low] = fragment; // to both sides, and only one moves on: no branch to guess
            to[high - 1] = fragment;
            low += left;
            high -= !left;
            const FourInts goes_left = FourInts{} - int(left);
            left_middles.low = least(goes_left ? place : left_middles.low, left_middles.low);
            left_middles.high = greatest(goes_left ? place : left_middles.high, left_middles.high);
            right_middles.low = least(goes_left ? right_middles.low : place, right_middles.low);
            right_middles.high = greatest(goes_left ? right_middles.high : place, right_middles.high);
        }
        return {Range{range.begin, low, best.left, left_middles},
                Range{low, range.end, best.right, right_middles}};
    }

    /// The first half and the rest, as they lie.
    static std::array<Range, 2> halves(const Range& range, const Fragment* from, Fragment* to) {
        const std::size_t half = range.begin + range.count() / 2;
        std::array<Range, 2> parts{Range{range.begin, half, {}, {}}, Range{half, range.end, {}, {}}};
        for (Range& part : parts)
            for (std::size_t i = part.begin; i < part.end; ++i) add(part, to[i] = from[i]);
        return parts;
    }

    /// Appends the tree of the range to `nodes`.
    void build(BigVector<BinaryNode>& nodes, const Range& range, int side, int depth) {
        const std::size_t own = nodes.size();
        BinaryNode node{{vec3(range.box.low[0], range.box.low[1], range.box.low[2]),
                         vec3(range.box.high[0], range.box.high[1], range.box.high[2])}};
        if (range.count() <= lanes) {
            for (std::size_t i = range.begin; i < range.end; ++i)
                order[i] = shape_of(fragments[std::size_t(side)][i]);
            node.first = std::uint32_t(range.begin);
            node.count = std::uint32_t(range.count());
            node.cost.fill(half_area(node.box));
            nodes.push_back(node);
            return;
        }
        nodes.push_back(node);
        const auto [left, right] = cut(range, side, depth >= 48);
        node.left = std::uint32_t(nodes.size());
        node.right = build_both(nodes, left, right, 1 - side, depth + 1);
        weigh(node, nodes[node.left], nodes[node.right]);
        nodes[own] = node;
    }

    /// Appends both trees, large ones at the same time, and answers the number of the right one's root.
    std::uint32_t build_both(BigVector<BinaryNode>& nodes, const Range& left, const Range& right, int side,
                             int depth) {
        if (left.count() + right.count() < std::max<std::size_t>(order.size() / 16, 16384)) {
            build(nodes, left, side, depth);
            const auto root = std::uint32_t(nodes.size());
            build(nodes, right, side, depth);
            return root;
        }
        BigVector<BinaryNode> others;
        both([&] { build(nodes, left, side, depth); }, [&] { build(others, right, side, depth); });
        const auto root = std::uint32_t(nodes.size());
        for (BinaryNode& node : others) {
            if (node.count == 0) {
                node.left += root;
                node.right += root;
            }
        }
        nodes.insert(nodes.end(), others.begin(), others.end());
        return root;
    }
};

/// Folds a binary tree into wide nodes.
struct Folding {
    const BigVector<BinaryNode>& binary;

    float size(std::uint32_t number) const { return half_area(binary[number].box); }

    /// The binary nodes that become children of a wide one. Small boxes first: of two that a shadow ray
    /// enters, the smaller one is likelier to be full.
    struct Children {
        std::array<std::uint32_t, lanes> number{};
        std::size_t count = 0;
    };
    void insert(std::uint32_t number, Children& children) const {
        std::size_t place = children.count++;
        for (; place > 0 && size(children.number[place - 1]) > size(number); --place)
            children.number[place] = children.number[place - 1];
        children.number[place] = number;
    }

    /// Shares `places` places between binary node `number` and what is below it.
    void share(std::uint32_t number, std::size_t places, Children& children) const {
        const BinaryNode& node = binary[number];
        while (places > 1 && node.share[places - 1] == 0) --places;
        if (places == 1 || node.count > 0) return insert(number, children);
        share(node.left, node.share[places - 1], children);
        share(node.right, places - node.share[places - 1], children);
    }
    Children children_of(const BinaryNode& node) const {
        Children children;
        share(node.left, node.share[0], children);
        share(node.right, lanes - node.share[0], children);
        return children;
    }

    /// How many wide nodes binary node `number` and all below it become.
    std::size_t count_nodes(std::uint32_t number) const {
        if (binary[number].count > 0) return 0;
        const Children children = children_of(binary[number]);
        std::size_t count = 1;
        for (std::size_t i = 0; i < children.count; ++i) count += count_nodes(children.number[i]);
        return count;
    }
};

/// Lays out the wide tree: every node is followed by its children.
template <typename Block>
struct Layout {
    struct Leaf {
        std::uint32_t line;   ///< where its block is to be
        std::uint32_t number; ///< of the binary leaf
    };
    const Folding& folding;
    BigVector<CacheLine>& lines;
    std::vector<Leaf> leaves;
    std::uint32_t next = 0; ///< the first line that is free

    /// Answers what a WideNode's `child` says of binary node `number`.
    std::uint32_t place(std::uint32_t number) {
        const std::uint32_t line = next;
        if (folding.binary[number].count > 0) {
            leaves.push_back({line, number});
            next += std::uint32_t(sizeof(Block) / sizeof(CacheLine));
            return line | block_bit;
        }
        const auto children = folding.children_of(folding.binary[number]);
        WideNode& node = *new (&lines[line]) WideNode;
        next += std::uint32_t(sizeof(WideNode) / sizeof(CacheLine));
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const Box box = lane < children.count ? folding.binary[children.number[lane]].box : Box{};
            for (int axis = 0; axis < 3; ++axis) {
                node.planes[axis][0][lane] = box.low[axis];
                node.planes[axis][1][lane] = box.high[axis];
            }
            node.child[lane] = lane < children.count ? place(children.number[lane]) : 0;
        }
        return line;
    }
};

/// The wide tree over shapes 0 to count - 1 (at most 2^29): bounds_of(i) is the box of shape i, and
/// put_into(block, lane, i) writes it into a block. The same shapes give the same tree, on any number of
/// threads.
template <typename Block, typename BoundsOf, typename PutInto>
WideBvh<Block> build_wide_bvh(std::size_t count, const BoundsOf& bounds_of, const PutInto& put_into) {
    WideBvh<Block> bvh;
    if (count == 0) return bvh;
    BigVector<BinaryNode> binary;
    binary.reserve(count / 3 + 1); // a leaf holds six shapes or more, as a rule
    BigVector<std::uint32_t> order;
    {
        BinaryBuilder builder;
        for (auto& fragments : builder.fragments) fragments.resize(count);
        builder.order.resize(count);
        in_ranges(count, 32768, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                builder.fragments[0][i] = fragment(bounds_of(std::uint32_t(i)), std::uint32_t(i));
        });
        builder.build(binary, builder.range_of(0, count), 0, 0);
        order = std::move(builder.order);
    }
    const Folding folding{binary};
    bvh.blocks =
        std::size_t(std::ranges::count_if(binary, [](const BinaryNode& node) { return node.count > 0; }));
    bvh.nodes = folding.count_nodes(0);
    bvh.lines.resize((bvh.nodes * sizeof(WideNode) + bvh.blocks * sizeof(Block)) / sizeof(CacheLine));
    Layout<Block> layout{folding, bvh.lines, {}};
    bvh.root = layout.place(0);
    in_ranges(layout.leaves.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const BinaryNode& leaf = binary[layout.leaves[i].number];
            Block& block = *new (&bvh.lines[layout.leaves[i].line]) Block{};
            for (std::uint32_t k = 0; k < leaf.count; ++k) put_into(block, int(k), order[leaf.first + k]);
        }
    });
    return bvh;
}

} // namespace rt
