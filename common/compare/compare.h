// Two questions to two pictures: are they the same, and are they the same up to noise?
#pragma once

#include "common/image.h"

#include <cstddef>
#include <string>

namespace rt {

/// What counts as the same picture. All limits stand here.
struct Limits {
    // Pictures of the same samples (steps 01 to 06): rounding and other compilers may differ, physics may
    // not.
    float tolerance = 1e-3f;     ///< a channel agrees within tolerance * max(1, value)
    double least_within = 0.999; ///< share of pixels whose channels all agree
    double largest_mean = 2e-4;  ///< of the absolute difference over all channels

    // Pictures of different samples (07, 08), tile by tile. Of tiles that differ by noise alone one in 16,000
    // lies beyond 4 and one in 150,000 beyond 4.5; a wrong picture lights whole regions.
    double alarm_z = 4;
    double never_z = 4.5;
    double most_alarms = 0.001; ///< share of the tiles, but one tile may always alarm
};
inline constexpr Limits limits{};

/// How far `test` lies from `reference`, pixel by pixel.
struct Difference {
    std::size_t pixels = 0;
    std::size_t differing = 0;        ///< pixels with a channel beyond the tolerance, or not finite
    double mean = 0;                  ///< absolute difference over all channels
    double mean_change = 0;           ///< of the luminance, test minus reference, relative to the reference
    float largest = 0;                ///< absolute difference of a channel
    int x = 0, y = 0;                 ///< where it is
    vec3 test{0.0f}, reference{0.0f}; ///< what stands there
};

/// How far `test` lies from `reference` in units of what noise explains: 8 x 8 pixels at a time, z = sum(t -
/// r) / sqrt(sum(var_t + var_r)) on luminance. Each variance is the larger of two estimates: its own, and the
/// other picture's times the median ratio of the two.
struct TileDifference {
    int tiles = 0;
    int alarms = 0;       ///< |z| > limits.alarm_z
    double largest_z = 0; ///< the z of largest size, with its sign: positive where `test` is too bright
    int x = 0, y = 0;     ///< its top left pixel
    double test = 0, reference = 0; ///< mean luminance of that tile
};

/// One line for a person, and the answer for a program.
struct Verdict {
    bool same = false;
    std::string words;
};

/// Both throw Error if the sizes differ. A variance picture holds, in its red channel, the variance of each
/// pixel's mean luminance, as Film::variance does.
Difference difference(const Image& test, const Image& reference);
TileDifference tile_difference(const Image& test, const Image& reference, const Image& test_variance,
                               const Image& reference_variance);

Verdict verdict(const Difference& difference);
Verdict verdict(const TileDifference& difference);

} // namespace rt
