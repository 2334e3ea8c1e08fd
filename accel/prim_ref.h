// What the builder moves: references to primitives, bounds and an index in two registers; and ranges of them.
#pragma once

#include "accel/ray.h"
#include "accel/simd.h"

#include <bit>
#include <cstddef>
#include <cstdint>

namespace rt::accel {

/// Bounds as one register each. Lane 3 is not used.
struct Bounds4 {
    Float4 min = Float4{} + infinity;
    Float4 max = Float4{} - infinity;
};

inline void extend(Bounds4& bounds, const Bounds4& other) {
    bounds.min = min(bounds.min, other.min);
    bounds.max = max(bounds.max, other.max);
}

inline float half_area(const Bounds4& bounds) {
    const Float4 size = max(bounds.max - bounds.min, Float4{});
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

/// The bounds of a primitive. Lane 3 of `min` holds its index as raw bits, below 2^30. Bit 30 is set
/// so that the pattern is a normal float: arithmetic on the whole register stays fast. The value of
/// that lane is never used.
struct PrimRef {
    Float4 min, max;
};

inline PrimRef prim_ref(const Bounds& bounds, std::uint32_t index) {
    const float lane_3 = std::bit_cast<float>(index | 0x40000000);
    return {Float4{bounds.min.x, bounds.min.y, bounds.min.z, lane_3},
            Float4{bounds.max.x, bounds.max.y, bounds.max.z, 0}};
}

inline std::uint32_t primitive_index(const PrimRef& ref) {
    return std::bit_cast<std::uint32_t>(ref.min[3]) & 0x3fffffff;
}

/// Comparing centroids does not need the division.
inline Float4 centroid_times_two(const PrimRef& ref) {
    return ref.min + ref.max;
}

/// The references begin to end - 1, and the bounds of all of them and of their centroids (times two).
struct PrimRange {
    std::size_t begin = 0, end = 0;
    Bounds4 bounds, centroid_bounds;

    std::size_t count() const { return end - begin; }
};

inline void add(PrimRange& range, const PrimRef& ref) {
    const Float4 centroid = centroid_times_two(ref);
    extend(range.bounds, {ref.min, ref.max});
    extend(range.centroid_bounds, {centroid, centroid});
}

} // namespace rt::accel
