// Where the samples of a pixel lie: anywhere, or each in its own cell.
#pragma once

#include "common/random.h"

#include <cmath>

namespace rt {

enum class Pattern { random, stratified };

/// Sample `index` of `count` somewhere in its own cell of the unit square. All cells have the area 1 / count,
/// for any count: floor(sqrt(count)) rows share the samples as evenly as they can, and each row is as high as
/// its share.
inline vec2 stratified_point(int index, int count, Random& random) {
    //> find the row and column of the cell, then a random point in it
    const int rows = int(std::sqrt(float(count)));
    const int row = int((std::int64_t(index) * rows + rows - 1) / count);
    const auto first_of = [&](int r) { return int(std::int64_t(r) * count / rows); };
    const int columns = first_of(row + 1) - first_of(row);
    const vec2 jitter = random.uniform2();
    const float x = (float(index - first_of(row)) + jitter.x) / float(columns);
    const float y = (float(first_of(row)) + jitter.y * float(columns)) / float(count);
    return min(vec2(x, y), vec2(0x1.fffffep-1f)); // the sums may round up to 1
    //< return vec2(0.5f);
}

/// A point of the unit square for sample `index` of `count`.
inline vec2 sample_point(Pattern pattern, int index, int count, Random& random) {
    if (pattern == Pattern::stratified) return stratified_point(index, count, random);
    return random.uniform2();
}

} // namespace rt
