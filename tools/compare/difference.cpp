// Computes differences of pictures by pixels and by tiles, and the conclusion from them.
#include "tools/compare/difference.h"

#include "common/util/error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace rt::compare {
namespace {

std::string size_of(const Image& image) {
    return std::to_string(image.width) + " x " + std::to_string(image.height);
}

/// Returns the absolute difference per channel; infinite if one of the pixels is not finite, so that
/// it always counts.
vec3 distances(vec3 test, vec3 reference) {
    if (!is_finite(test) || !is_finite(reference)) return vec3(infinity);
    return abs(test - reference);
}

bool agree(vec3 distance, vec3 reference) {
    return all(lessThanEqual(distance, limits.tolerance * max(vec3(1.0f), abs(reference))));
}

/// Returns the variance that rounding to .hdr adds to a pixel's luminance. Each channel is rounded to 1/256
/// of the power of two above the largest one; a uniform error over a step has the variance step^2 / 12.
double rounding_variance(vec3 colour) {
    int exponent = 0;
    std::frexp(std::max({colour.x, colour.y, colour.z}), &exponent);
    const double step = std::ldexp(1.0, exponent - 8);
    constexpr double weights = 0.2126 * 0.2126 + 0.7152 * 0.7152 + 0.0722 * 0.0722;
    return weights * step * step / 12;
}

/// Sums over a tile.
struct Tile {
    int pixels = 0;
    double test = 0, reference = 0, test_variance = 0, reference_variance = 0, rounding = 0;

    /// Returns z. `ratio` is the ratio of the variances of test and reference over the whole picture. With
    /// few samples a rare bright path may have been missed, which makes the estimated variance too small, so
    /// the larger of the two estimates counts.
    double z(double ratio) const {
        const double variance = std::max(test_variance, ratio * reference_variance) +
                                std::max(reference_variance, ratio > 0 ? test_variance / ratio : 0);
        if (!std::isfinite(test - reference + variance)) return std::numeric_limits<double>::infinity();
        const double change = test - reference;
        if (variance > 0) return change / std::sqrt(variance + rounding);
        const double tolerance =
            pixels * limits.tolerance * std::max(1.0, reference / pixels); // this tile has no noise
        return std::abs(change) <= tolerance ? 0
                                             : std::copysign(std::numeric_limits<double>::infinity(), change);
    }
};

Tile sum_tile(int x0, int y0, const Image& test, const Image& reference, const Image& test_variance,
              const Image& reference_variance) {
    Tile tile;
    for (int y = y0; y < std::min(y0 + tile_side, test.height); ++y) {
        for (int x = x0; x < std::min(x0 + tile_side, test.width); ++x) {
            ++tile.pixels;
            tile.test += double(luminance(test(x, y)));
            tile.reference += double(luminance(reference(x, y)));
            tile.test_variance += double(test_variance(x, y).x);
            tile.reference_variance += double(reference_variance(x, y).x);
            tile.rounding += rounding_variance(test(x, y)) + rounding_variance(reference(x, y));
        }
    }
    return tile;
}

/// Returns the median over the tiles of the test's variance divided by the reference's: about the inverse
/// ratio of their numbers of samples.
double variance_ratio(const std::vector<Tile>& tiles) {
    std::vector<double> ratios;
    for (const Tile& tile : tiles)
        if (tile.test_variance > 0 && tile.reference_variance > 0)
            ratios.push_back(tile.test_variance / tile.reference_variance);
    if (ratios.empty()) return 0;
    std::sort(ratios.begin(), ratios.end());
    return std::sqrt(ratios[(ratios.size() - 1) / 2] *
                     ratios[ratios.size() / 2]); // geometric mean: swapping the pictures inverts the ratio
}

} // namespace

void check_same_size(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw Error("the pictures differ in size: " + size_of(a) + " and " + size_of(b));
}

bool agrees(vec3 test, vec3 reference) {
    return agree(distances(test, reference), reference);
}

std::string change_in_words(double test, double reference) {
    if (!std::isfinite(test)) return "not a number";
    std::ostringstream words;
    words.precision(3);
    if (std::abs(test - reference) <= 0.005 * std::abs(reference))
        return "equally bright, in a different colour";
    words << (test > reference ? "brighter" : "darker");
    const double low = std::min(test, reference), high = std::max(test, reference);
    if (low <= 0)
        return words.str() + (test > reference ? " where the reference is black" : " by 100 %, black");
    if (high >= 2 * low)
        words << " by a factor of " << high / low;
    else
        words << " by " << 100 * std::abs(test / reference - 1) << " %";
    return words.str();
}

double root_mean_square(const Image& test, const Image& reference) {
    check_same_size(test, reference);
    double sum = 0;
    for (std::size_t i = 0; i < test.pixels.size(); ++i) {
        const vec3 d = test.pixels[i] - reference.pixels[i];
        sum += double(dot(d, d));
    }
    return test.pixels.empty() ? 0 : std::sqrt(sum / (3 * double(test.pixels.size())));
}

int allowed_outliers(int tiles) {
    return std::max(1, int(limits.max_outlier_share * tiles));
}

Difference compare_pixels(const Image& test, const Image& reference) {
    check_same_size(test, reference);
    Difference result;
    result.pixels = test.pixels.size();
    double sum = 0, test_light = 0, reference_light = 0;
    for (std::size_t i = 0; i < result.pixels; ++i) {
        const vec3 distance = distances(test.pixels[i], reference.pixels[i]);
        const float largest = std::max({distance.x, distance.y, distance.z});
        sum += (double(distance.x) + double(distance.y) + double(distance.z)) / 3;
        test_light += double(luminance(test.pixels[i]));
        reference_light += double(luminance(reference.pixels[i]));
        if (!agree(distance, reference.pixels[i])) ++result.differing;
        if (largest <= result.largest) continue;
        result.largest = largest;
        result.x = int(i % std::size_t(test.width));
        result.y = int(i / std::size_t(test.width));
        result.test = test.pixels[i];
        result.reference = reference.pixels[i];
    }
    result.mean = result.pixels > 0 ? sum / double(result.pixels) : 0;
    result.mean_change = reference_light > 0 ? test_light / reference_light - 1 : 0;
    return result;
}

TileDifference compare_tiles(const Image& test, const Image& reference, const Image& test_variance,
                             const Image& reference_variance) {
    check_same_size(test, reference);
    check_same_size(test, test_variance);
    check_same_size(test, reference_variance);
    std::vector<Tile> tiles;
    for (int y = 0; y < test.height; y += tile_side)
        for (int x = 0; x < test.width; x += tile_side)
            tiles.push_back(sum_tile(x, y, test, reference, test_variance, reference_variance));
    const double ratio = variance_ratio(tiles);
    TileDifference result;
    result.columns = (test.width + tile_side - 1) / tile_side;
    for (const Tile& tile : tiles) {
        const double z = tile.z(ratio);
        const int index = result.tiles++;
        result.scores.push_back({z, tile.test / tile.pixels, tile.reference / tile.pixels});
        if (std::abs(z) > limits.outlier_z) ++result.outliers;
        if (std::abs(z) <= std::abs(result.largest_z)) continue;
        result.largest_z = z;
        result.x = index % result.columns * tile_side;
        result.y = index / result.columns * tile_side;
        result.test = tile.test / tile.pixels;
        result.reference = tile.reference / tile.pixels;
    }
    return result;
}

Conclusion conclude(const Difference& d, int step) {
    const double within = d.pixels > 0 ? 1 - double(d.differing) / double(d.pixels) : 1;
    const bool only_rounding = step > 0 && within >= limits.min_share_within_rounding &&
                               std::abs(d.mean_change) <= limits.max_mean_change_rounding;
    const bool same = (within >= limits.min_share_within || only_rounding) &&
                      d.mean <= limits.max_mean_difference; // false for NaN
    std::ostringstream words;
    words.precision(3);
    if (same) {
        words << "same picture (largest difference " << d.largest << ", mean " << d.mean << ")";
    } else {
        words << "different: " << d.differing << " of " << d.pixels << " pixels differ by more than "
              << limits.tolerance << ", largest " << d.largest << " at " << d.x << "," << d.y << ", "
              << change_in_words(double(luminance(d.test)), double(luminance(d.reference))) << " there; mean "
              << d.mean << ", the whole picture ";
        if (std::abs(d.mean_change) < 0.001)
            words << "equally bright";
        else
            words << 100 * std::abs(d.mean_change) << " % " << (d.mean_change > 0 ? "brighter" : "darker");
    }
    return {same, words.str()};
}

Conclusion conclude(const TileDifference& d) {
    const int allowed = allowed_outliers(d.tiles);
    const bool same = d.outliers <= allowed && std::abs(d.largest_z) <= limits.max_z;
    std::ostringstream words;
    words.precision(3);
    if (same) {
        words << "same picture up to noise (" << d.tiles << " tiles, largest z " << d.largest_z << ")";
    } else {
        words << "different: " << d.outliers << " of " << d.tiles
              << " tiles differ by more than noise explains (at most " << allowed << ", and none beyond z "
              << limits.max_z << "), largest z " << d.largest_z << " at " << d.x << "," << d.y << ", "
              << change_in_words(d.test, d.reference) << " there";
    }
    return {same, words.str()};
}

} // namespace rt::compare
