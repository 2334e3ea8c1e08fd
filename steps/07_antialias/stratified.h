// Stratified samples: one per cell, the cells in a random order that differs from pixel to pixel.
#pragma once

#include "common/math/random.h"

#include <bit>
#include <cmath>

namespace rt {

/// Returns a random point in cell `index` of `count` of the unit square. All cells have the area 1 / count,
/// for any count: floor(sqrt(count)) rows divide the samples as evenly as possible, and the height of each is
/// its fraction.
inline vec2 stratified_2d(int index, int count, Random& random) {
    //> which cell of the square is this sample's own, and where in it does the sample lie?
    const int rows = int(std::sqrt(float(count)));
    const int row = int((std::int64_t(index) * rows + rows - 1) / count);
    const auto first_of = [&](int r) { return int(std::int64_t(r) * count / rows); };
    const int columns = first_of(row + 1) - first_of(row);
    const vec2 jitter = random.get_2d();
    const float x = (float(index - first_of(row)) + jitter.x) / float(columns);
    const float y = (float(first_of(row)) + jitter.y * float(columns)) / float(count);
    return min(vec2(x, y), vec2(0x1.fffffep-1f)); // the sums may round up to 1
    //< return vec2(0.5f);
}

/// Returns a random number in cell `index` of `count` of [0, 1).
inline float stratified_1d(int index, int count, Random& random) {
    return glm::min((float(index) + random.get_1d()) / float(count), 0x1.fffffep-1f);
}

/// Returns element `index` of a random permutation of 0 to count - 1, one permutation per key. Odd factors,
/// sums and shifted bits are one-to-one below a power of two; what lands beyond `count` is mapped again
/// (cycle walking: Black and Rogaway 2002; for the samples of a pixel: Kensler 2013, "Correlated
/// Multi-Jittered Sampling").
constexpr int permutation_element(int index, int count, std::uint64_t key) {
    const int bits = std::bit_width(std::uint32_t(count - 1));
    const std::uint32_t mask = (1u << bits) - 1;
    std::uint32_t i = std::uint32_t(index);
    do {
        for (int round = 0; round < 5; ++round) {
            const auto part = std::uint32_t(std::rotr(key, 13 * round));
            i = (i * (part | 1) + (part >> 8)) & mask;
            i ^= i >> ((bits + 1) / 2);
        }
    } while (i >= std::uint32_t(count));
    return int(i);
}

} // namespace rt
