// The difference of two pictures, by pixels and by tiles: are they the same, or the same up to noise?
#pragma once

#include "tools/compare/limits.h"
#include "common/image/image.h"

#include <cstddef>
#include <string>
#include <vector>

namespace rt::compare {

/// The difference of `test` from `reference`, by pixels.
struct Difference {
    std::size_t pixels = 0;
    std::size_t differing = 0;        ///< pixels with a channel beyond the tolerance, or not finite
    double mean = 0;                  ///< absolute difference, over all channels
    double mean_change = 0;           ///< relative change of the mean luminance: test / reference - 1
    float largest = 0;                ///< largest absolute difference of a channel
    int x = 0, y = 0;                 ///< the pixel of the largest difference
    vec3 test{0.0f}, reference{0.0f}; ///< the two values there
};

/// Width and height of a tile in pixels.
inline constexpr int tile_side = 8;
struct TileScore {
    double z = 0;                   ///< positive where `test` is too bright
    double test = 0, reference = 0; ///< mean luminance
};

/// The difference of `test` from `reference` relative to the noise, by tiles of 8 x 8 pixels: z = sum(t - r)
/// / sqrt(sum(var_t + var_r)) on luminance. Each variance is the larger of two estimates: its own, and the
/// other picture's times the median ratio of the two.
struct TileDifference {
    int tiles = 0;
    int outliers = 0;               ///< |z| > limits.outlier_z
    double largest_z = 0;           ///< the z with the largest |z|: positive where `test` is too bright
    int x = 0, y = 0;               ///< top left pixel of that tile
    double test = 0, reference = 0; ///< mean luminance of that tile
    int columns = 0;                ///< tiles per row
    std::vector<TileScore> scores;  ///< of every tile, row by row from the top left
};

/// The conclusion as a bool for programs and as one line for people.
struct Conclusion {
    bool same = false;
    std::string words;
};

/// Throws Error if the sizes differ.
void check_same_size(const Image& a, const Image& b);

/// Returns true if each channel differs by at most the tolerance, and neither pixel is NaN or infinite.
bool agrees(vec3 test, vec3 reference);

/// Compare two pictures, and throw Error if their sizes differ. A variance picture has, in its red channel,
/// the variance of each pixel's mean luminance, like Film::variance.
Difference compare_pixels(const Image& test, const Image& reference);
TileDifference compare_tiles(const Image& test, const Image& reference, const Image& test_variance,
                             const Image& reference_variance);

/// Returns the RMS difference over all channels; NaN if either picture contains NaN. Throws Error if
/// the sizes differ.
double root_mean_square(const Image& test, const Image& reference);

/// Returns how many outliers a picture of this many tiles may have and still count as the same.
int allowed_outliers(int tiles);

/// Returns "brighter by 12 %", "darker by a factor of 3.14", "equally bright, in a different colour".
std::string change_in_words(double test, double reference);

/// In the picture of a step (not 0) more pixels may differ if the picture is as bright as before.
Conclusion conclude(const Difference& difference, int step = 0);
Conclusion conclude(const TileDifference& difference);

} // namespace rt::compare
