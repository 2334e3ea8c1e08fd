// Splits a range of primitives by the binned surface area heuristic (Wald 2007), in parallel if it is large.
#pragma once

#include "accel/prim_ref.h"
#include "common/util/parallel.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace rt::accel {

/// Maps centroids to `bin_count` equal bins along each axis of their bounds.
struct BinMapping {
    Float4 min, scale;
    int last_bin;

    BinMapping(const Bounds4& centroid_bounds, int bin_count)
        : min(centroid_bounds.min), last_bin(bin_count - 1) {
        const Float4 size = centroid_bounds.max - centroid_bounds.min;
        scale = select(size > 0, (float(bin_count) * (1 - 0x1p-20f)) / size, Float4{});
    }
    /// Returns the bin on each axis; the comparisons also catch NaN, in infinite bounds.
    Int4 operator()(Float4 centroid) const {
        const Int4 bin = truncated((centroid - min) * scale);
        const Int4 last = Int4{} + last_bin;
        return select(bin < 0, Int4{}, select(bin > last, last, bin));
    }
};

/// References below bin `bin` along `axis` go left. Without an axis (-1) no split tells them apart.
struct BinnedSplit {
    int axis = -1;
    int bin = 0;
    float cost = infinity;
    std::size_t left_count = 0;
    Bounds4 left, right;
};

/// How many blocks this many primitives fill: the cost of a leaf, however full its last block is.
inline float leaf_blocks(std::size_t primitives) {
    return float((primitives + simd_width - 1) / simd_width);
}

template <int bin_count>
struct Bins {
    Bounds4 bounds[3][bin_count];
    std::uint32_t counts[3][bin_count] = {};

    void add(const PrimRef& ref, Int4 bin) {
        for (int axis = 0; axis < 3; ++axis) {
            extend(bounds[axis][bin[axis]], {ref.min, ref.max});
            ++counts[axis][bin[axis]];
        }
    }

    void add(std::span<const PrimRef> refs, const BinMapping& mapping) {
        for (const PrimRef& ref : refs) add(ref, mapping(centroid_times_two(ref)));
    }

    void add(const Bins& other) {
        for (int axis = 0; axis < 3; ++axis) {
            for (int bin = 0; bin < bin_count; ++bin) {
                extend(bounds[axis][bin], other.bounds[axis][bin]);
                counts[axis][bin] += other.counts[axis][bin];
            }
        }
    }

    /// Sweeps along the axis from both ends; `best` becomes the cheapest split if that is cheaper.
    void sweep(int axis, std::size_t total, BinnedSplit& best) const {
        std::array<Bounds4, bin_count> right;
        right[bin_count - 1] = bounds[axis][bin_count - 1];
        for (std::size_t i = bin_count - 1; i > 1; --i) {
            right[i - 1] = right[i];
            extend(right[i - 1], bounds[axis][i - 1]);
        }
        Bounds4 left;
        std::size_t count = 0;
        for (std::size_t i = 1; i < bin_count; ++i) {
            extend(left, bounds[axis][i - 1]);
            count += counts[axis][i - 1];
            if (count == 0 || count == total) continue;
            const float cost =
                half_area(left) * leaf_blocks(count) + half_area(right[i]) * leaf_blocks(total - count);
            if (cost < best.cost) best = {axis, int(i), cost, count, left, right[i]};
        }
    }

    BinnedSplit find_best_split(const BinMapping& mapping, std::size_t total) const {
        BinnedSplit best;
        for (int axis = 0; axis < 3; ++axis)
            if (mapping.scale[axis] > 0) sweep(axis, total, best);
        return best;
    }

    std::size_t left_count(const BinnedSplit& split) const {
        return std::accumulate(counts[split.axis], counts[split.axis] + split.bin, std::size_t(0));
    }
};

/// A large range is worked on in chunks, in parallel. How many chunks does not depend on how many threads
/// there are, so neither does the tree.
struct Chunks {
    std::size_t begin, end;

    std::size_t count() const { return std::clamp<std::size_t>((end - begin) / 4096, 1, 64); }
    std::size_t boundary(std::size_t chunk) const { return begin + (end - begin) * chunk / count(); }

    /// Calls work(chunk, the chunk's begin, the chunk's end) for each chunk.
    template <typename Work>
    void parallel_for_each(const Work& work) const {
        parallel_for(count(), 1, [&](std::size_t first, std::size_t last) {
            for (std::size_t chunk = first; chunk < last; ++chunk)
                work(chunk, boundary(chunk), boundary(chunk + 1));
        });
    }
};

/// Moves references to both sides of a split, from one array to another.
struct Partitioner {
    const PrimRef* from;
    PrimRef* to;
    const BinMapping& mapping;
    const BinnedSplit& split;

    /// Of begin to end - 1, those left of the split go to `left` and up, the others below `right`. Returns
    /// the bounds of both sides' centroids.
    std::array<Bounds4, 2> operator()(std::size_t begin, std::size_t end, std::size_t left,
                                      std::size_t right) const {
        Bounds4 left_bounds, right_bounds;
        for (std::size_t i = begin; i < end; ++i) {
            const PrimRef ref = from[i];
            const Float4 centroid = centroid_times_two(ref);
            const bool goes_left = mapping(centroid)[split.axis] < split.bin;
            right -= !goes_left;
            to[goes_left ? left : right] = ref;
            left += goes_left;
            const Int4 mask = Int4{} - int(goes_left);
            left_bounds.min = min(select(mask, centroid, left_bounds.min), left_bounds.min);
            left_bounds.max = max(select(mask, centroid, left_bounds.max), left_bounds.max);
            right_bounds.min = min(select(mask, right_bounds.min, centroid), right_bounds.min);
            right_bounds.max = max(select(mask, right_bounds.max, centroid), right_bounds.max);
        }
        return {left_bounds, right_bounds};
    }

    /// The same for all chunks in parallel: their bins say where the references of each go.
    template <int bin_count>
    std::array<Bounds4, 2> operator()(const Chunks& chunks, const std::vector<Bins<bin_count>>& bins) const {
        std::vector<std::size_t> lefts(bins.size()); // of all chunks before
        for (std::size_t chunk = 1; chunk < bins.size(); ++chunk)
            lefts[chunk] = lefts[chunk - 1] + bins[chunk - 1].left_count(split);
        std::vector<std::array<Bounds4, 2>> centroid_bounds(bins.size());
        chunks.parallel_for_each([&](std::size_t chunk, std::size_t begin, std::size_t end) {
            const std::size_t left = chunks.begin + lefts[chunk];
            centroid_bounds[chunk] = (*this)(begin, end, left, chunks.end - (begin - left));
        });
        for (const auto& [left, right] : centroid_bounds) {
            extend(centroid_bounds[0][0], left);
            extend(centroid_bounds[0][1], right);
        }
        return centroid_bounds[0];
    }
};

/// Splits the range into its first half and the rest, in the order in which they are.
inline std::array<PrimRange, 2> split_in_half(const PrimRange& range, const PrimRef* from, PrimRef* to) {
    const std::size_t half = range.begin + range.count() / 2;
    std::array<PrimRange, 2> parts{PrimRange{range.begin, half, {}, {}}, PrimRange{half, range.end, {}, {}}};
    for (PrimRange& part : parts)
        for (std::size_t i = part.begin; i < part.end; ++i) add(part, to[i] = from[i]);
    return parts;
}

/// Splits the range by the heuristic; both parts are moved to the other array.
template <int bin_count>
std::array<PrimRange, 2> split(const PrimRange& range, const PrimRef* from, PrimRef* to) {
    const BinMapping mapping(range.centroid_bounds, bin_count);
    const Chunks chunks{range.begin, range.end};
    Bins<bin_count> all;
    std::vector<Bins<bin_count>> bins(chunks.count() == 1 ? 0 : chunks.count());
    if (bins.empty()) {
        all.add({from + range.begin, range.count()}, mapping);
    } else {
        chunks.parallel_for_each([&](std::size_t chunk, std::size_t begin, std::size_t end) {
            bins[chunk].add({from + begin, end - begin}, mapping);
        });
        for (const Bins<bin_count>& some : bins) all.add(some);
    }
    const BinnedSplit best = all.find_best_split(mapping, range.count());
    if (best.axis < 0) return split_in_half(range, from, to);
    const Partitioner partition{from, to, mapping, best};
    const auto [left, right] =
        bins.empty() ? partition(range.begin, range.end, range.begin, range.end) : partition(chunks, bins);
    const std::size_t middle = range.begin + best.left_count;
    return {PrimRange{range.begin, middle, best.left, left}, PrimRange{middle, range.end, best.right, right}};
}

} // namespace rt::accel
