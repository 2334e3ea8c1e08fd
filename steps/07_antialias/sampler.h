// The sampler: draws the numbers of a pixel's samples at random, stratified, or from a Sobol sequence.
#pragma once

#include "07_antialias/stratified.h"
#include "07_antialias/sobol.h"
#include "common/math/random.h"
#include "common/render/render.h"

namespace rt {

enum class SamplerKind { random, stratified, sobol };

/// Use it instead of Random: each call takes the next dimension of the sample (get_2d() the next two, which
/// are evenly distributed together). Each dimension is evenly distributed over the samples of a pixel.
/// Dimensions are decorrelated by a random permutation of the samples for each (padding: Kollig and Keller
/// 2002). Samples that make their calls in the same order profit most.
class Sampler {
  public:
    Sampler(SamplerKind chosen, const PixelSample& sample)
        : kind(chosen), index(sample.index), count(sample.count), random(sample.random),
          dimension_key(sample.x, sample.y, 0, ~sample.seed) {}

    /// Plain random numbers.
    explicit Sampler(const Random& numbers) : random(numbers) {}

    /// Draws a number in [0, 1). In one dimension no points are more even than strata: Sobol adds nothing.
    float get_1d() {
        if (kind == SamplerKind::random) return random.get_1d();
        return stratified_1d(permutation_element(index, count, dimension_key.bits()), count, random);
    }

    /// Draws a point of the unit square [0, 1)^2.
    vec2 get_2d() {
        if (kind == SamplerKind::random) return random.get_2d();
        const int shuffled_index = permutation_element(index, count, dimension_key.bits());
        if (kind == SamplerKind::stratified) return stratified_2d(shuffled_index, count, random);
        return owen_sobol_2d(std::uint32_t(shuffled_index), dimension_key.bits());
    }

  private:
    SamplerKind kind = SamplerKind::random;
    int index = 0, count = 1;
    Random random;           ///< of this sample alone
    Random dimension_key{0}; ///< a key for one dimension after another, the same for all samples of the pixel
};

} // namespace rt
