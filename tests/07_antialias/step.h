// What the checks of samplers and pixels share: the samplers, their points, and a test of uniformity.
#pragma once

#include "07_antialias/sampler.h"
#include "common/render/render.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace rt {

inline const std::array kinds{SamplerKind::random, SamplerKind::stratified, SamplerKind::sobol};

inline std::string name(SamplerKind kind) {
    return std::array{"random", "stratified", "Sobol"}[std::size_t(kind)];
}

/// Returns the first 2D point of sample `index` of `count` in a pixel.
inline vec2 first_point(SamplerKind kind, int index, int count, int pixel, std::uint64_t seed) {
    return Sampler(kind, PixelSample{pixel, 0, index, count, Random(pixel, 0, index, seed), seed}).get_2d();
}

inline RenderSettings picture(int width, int height, int samples, std::uint64_t seed = 7) {
    RenderSettings wanted;
    wanted.width = width;
    wanted.height = height;
    wanted.samples = samples;
    wanted.seed = seed;
    return wanted;
}

/// Returns by how many standard deviations these counts deviate from a uniform distribution: Pearson's
/// chi-square, transformed to a normal variable by Wilson and Hilferty (1931).
inline double unevenness(const std::vector<int>& counts) {
    double sum = 0, chi_square = 0;
    for (const int count : counts) sum += count;
    const double expected = sum / double(counts.size()), freedom = double(counts.size()) - 1;
    for (const int count : counts) chi_square += (count - expected) * (count - expected) / expected;
    const double spread = 2 / (9 * freedom);
    return (std::cbrt(chi_square / freedom) - (1 - spread)) / std::sqrt(spread);
}

} // namespace rt
