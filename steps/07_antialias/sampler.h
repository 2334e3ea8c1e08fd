// Sampler: the numbers that a sample of a pixel asks for, spread as evenly over the samples of the pixel as
// one likes.
#pragma once

#include "07_antialias/sample.h"
#include "07_antialias/sobol.h"
#include "common/options.h"
#include "common/random.h"
#include "common/render.h"

namespace rt {

enum class SamplerKind { random, stratified, sobol };

/// Use it in place of Random: each call takes the next dimension of the sample (uniform2() the next two, which
/// are even together). Over the samples of a pixel every dimension is spread evenly, and no dimension knows of
/// another: the samples go through each in an order of its own (padding: Kollig and Keller 2002). A dimension
/// is the number of the call, so samples that ask in the same order profit most.
class Sampler {
  public:
    Sampler(SamplerKind chosen, const Sample& sample)
        : kind(chosen), index(sample.index), count(sample.count), random(sample.random),
          pixel(sample.x, sample.y, 0, ~sample.seed) {}

    /// Plain random numbers.
    explicit Sampler(const Random& numbers) : random(numbers) {}

    /// A number in [0, 1).
    float uniform() {
        if (kind == SamplerKind::random) return random.uniform();
        const std::uint64_t key = pixel.bits();
        if (kind == SamplerKind::stratified)
            return stratified_number(permuted(index, count, key), count, random);
        return fraction(owen_scrambled(shuffled_index(key), high_half(key)));
    }

    /// A point in the unit square [0, 1)^2.
    vec2 uniform2() {
        if (kind == SamplerKind::random) return random.uniform2();
        const std::uint64_t key = pixel.bits();
        if (kind == SamplerKind::stratified)
            return stratified_point(permuted(index, count, key), count, random);
        const std::uint32_t i = shuffled_index(key);
        return {fraction(owen_scrambled(i, high_half(key))),
                fraction(owen_scrambled(sobol_second(i), high_half(pixel.bits())))};
    }

  private:
    static constexpr std::uint32_t high_half(std::uint64_t key) { return std::uint32_t(key >> 32); }

    /// Another order of the indices, in which any aligned 2^k of them stay an aligned 2^k.
    std::uint32_t shuffled_index(std::uint64_t key) const {
        return reversed_bits(owen_scrambled(reversed_bits(std::uint32_t(index)), std::uint32_t(key)));
    }

    SamplerKind kind = SamplerKind::random;
    int index = 0, count = 1;
    Random random;   ///< of this sample alone
    Random pixel{0}; ///< the keys of one dimension after another, the same for all samples of the pixel
};

/// Declares --sampler.
inline Choice<SamplerKind> sampler_knob(Options& options) {
    return options.choice("sampler", {"random", "stratified", "sobol"}, SamplerKind::sobol,
                          "how the samples of a pixel are spread: anywhere, one a cell, or as Sobol points, "
                          "which are even in cells of every shape");
}

} // namespace rt
