// Tests simple explanations for a difference.
// Each explanation is a common error together with the operation that undoes it. It is accepted only if the
// pictures differ as they are and agree after it.
#include "tools/compare/explain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <sstream>
#include <vector>

namespace rt::compare {
namespace {

/// An operation that undoes a common error in the test picture.
struct Hypothesis {
    std::string name;
    std::function<Image(const Image&)> undo;
    bool permutes = false; ///< moves pixels without changing their values
};

// ---- the common errors

/// Returns a hypothesis whose result has at (x, y) the value from(image, x, y).
template <typename From>
Hypothesis permuted(const std::string& name, From from) {
    return {name,
            [from](const Image& image) {
                Image result(image.width, image.height);
                for (int y = 0; y < image.height; ++y)
                    for (int x = 0; x < image.width; ++x) result(x, y) = from(image, x, y);
                return result;
            },
            true};
}

template <typename Change>
Hypothesis colour_mapped(const std::string& name, Change change) {
    return {name, [change](const Image& image) {
                Image result = image;
                for (vec3& pixel : result.pixels) pixel = change(pixel);
                return result;
            }};
}

std::vector<Hypothesis> permutations(bool square) {
    std::vector<Hypothesis> hypotheses{
        permuted("flipped left to right", [](const Image& i, int x, int y) { return i(i.width - 1 - x, y); }),
        permuted("flipped upside down", [](const Image& i, int x, int y) { return i(x, i.height - 1 - y); }),
        permuted("rotated by 180 degrees (flipped in x and y)",
                 [](const Image& i, int x, int y) { return i(i.width - 1 - x, i.height - 1 - y); })};
    if (square)
        hypotheses.push_back(
            permuted("rows and columns swapped", [](const Image& i, int x, int y) { return i(y, x); }));
    return hypotheses;
}

/// Returns errors in colour. A file with codes c is read as decoded(c); correct codes are encoded(linear).
std::vector<Hypothesis> colour_maps() {
    const auto power = [](float exponent) {
        return [exponent](vec3 c) { return pow(srgb_encoded(c), vec3(exponent)); };
    };
    return {colour_mapped("red and blue swapped", [](vec3 c) { return vec3(c.z, c.y, c.x); }),
            colour_mapped("the sRGB encoding is missing", srgb_encoded),
            colour_mapped("the sRGB encoding is done twice", srgb_decoded),
            colour_mapped("gamma 2.2 instead of sRGB", power(2.2f)),
            colour_mapped("a square root instead of sRGB", power(2))};
}

Hypothesis scaled(const std::string& name, float gain) {
    return colour_mapped(name, [gain](vec3 c) { return c * gain; });
}

// ---- agreement

bool agrees_with(const Hypothesis& hypothesis, const Intervals& test, const Intervals& reference,
                 Difference& left) {
    left = interval_distance({hypothesis.undo(test.low), hypothesis.undo(test.high)}, reference);
    return conclude(left).same;
}

/// Returns the variance after the operation, by error propagation: multiplied by the square
/// of its derivative.
Image variance_after(const Hypothesis& hypothesis, const Image& test, const Image& undone,
                     const Image& variance) {
    if (hypothesis.permutes) return hypothesis.undo(variance);
    Image brighter = test;
    for (vec3& pixel : brighter.pixels) pixel = pixel * 1.01f + 1e-4f;
    const Image brighter_undone = hypothesis.undo(brighter);
    Image result = variance;
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        const float slope = luminance(brighter_undone.pixels[i] - undone.pixels[i]) /
                            luminance(brighter.pixels[i] - test.pixels[i]);
        result.pixels[i] *= slope * slope;
    }
    return result;
}

struct Case {
    const EncodedImage& test;
    const EncodedImage& reference;
    const Variances& variances;
    Intervals test_intervals, reference_intervals;

    /// Returns how much of the difference is left after the operation, or nothing if it is too much.
    std::optional<double> residue(const Hypothesis& hypothesis) const {
        if (!variances.available()) {
            Difference left;
            if (!agrees_with(hypothesis, test_intervals, reference_intervals, left)) return {};
            return double(left.differing) + left.mean;
        }
        const Image undone = hypothesis.undo(test.image);
        const TileDifference left = compare_tiles(
            undone, reference.image, variance_after(hypothesis, test.image, undone, variances.test),
            variances.reference);
        if (!conclude(left).same) return {};
        return double(left.outliers);
    }
};

const Hypothesis as_it_is{"", [](const Image& image) { return image; }, true};

// ---- one gain

/// Returns whether a pixel gives information about a gain: it is neither black nor clipped at white.
bool informs(float test, float reference, Encoding test_encoding, Encoding reference_encoding) {
    const auto cut = [](float light, Encoding encoding) {
        return encoding == Encoding::png && light > 0.99f;
    };
    return test > 1e-3f && reference > 1e-3f && !cut(test, test_encoding) &&
           !cut(reference, reference_encoding);
}

/// Returns the median of reference / test, or nothing if too few pixels give information.
std::optional<double> exact_gain(const Case& c) {
    std::vector<float> ratios;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < c.test.image.pixels.size(); ++i) {
        const vec3 t = c.test.image.pixels[i], r = c.reference.image.pixels[i];
        const float test = std::max({t.x, t.y, t.z}), reference = std::max({r.x, r.y, r.z});
        if (test > 1e-3f || reference > 1e-3f) ++lit;
        if (informs(test, reference, c.test.encoding, c.reference.encoding))
            ratios.push_back(luminance(r) / luminance(t));
    }
    if (ratios.empty() || ratios.size() < lit / 5) return {};
    std::nth_element(ratios.begin(), ratios.begin() + std::ptrdiff_t(ratios.size() / 2), ratios.end());
    return double(ratios[ratios.size() / 2]);
}

/// Returns the gain that minimises the sum of z^2 over the tiles.
std::optional<double> noisy_gain(const Case& c) {
    const TileDifference tiles =
        compare_tiles(c.test.image, c.reference.image, c.variances.test, c.variances.reference);
    double both = 0, test = 0;
    for (const TileScore& tile : tiles.scores) {
        const double change = tile.test - tile.reference;
        if (change == 0 || !std::isfinite(tile.z)) continue;
        const double weight = tile.z * tile.z / (change * change); // 1 / variance
        both += weight * tile.test * tile.reference;
        test += weight * tile.test * tile.test;
    }
    if (!(both > 0) || !(test > 0)) return {};
    return both / test;
}

struct NamedGain {
    const char* name;
    double value;
};
constexpr double exact_pi = 3.14159265358979323846;
constexpr std::array<NamedGain, 6> named_gains{{{"pi", exact_pi},
                                                {"1/pi", 1 / exact_pi},
                                                {"2", 2},
                                                {"1/2", 0.5},
                                                {"4 pi", 4 * exact_pi},
                                                {"1/(4 pi)", 1 / (4 * exact_pi)}}};

/// Returns whether the picture varies. A constant picture fits any gain, which would mean nothing.
bool varies(const Image& image) {
    float low = infinity, high = 0;
    for (const vec3& pixel : image.pixels) {
        low = std::min(low, luminance(pixel));
        high = std::max(high, luminance(pixel));
    }
    return high - low > 0.05f * high;
}

std::vector<Hypothesis> gains(const Case& c) {
    const std::optional<double> gain = c.variances.available() ? noisy_gain(c) : exact_gain(c);
    if (!gain || !std::isfinite(*gain) || *gain <= 0) return {};
    for (const NamedGain& named : named_gains) // the error is the inverse of the gain that undoes it
        if (std::abs(*gain * named.value - 1) <= limits.named_gain)
            return {scaled(std::string("the whole picture times ") + named.name, float(1 / named.value))};
    if (!varies(c.reference.image) || std::abs(*gain - 1) < limits.min_gain) return {};
    std::ostringstream name;
    name.precision(3);
    name << "the whole picture times " << 1 / *gain;
    return {scaled(name.str(), float(*gain))};
}

// ---- half a pixel

/// Returns the weighted sum of each pixel and its neighbours along (dx, dy). The border pixels are repeated.
Image blurred(const Image& image, int dx, int dy, std::array<float, 3> weights) {
    Image result(image.width, image.height);
    const auto at = [&](int x, int y) {
        return image(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
    };
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            result(x, y) =
                weights[0] * at(x - dx, y - dy) + weights[1] * at(x, y) + weights[2] * at(x + dx, y + dy);
    return result;
}

constexpr std::array<float, 3> smoothing{0.25f, 0.5f, 0.25f};

/// Returns the picture blurred (sigma 1.7 pixels), so that the mean of two neighbours is the value half-way
/// between them. Lights are clamped to white, so that their edges do not dominate.
Image smoothed(Image image) {
    for (vec3& pixel : image.pixels) pixel = min(pixel, vec3(1.0f));
    for (int i = 0; i < 6; ++i) image = blurred(blurred(image, 1, 0, smoothing), 0, 1, smoothing);
    return image;
}

/// Shifts by half a pixel along (dx, dy), each -1, 0 or 1, by averaging with the neighbour.
Image half_shifted(const Image& image, int dx, int dy) {
    const Image x = dx == 0 ? image : blurred(image, dx, 0, {0, 0.5f, 0.5f});
    return dy == 0 ? x : blurred(x, 0, dy, {0, 0.5f, 0.5f});
}

/// Blurs as half_shifted() does, without the shift.
Image as_smooth(const Image& image, int dx, int dy) {
    const Image x = dx == 0 ? image : blurred(image, 1, 0, smoothing);
    return dy == 0 ? x : blurred(x, 0, 1, smoothing);
}

/// Returns the share of the difference that is left after the shift; 1 if there is no difference.
double exact_shift_residue(const Image& test, const Image& reference, int dx, int dy) {
    const Image right = as_smooth(reference, dx, dy);
    const double before = root_mean_square(as_smooth(test, dx, dy), right);
    return before > 0 ? root_mean_square(half_shifted(test, dx, dy), right) / before : 1;
}

/// Returns the share of outlier tiles that are left after the shift. Averaging neighbours hardly changes the
/// noise of a tile's sum.
double noisy_shift_residue(const Case& c, int dx, int dy) {
    const Variances& v = c.variances;
    const TileDifference before = compare_tiles(c.test.image, c.reference.image, v.test, v.reference);
    const TileDifference after = compare_tiles(half_shifted(c.test.image, dx, dy), c.reference.image,
                                               half_shifted(v.test, dx, dy), v.reference);
    return before.outliers > 0 ? double(after.outliers) / before.outliers : 1;
}

/// Returns "shifted half a pixel to the right and down", given the shift that undoes it. If the mean of a
/// pixel and its right neighbour is correct, the picture is too far to the right.
std::string shift_in_words(int dx, int dy) {
    std::string words = dx == 0 ? "" : dx > 0 ? "to the right" : "to the left";
    if (dy != 0) words += std::string(words.empty() ? "" : " and ") + (dy > 0 ? "down" : "up");
    return "shifted half a pixel " + words;
}

/// Shifts along one axis come first: if the picture varies little along the other axis, a diagonal shift fits
/// about as well.
constexpr std::array<std::array<int, 2>, 8> straight_then_diagonal{
    {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

/// Returns the shift that leaves the smallest difference, or "" if that is too large.
std::string shift(const Case& c) {
    const bool noisy = c.variances.available();
    const Image test = noisy ? Image() : smoothed(c.test.image);
    const Image reference = noisy ? Image() : smoothed(c.reference.image);
    std::string best;
    double least = noisy ? limits.max_shift_outliers : limits.max_shift_residue;
    for (const auto& [dx, dy] : straight_then_diagonal) {
        if (dx != 0 && dy != 0 && !best.empty() && best.find(" and ") == std::string::npos) break;
        const double left =
            noisy ? noisy_shift_residue(c, dx, dy) : exact_shift_residue(test, reference, dx, dy);
        if (left >= least) continue;
        least = left;
        best = shift_in_words(dx, dy);
    }
    return best;
}

bool finite(const Image& image) {
    return std::all_of(image.pixels.begin(), image.pixels.end(), [](vec3 pixel) { return is_finite(pixel); });
}

/// Returns the name of the first hypothesis that leaves the smallest difference.
std::string best_of(const Case& c, const std::vector<Hypothesis>& hypotheses) {
    std::string best;
    double least = infinity;
    for (const Hypothesis& hypothesis : hypotheses) {
        const std::optional<double> left = c.residue(hypothesis);
        if (!left || *left >= least) continue;
        least = *left;
        best = hypothesis.name;
    }
    return best;
}

} // namespace

std::string explanations_tried() {
    return "flipped, rows and columns swapped, red and blue swapped, sRGB encoding missing or done twice, "
           "gamma 2.2 or a square root instead of it, the whole picture scaled, shifted by half a pixel";
}

std::string explain(const EncodedImage& test, const EncodedImage& reference, const Variances& variances) {
    check_same_size(test.image, reference.image);
    if (!finite(test.image) || !finite(reference.image)) return none_of_these;
    const Case c{test, reference, variances, intervals_of(test), intervals_of(reference)};
    if (c.residue(as_it_is)) return "";
    std::vector<Hypothesis> hypotheses = permutations(test.image.width == test.image.height);
    for (const auto& more : {colour_maps(), gains(c)})
        hypotheses.insert(hypotheses.end(), more.begin(), more.end());
    if (const std::string best = best_of(c, hypotheses); !best.empty()) return best;
    const std::string shifted = shift(c);
    return shifted.empty() ? none_of_these : shifted;
}

} // namespace rt::compare
