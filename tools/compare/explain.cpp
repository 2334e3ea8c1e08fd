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

// ---- movements of the whole picture

/// A movement, and the share of the difference that is left after it is undone; 1 if it explains nothing.
struct Movement {
    std::string words;
    double left = 1;
};

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

/// Returns the share of the difference that is left; 1 if there was none.
double share_left(double after, double before) {
    return before > 0 ? after / before : 1;
}

double exact_shift_residue(const Image& test, const Image& reference, int dx, int dy) {
    const Image right = as_smooth(reference, dx, dy);
    return share_left(root_mean_square(half_shifted(test, dx, dy), right),
                      root_mean_square(as_smooth(test, dx, dy), right));
}

/// Returns the share of outlier tiles that are left. Averaging neighbours hardly changes the noise of a tile's sum.
double noisy_residue(const Case& c, const std::function<Image(const Image&)>& undo,
                     const std::function<Image(const Image&)>& keep) {
    const Image reference = keep(c.reference.image), variance = keep(c.variances.reference);
    const auto outliers = [&](const std::function<Image(const Image&)>& change) {
        return compare_tiles(change(c.test.image), reference, change(c.variances.test), variance).outliers;
    };
    return share_left(outliers(undo), outliers(keep));
}

double noisy_residue(const Case& c, const std::function<Image(const Image&)>& undo) {
    return noisy_residue(c, undo, as_it_is.undo);
}

/// The two pictures, smoothed.
struct SmoothPair {
    Image test, reference;
};

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

/// Returns the shift that leaves the smallest difference.
Movement best_shift(const Case& c, const SmoothPair& smooth) {
    const bool noisy = c.variances.available();
    const double limit = noisy ? limits.max_movement_outliers : limits.max_movement_residue;
    Movement best;
    for (const auto& [dx, dy] : straight_then_diagonal) {
        if (dx != 0 && dy != 0 && best.left < limit && best.words.find(" and ") == std::string::npos) break;
        const double left =
            noisy
                ? noisy_residue(c, [x = dx, y = dy](const Image& image) { return half_shifted(image, x, y); })
                : exact_shift_residue(smooth.test, smooth.reference, dx, dy);
        if (left < best.left) best = {shift_in_words(dx, dy), left};
    }
    return best;
}

/// Returns the flip or half turn that leaves the smallest difference. Unlike an exact one its pixels may be off by one.
Movement best_turn(const Case& c, const SmoothPair& smooth) {
    Movement best;
    for (const Hypothesis& turn : permutations(false)) {
        const double left = c.variances.available()
                                ? noisy_residue(c, turn.undo)
                                : share_left(root_mean_square(turn.undo(smooth.test), smooth.reference),
                                             root_mean_square(smooth.test, smooth.reference));
        if (left < best.left) best = {turn.name, left};
    }
    return best;
}

// ---- zoom about the middle

/// How much larger the test shows everything, in x and y.
struct Zoom {
    double x = 1, y = 1;
};

/// Returns width x height pixels around the middle of the image; neighbours are `spacing` pixels apart.
Image resampled(const Image& image, Zoom spacing, int width, int height) {
    Image result(width, height);
    const auto at = [&](int x, int y) {
        return image(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double u = (image.width - 1) / 2.0 + spacing.x * (x - (width - 1) / 2.0),
                         v = (image.height - 1) / 2.0 + spacing.y * (y - (height - 1) / 2.0);
            const int left = int(std::floor(u)), top = int(std::floor(v));
            const float right = float(u - left), low = float(v - top);
            result(x, y) = mix(mix(at(left, top), at(left + 1, top), right),
                               mix(at(left, top + 1), at(left + 1, top + 1), right), low);
        }
    return result;
}

/// The part of the reference that a zoomed picture shows, in pixels that are `spacing` apart. It stays centred.
struct Window {
    int width = 0, height = 0, spacing = 1;

    Window(const Image& image, Zoom zoom, int spacing_) : spacing(spacing_) {
        const auto shown = [&](int size, double factor) {
            return size / spacing - 2 * int((1 - 1 / std::max(factor, 1.0)) * size / spacing / 2);
        };
        width = shown(image.width, zoom.x);
        height = shown(image.height, zoom.y);
    }
    Image of(const Image& image, Zoom zoom = {}) const {
        return resampled(image, {spacing * zoom.x, spacing * zoom.y}, width, height);
    }
};

double exact_zoom_residue(const SmoothPair& smooth, Zoom zoom) {
    const Window window(smooth.test, zoom, std::max(1, smooth.test.width / 80)); // fewer are enough
    const Image reference = window.of(smooth.reference);
    return share_left(root_mean_square(window.of(smooth.test, zoom), reference),
                      root_mean_square(window.of(smooth.test), reference));
}

std::string zoom_in_words(Zoom zoom) {
    const double factor = zoom.x == 1 ? zoom.y : zoom.x;
    std::ostringstream words;
    words.precision(3);
    if (zoom.x == zoom.y)
        words << (factor > 1 ? "zoomed in" : "zoomed out") << " about the middle";
    else
        words << (factor > 1 ? "stretched" : "squeezed") << (zoom.x == 1 ? " in y" : " in x");
    words << " by a factor of " << std::max(factor, 1 / factor);
    return words.str();
}

/// Returns the zoom that leaves the smallest difference: coarse factors from 1/3 to 3 first, then finer ones.
Movement best_zoom(const Case& c, const SmoothPair& smooth) {
    Zoom best;
    double least = 1;
    const auto try_factor = [&](double logarithm, double in_x, double in_y) {
        const Zoom zoom{std::exp(in_x * logarithm), std::exp(in_y * logarithm)};
        const double left = exact_zoom_residue(smooth, zoom);
        if (left >= least) return;
        least = left;
        best = zoom;
    };
    for (int k = -110; k <= 110; ++k)
        for (const auto& [in_x, in_y] : {std::array{1, 1}, std::array{1, 0}, std::array{0, 1}})
            if (std::abs(k) > 1) try_factor(0.01 * k, in_x, in_y);
    const double in_x = best.x != 1, in_y = best.y != 1, coarse = std::log(best.x == 1 ? best.y : best.x);
    for (int k = -9; k <= 9; ++k) try_factor(coarse + 0.001 * k, in_x, in_y);
    if (!c.variances.available()) return {zoom_in_words(best), least};
    const Window window(smooth.test, best, 1);
    return {zoom_in_words(best), noisy_residue(
                                     c, [&](const Image& image) { return window.of(image, best); },
                                     [&](const Image& image) { return window.of(image); })};
}

/// Returns the movement that leaves the smallest difference, or "" if that is too large.
std::string movement(const Case& c) {
    const SmoothPair smooth{smoothed(c.test.image), smoothed(c.reference.image)};
    Movement best{"", c.variances.available() ? limits.max_movement_outliers : limits.max_movement_residue};
    for (const auto& find : {best_shift, best_turn, best_zoom})
        if (const Movement found = find(c, smooth); found.left < best.left) best = found;
    return best.words;
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
           "gamma 2.2 or a square root instead of it, the whole picture scaled, shifted by half a pixel, "
           "half a turn, zoomed about the middle";
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
    const std::string moved = movement(c);
    return moved.empty() ? none_of_these : moved;
}

} // namespace rt::compare
