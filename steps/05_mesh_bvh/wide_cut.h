// How a set of shapes is cut in two by the surface area heuristic, on all threads if it is large.
#pragma once

#include "05_mesh_bvh/aabb.h"
#include "common/util/parallel.h"
#include "common/math/row.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace rt {

using Four = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));

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
    Four low, high;
};

inline Fragment fragment(const Aabb& box, std::uint32_t shape) {
    const float number = std::bit_cast<float>(shape | 0x40000000);
    return {Four{box.min.x, box.min.y, box.min.z, number}, Four{box.max.x, box.max.y, box.max.z, 0}};
}

inline std::uint32_t shape_of(const Fragment& fragment) {
    return std::bit_cast<std::uint32_t>(fragment.low[3]) & 0x3fffffff;
}

/// Twice the middle of the box: as good for telling left from right.
inline Four middle(const Fragment& fragment) {
    return fragment.low + fragment.high;
}

/// The fragments begin to end - 1, the box of all, and the box of their middles.
struct Range {
    std::size_t begin = 0, end = 0;
    FourBox box, middles;

    std::size_t count() const { return end - begin; }
};

inline void add(Range& range, const Fragment& fragment) {
    grow(range.box, {fragment.low, fragment.high});
    grow(range.middles, {middle(fragment), middle(fragment)});
}

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
    std::size_t left_count = 0;
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
            grow(boxes[axis][bin[axis]], {fragment.low, fragment.high});
            ++counts[axis][bin[axis]];
        }
    }

    void add(std::span<const Fragment> fragments, const Binning& binning) {
        for (const Fragment& fragment : fragments) add(fragment, binning(middle(fragment)));
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
            if (cost < best.cost) best = {axis, int(i), cost, shapes, left, right[i]};
        }
    }

    WideCut best(const Binning& binning, std::size_t total) const {
        WideCut best;
        for (int axis = 0; axis < 3; ++axis)
            if (binning.per_width[axis] > 0) sweep(axis, total, best);
        return best;
    }

    std::size_t left_of(const WideCut& cut) const {
        return std::accumulate(counts[cut.axis], counts[cut.axis] + cut.bin, std::size_t(0));
    }
};

/// The work on many fragments is done in parts, at the same time. How many parts does not depend on how many
/// threads there are, so neither does the tree.
struct Parts {
    std::size_t begin, end;

    std::size_t count() const { return std::clamp<std::size_t>((end - begin) / 4096, 1, 64); }
    std::size_t border(std::size_t part) const { return begin + (end - begin) * part / count(); }

    /// Calls work(part, its begin, its end) for each.
    template <typename Work>
    void each(const Work& work) const {
        in_ranges(count(), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t part = first; part < last; ++part) work(part, border(part), border(part + 1));
        });
    }
};

/// Moves fragments to both sides of a cut.
struct Partition {
    const Fragment* from;
    Fragment* to;
    const Binning& binning;
    const WideCut& cut;

    /// Those of begin to end - 1 that are left of the cut go to `low` and behind it, the others before
    /// `high`. Answers the boxes of both sides' middles.
    std::array<FourBox, 2> operator()(std::size_t begin, std::size_t end, std::size_t low,
                                      std::size_t high) const {
        FourBox left_middles, right_middles;
        for (std::size_t i = begin; i < end; ++i) {
            const Fragment fragment = from[i];
            const Four place = middle(fragment);
            const bool left = binning(place)[cut.axis] < cut.bin;
            high -= !left;
            to[left ? low : high] = fragment;
            low += left;
            const FourInts goes_left = FourInts{} - int(left);
            left_middles.low = least(goes_left ? place : left_middles.low, left_middles.low);
            left_middles.high = greatest(goes_left ? place : left_middles.high, left_middles.high);
            right_middles.low = least(goes_left ? right_middles.low : place, right_middles.low);
            right_middles.high = greatest(goes_left ? right_middles.high : place, right_middles.high);
        }
        return {left_middles, right_middles};
    }

    /// The same for all parts at once: the bins tell where each part's fragments go.
    template <int count>
    std::array<FourBox, 2> operator()(const Parts& parts, const std::vector<Bins<count>>& filled) const {
        std::vector<std::size_t> lefts(filled.size()); // of all parts before
        for (std::size_t part = 1; part < filled.size(); ++part)
            lefts[part] = lefts[part - 1] + filled[part - 1].left_of(cut);
        std::vector<std::array<FourBox, 2>> middles(filled.size());
        parts.each([&](std::size_t part, std::size_t begin, std::size_t end) {
            const std::size_t low = parts.begin + lefts[part];
            middles[part] = (*this)(begin, end, low, parts.end - (begin - low));
        });
        for (const auto& [left, right] : middles) {
            grow(middles[0][0], left);
            grow(middles[0][1], right);
        }
        return middles[0];
    }
};

/// The first half and the rest, as they lie.
inline std::array<Range, 2> halves(const Range& range, const Fragment* from, Fragment* to) {
    const std::size_t half = range.begin + range.count() / 2;
    std::array<Range, 2> parts{Range{range.begin, half, {}, {}}, Range{half, range.end, {}, {}}};
    for (Range& part : parts)
        for (std::size_t i = part.begin; i < part.end; ++i) add(part, to[i] = from[i]);
    return parts;
}

/// Cuts the range into two, which lie in the other array.
template <int count>
std::array<Range, 2> cut(const Range& range, const Fragment* from, Fragment* to) {
    const Binning binning(range.middles, count);
    const Parts parts{range.begin, range.end};
    Bins<count> all;
    std::vector<Bins<count>> filled(parts.count() == 1 ? 0 : parts.count());
    if (filled.empty()) {
        all.add({from + range.begin, range.count()}, binning);
    } else {
        parts.each([&](std::size_t part, std::size_t begin, std::size_t end) {
            filled[part].add({from + begin, end - begin}, binning);
        });
        for (const Bins<count>& some : filled) all.add(some);
    }
    const WideCut best = all.best(binning, range.count());
    if (best.axis < 0) return halves(range, from, to);
    const Partition partition{from, to, binning, best};
    const auto [left_middles, right_middles] =
        filled.empty() ? partition(range.begin, range.end, range.begin, range.end) : partition(parts, filled);
    const std::size_t middle = range.begin + best.left_count;
    return {Range{range.begin, middle, best.left, left_middles},
            Range{middle, range.end, best.right, right_middles}};
}

} // namespace rt
