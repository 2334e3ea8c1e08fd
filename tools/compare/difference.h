// The difference of two pictures, by pixels and by tiles: are they the same, or the same up to noise?
#pragma once

#include "tools/compare/limits.h"
#include "common/image/image.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rt::compare {

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

/// Eight by eight pixels.
inline constexpr int tile_side = 8;
struct TileScore {
    double z = 0;                   ///< positive where `test` is too bright
    double test = 0, reference = 0; ///< mean luminance
};

/// How far `test` lies from `reference` in units of what noise explains: 8 x 8 pixels at a time, z = sum(t -
/// r) / sqrt(sum(var_t + var_r)) on luminance. Each variance is the larger of two estimates: its own, and the
/// other picture's times the median ratio of the two.
struct TileDifference {
    int tiles = 0;
    int outliers = 0;     ///< |z| > limits.outlier_z
    double largest_z = 0; ///< the z of largest size, with its sign: positive where `test` is too bright
    int x = 0, y = 0;     ///< its top left pixel
    double test = 0, reference = 0; ///< mean luminance of that tile
    int columns = 0;                ///< tiles in a row
    std::vector<TileScore> scores;  ///< of every tile, row by row from the top left
};

/// One line for a person, and the answer for a program.
struct Conclusion {
    bool same = false;
    std::string words;
};

/// Throws Error if the sizes differ.
void check_same_size(const Image& a, const Image& b);

/// True if each channel differs by at most the tolerance, and neither pixel is NaN or infinite.
bool agrees(vec3 test, vec3 reference);

/// Both throw Error if the sizes differ. A variance picture holds, in its red channel, the variance of each
/// pixel's mean luminance, as Film::variance does.
Difference compare_pixels(const Image& test, const Image& reference);
TileDifference compare_tiles(const Image& test, const Image& reference, const Image& test_variance,
                             const Image& reference_variance);

/// Of the difference over all channels; not a number if one of the pictures holds such. Throws Error if the
/// sizes differ.
double root_mean_square(const Image& test, const Image& reference);

/// Outliers that are no reason to call a picture of this many tiles different.
int allowed_outliers(int tiles);

/// "brighter by 12 %", "darker by a factor of 3.14", "as bright but of another colour".
std::string change_in_words(double test, double reference);

Conclusion conclude(const Difference& difference);
Conclusion conclude(const TileDifference& difference);

} // namespace rt::compare
