// Random numbers per sample and pixel: the same on every machine, in every order, on any thread.
#pragma once

#include "common/math/vec.h"

#include <concepts>
#include <cstdint>

namespace rt {

/// A source of uniform random numbers in [0, 1), one or two at a time. Sampling code needs nothing else.
template <typename T>
concept RandomSource = requires(T& source) {
    { source.get_1d() } -> std::same_as<float>;
    { source.get_2d() } -> std::same_as<vec2>;
};

/// The finaliser of SplitMix64 (Steele, Lea and Flood, OOPSLA 2014): a bijection that mixes all 64 bits.
constexpr std::uint64_t mix64(std::uint64_t bits) {
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
}

/// A stream of uniform random numbers. Its state is derived from a key alone, so pixels share no stream
/// and threads need no lock.
class Random {
  public:
    explicit constexpr Random(std::uint64_t key) : state(mix64(key)) {}

    /// Starts the stream of sample `sample` of pixel (x, y): x, y in [0, 2^20), sample in [0, 2^24).
    constexpr Random(int x, int y, int sample, std::uint64_t seed)
        : Random(mix64(seed) ^ (std::uint64_t(y) << 44 | std::uint64_t(x) << 24 | std::uint64_t(sample))) {}

    /// Returns 64 random bits: SplitMix64, a counter with an odd step, mixed.
    constexpr std::uint64_t bits() { return mix64(state += 0x9e3779b97f4a7c15u); }

    /// Returns a number in [0, 1) with 24 bits, the precision of a float, so that it never rounds up to 1.
    constexpr float get_1d() { return float(bits() >> 40) * 0x1p-24f; }

    /// Returns a point in the unit square [0, 1)^2.
    vec2 get_2d() {
        const float x = get_1d(); // two statements: C++ does not define the evaluation order of arguments
        const float y = get_1d();
        return {x, y};
    }

  private:
    std::uint64_t state;
};
static_assert(RandomSource<Random>);

} // namespace rt
