// Determines the verdict, and formats it as text and as JSON.
#include "tools/compare/comparison.h"

#include "common/util/error.h"
#include "common/util/json.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

namespace rt::compare {
namespace {

std::string value_of(vec3 pixel) {
    std::ostringstream words;
    words.precision(3);
    words << "(" << pixel.x << ", " << pixel.y << ", " << pixel.z << ")";
    return words.str();
}

std::string counted(std::size_t count, const std::string& what) {
    return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

void check_channels(const EncodedImage& test, const EncodedImage& reference) {
    const auto count = [](const EncodedImage& encoded) {
        return counted(std::size_t(encoded.channels), "channel");
    };
    if (test.channels != reference.channels)
        throw Error("the pictures differ in their channels: " + count(test) + " and " + count(reference) +
                    " (1 is grey, 3 RGB, 2 and 4 have alpha); save both as RGB");
}

// ---- the verdict

Verdict exact_verdict(const Difference& difference, const FlipMap& seen, int step) {
    if (conclude(difference, step).same) return Verdict::same;
    return seen.mean <= borderline_flip(step) ? Verdict::borderline : Verdict::different;
}

Verdict noisy_verdict(const TileDifference& tiles, bool equal) {
    if (conclude(tiles).same) return equal ? Verdict::same : Verdict::noise;
    const bool near = std::abs(tiles.largest_z) <= limits.borderline_z &&
                      tiles.outliers <= limits.borderline_outliers * allowed_outliers(tiles.tiles);
    return near ? Verdict::borderline : Verdict::different;
}

/// Replaces "different: " by words for a borderline verdict.
std::string headline(Verdict verdict, std::string words) {
    constexpr std::string_view different = "different: ";
    if (verdict == Verdict::borderline && words.rfind(different, 0) == 0)
        words.replace(0, different.size(), "almost the same, look at the map: ");
    return words;
}

// ---- the lines

std::string worst_pixel(const Difference& d) {
    return "worst pixel: " + std::to_string(d.x) + "," + std::to_string(d.y) + " is " + value_of(d.test) +
           ", in the reference " + value_of(d.reference);
}

std::string worst_tile(const TileDifference& d) {
    std::ostringstream words;
    words.precision(3);
    words << "worst tile: the 8 x 8 pixels at " << d.x << "," << d.y << " have the mean luminance " << d.test
          << ", in the reference " << d.reference << " (z " << d.largest_z << ")";
    return words.str();
}

std::string why(const Comparison& comparison) {
    if (comparison.explanation != none_of_these) return "likely cause: " + comparison.explanation;
    return "likely cause: none of these (" + explanations_tried() + ")";
}

std::string joined(const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : " or ") + name;
    return all;
}

std::string flip_in_words(const FlipMap& seen) {
    std::ostringstream words;
    words.precision(3);
    words << "FLIP: mean " << seen.mean << ", largest " << seen.max
          << " (0: not visible, 1: black instead of white)";
    return words.str();
}

void explain_difference(Comparison& comparison, const ComparisonInput& q) {
    comparison.explanation = explain(q.test, q.reference, q.variances);
    if (comparison.explanation.empty()) comparison.explanation = none_of_these;
    comparison.lines.push_back(why(comparison));
    if (q.catalogue.empty()) return;
    comparison.match = find_in_catalogue(q.test, q.reference, q.variances, q.catalogue);
    comparison.lines.push_back("known mistakes: " +
                               (comparison.match
                                    ? "this is the picture of " + joined(comparison.match.names)
                                    : "none of " + counted(q.catalogue.size(), "picture") + " matches"));
}

/// Handles pixels that are NaN or infinite: they are wrong even in a noisy picture.
bool tell_not_a_number(Comparison& comparison, const Image& test, const Image& reference) {
    const NotANumber found = not_a_number(test, reference);
    if (found.pixels == 0) return false;
    comparison.not_a_number = found;
    comparison.verdict = Verdict::different;
    comparison.lines.push_back("different: " + counted(found.pixels, "pixel") +
                               " not a number (NaN or infinite; magenta in a file), the first at " +
                               std::to_string(found.x) + "," + std::to_string(found.y));
    return true;
}

/// Sets the verdict and the first line.
void decide(Comparison& comparison, const Difference& difference, const ComparisonInput& q) {
    const Conclusion words = comparison.tiles ? conclude(*comparison.tiles) : conclude(difference, q.step);
    comparison.verdict = comparison.tiles ? noisy_verdict(*comparison.tiles, comparison.rmse == 0)
                                          : exact_verdict(difference, comparison.flip, q.step);
    if (tell_not_a_number(comparison, q.test.image, q.reference.image)) return;
    comparison.lines.push_back(headline(comparison.verdict, words.words));
}

// ---- the map

/// Returns a colour for an amount in [0, 1]: from black over violet, red and orange to pale yellow, with
/// increasing lightness. Linear RGB.
vec3 heat(float amount) {
    static const vec3 colours[] = {{0, 0, 0.02f},         {0.17f, 0.06f, 0.38f}, {0.47f, 0.11f, 0.50f},
                                   {0.78f, 0.20f, 0.43f}, {0.97f, 0.45f, 0.33f}, {1, 0.75f, 0.45f},
                                   {1, 0.99f, 0.80f}};
    const float at = std::clamp(amount, 0.0f, 1.0f) * 6;
    const int low = std::min(int(at), 5);
    return srgb_decoded(mix(colours[low], colours[low + 1], at - float(low)));
}

/// Returns black for 0, red for positive z (too bright), blue for negative z; saturated at twice the
/// limit of outliers.
vec3 signed_heat(double z) {
    const float amount = float(std::min(std::abs(z) / (2 * limits.outlier_z), 1.0));
    const vec3 full = z > 0 ? vec3(1, 0.35f, 0.15f) : vec3(0.2f, 0.5f, 1);
    return srgb_decoded(amount * full);
}

} // namespace

bool is_same(Verdict verdict) {
    return verdict == Verdict::same || verdict == Verdict::noise;
}

const char* name_of(Verdict verdict) {
    switch (verdict) {
    case Verdict::same: return "same";
    case Verdict::noise: return "noise";
    case Verdict::borderline: return "look";
    case Verdict::different: return "different";
    }
    return "";
}

Comparison compare_images(const ComparisonInput& q) {
    check_same_size(q.test.image, q.reference.image);
    check_channels(q.test, q.reference);
    const Pair pair = comparable(q.test, q.reference);
    const Difference difference = compare_pixels(pair.test, pair.reference);
    Comparison comparison;
    comparison.flip = flip(pair.reference, pair.test);
    comparison.rmse = root_mean_square(pair.test, pair.reference);
    comparison.mean_change = difference.mean_change;
    if (q.variances.available())
        comparison.tiles =
            compare_tiles(q.test.image, q.reference.image, q.variances.test, q.variances.reference);
    decide(comparison, difference, q);
    if (is_same(comparison.verdict)) return comparison;
    comparison.location = comparison.tiles ? locate_difference(*comparison.tiles, pair.test, pair.reference)
                                           : locate_difference(pair.test, pair.reference);
    if (!comparison.location.words.empty()) comparison.lines.push_back("where: " + comparison.location.words);
    comparison.lines.push_back(comparison.tiles ? worst_tile(*comparison.tiles) : worst_pixel(difference));
    comparison.lines.push_back(flip_in_words(comparison.flip));
    explain_difference(comparison, q);
    return comparison;
}

std::string to_json(const Comparison& comparison) {
    return json::text({{"verdict", name_of(comparison.verdict)},
                       {"explanation", comparison.explanation},
                       {"flip", {{"mean", comparison.flip.mean}, {"max", comparison.flip.max}}},
                       {"rmse", comparison.rmse},
                       {"mean_change", comparison.mean_change},
                       {"tiles_over_4", comparison.tiles ? Json(comparison.tiles->outliers) : Json()},
                       {"where", comparison.location.words},
                       {"nearest", comparison.match.names},
                       {"words", comparison.lines}});
}

Image error_map(const Comparison& comparison) {
    Image map(comparison.flip.width, comparison.flip.height);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            if (!comparison.tiles) {
                map(x, y) =
                    heat(comparison.flip.errors[std::size_t(y) * std::size_t(map.width) + std::size_t(x)]);
                continue;
            }
            const int tile = y / tile_side * comparison.tiles->columns + x / tile_side;
            map(x, y) = signed_heat(comparison.tiles->scores[std::size_t(tile)].z);
        }
    return map;
}

} // namespace rt::compare
