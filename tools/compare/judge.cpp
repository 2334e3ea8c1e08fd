// Puts the verdict together, and says it in words and in JSON.
#include "tools/compare/judge.h"

#include "common/util/error.h"
#include "common/util/json.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string_view>

namespace rt {
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

void check_channels(const StoredImage& test, const StoredImage& reference) {
    const auto count = [](const StoredImage& stored) {
        return counted(std::size_t(stored.channels), "channel");
    };
    if (test.channels != reference.channels)
        throw Error("the pictures differ in their channels: " + count(test) + " and " + count(reference) +
                    " (1 is grey, 3 RGB, 2 and 4 have alpha); save both as RGB");
}

// ---- the verdict

Finding exact_finding(const Difference& difference, const Flip& seen, int step) {
    if (verdict(difference).same) return Finding::same;
    return seen.mean <= look_flip(step) ? Finding::look : Finding::different;
}

Finding noisy_finding(const TileDifference& tiles, bool equal) {
    if (verdict(tiles).same) return equal ? Finding::same : Finding::noise;
    const bool near = std::abs(tiles.largest_z) <= limits.look_z &&
                      tiles.alarms <= limits.look_alarms * allowed_alarms(tiles.tiles);
    return near ? Finding::look : Finding::different;
}

/// "different: ..." where the words of the verdict are "look at the map: ...".
std::string headline(Finding finding, std::string words) {
    constexpr std::string_view different = "different: ";
    if (finding == Finding::look && words.rfind(different, 0) == 0)
        words.replace(0, different.size(), "look at the map, the pictures nearly agree: ");
    return words;
}

// ---- the lines

std::string worst_pixel(const Difference& d) {
    return "worst pixel: " + std::to_string(d.x) + "," + std::to_string(d.y) + " is " + value_of(d.test) +
           ", the reference has " + value_of(d.reference) + " there";
}

std::string worst_tile(const TileDifference& d) {
    std::ostringstream words;
    words.precision(3);
    words << "worst tile: the 8 x 8 pixels at " << d.x << "," << d.y << " have the mean luminance " << d.test
          << ", the reference " << d.reference << " (z " << d.largest_z << ")";
    return words.str();
}

std::string why(const Judgement& judgement) {
    if (judgement.explanation != none_of_these) return "it looks as if: " + judgement.explanation;
    return "explanation: none of these (" + explanations_tried() + ")";
}

std::string joined(const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : " or ") + name;
    return all;
}

std::string flip_in_words(const Flip& seen) {
    std::ostringstream words;
    words.precision(3);
    words << "FLIP: mean " << seen.mean << ", largest " << seen.max
          << " (0: nobody sees it, 1: black for white)";
    return words.str();
}

void explain_difference(Judgement& judgement, const Question& q) {
    judgement.explanation = explain(q.test, q.reference, q.variances);
    if (judgement.explanation.empty()) judgement.explanation = none_of_these;
    judgement.lines.push_back(why(judgement));
    if (q.known.empty()) return;
    judgement.nearest = nearest_known(q.test, q.reference, q.variances, q.known);
    judgement.lines.push_back("known mistakes: " +
                              (judgement.nearest
                                   ? "this is the picture of " + joined(judgement.nearest.names)
                                   : "none of " + counted(q.known.size(), "picture") + " is this one"));
}

/// A NaN is wrong however much noise there is.
bool tell_not_a_number(Judgement& judgement, const Image& test, const Image& reference) {
    const NotANumber found = not_a_number(test, reference);
    if (found.pixels == 0) return false;
    judgement.finding = Finding::different;
    judgement.lines.push_back("different: " + counted(found.pixels, "pixel") +
                              " not a number (NaN or infinite, magenta in a file), the first at " +
                              std::to_string(found.x) + "," + std::to_string(found.y));
    return true;
}

/// The verdict and the first line.
void decide(Judgement& judgement, const Difference& difference, const Question& q) {
    const Verdict words = judgement.tiles ? verdict(*judgement.tiles) : verdict(difference);
    judgement.finding = judgement.tiles ? noisy_finding(*judgement.tiles, judgement.rmse == 0)
                                        : exact_finding(difference, judgement.flip, q.step);
    if (tell_not_a_number(judgement, q.test.image, q.reference.image)) return;
    judgement.lines.push_back(headline(judgement.finding, words.words));
}

// ---- JSON

/// On one line.
std::string texts(const std::vector<std::string>& all) {
    std::string out;
    for (const std::string& text : all) out += (out.empty() ? "" : ", ") + json_text(text);
    return "[" + out + "]";
}

// ---- the map

/// Colours of our own, as sRGB: ever lighter from black over violet, red and orange to pale yellow.
vec3 heat(float amount) {
    static const vec3 colours[] = {{0, 0, 0.02f},         {0.17f, 0.06f, 0.38f}, {0.47f, 0.11f, 0.50f},
                                   {0.78f, 0.20f, 0.43f}, {0.97f, 0.45f, 0.33f}, {1, 0.75f, 0.45f},
                                   {1, 0.99f, 0.80f}};
    const float at = std::clamp(amount, 0.0f, 1.0f) * 6;
    const int low = std::min(int(at), 5);
    return srgb_decoded(mix(colours[low], colours[low + 1], at - float(low)));
}

/// Black for 0, red for too bright, blue for too dark; full at twice what alarms.
vec3 signed_heat(double z) {
    const float amount = float(std::min(std::abs(z) / (2 * limits.alarm_z), 1.0));
    const vec3 full = z > 0 ? vec3(1, 0.35f, 0.15f) : vec3(0.2f, 0.5f, 1);
    return srgb_decoded(amount * full);
}

} // namespace

bool is_same(Finding finding) {
    return finding == Finding::same || finding == Finding::noise;
}

const char* name_of(Finding finding) {
    switch (finding) {
    case Finding::same: return "same";
    case Finding::noise: return "noise";
    case Finding::look: return "look";
    case Finding::different: return "different";
    }
    return "";
}

Judgement judge(const Question& q) {
    check_same_size(q.test.image, q.reference.image);
    check_channels(q.test, q.reference);
    const Pair pair = comparable(q.test, q.reference);
    const Difference difference = rt::difference(pair.test, pair.reference);
    Judgement judgement;
    judgement.flip = flip(pair.reference, pair.test);
    judgement.rmse = root_mean_square(pair.test, pair.reference);
    if (q.variances.given())
        judgement.tiles =
            tile_difference(q.test.image, q.reference.image, q.variances.test, q.variances.reference);
    decide(judgement, difference, q);
    if (is_same(judgement.finding)) return judgement;
    judgement.where = judgement.tiles ? where(*judgement.tiles, pair.test, pair.reference)
                                      : where(pair.test, pair.reference);
    if (!judgement.where.words.empty()) judgement.lines.push_back("where: " + judgement.where.words);
    judgement.lines.push_back(judgement.tiles ? worst_tile(*judgement.tiles) : worst_pixel(difference));
    judgement.lines.push_back(flip_in_words(judgement.flip));
    explain_difference(judgement, q);
    return judgement;
}

std::string to_json(const Judgement& judgement) {
    const Flip& seen = judgement.flip;
    return object({{"verdict", json_text(name_of(judgement.finding))},
                   {"explanation", json_text(judgement.explanation)},
                   {"flip", object({{"mean", number(seen.mean)}, {"max", number(seen.max)}})},
                   {"rmse", number(judgement.rmse)},
                   {"tiles_over_4", judgement.tiles ? number(std::int64_t(judgement.tiles->alarms)) : "null"},
                   {"where", json_text(judgement.where.words)},
                   {"nearest", texts(judgement.nearest.names)},
                   {"words", texts(judgement.lines)}});
}

Image error_map(const Judgement& judgement) {
    Image map(judgement.flip.width, judgement.flip.height);
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            if (!judgement.tiles) {
                map(x, y) =
                    heat(judgement.flip.errors[std::size_t(y) * std::size_t(map.width) + std::size_t(x)]);
                continue;
            }
            const int tile = y / tile_side * judgement.tiles->columns + x / tile_side;
            map(x, y) = signed_heat(judgement.tiles->marks[std::size_t(tile)].z);
        }
    return map;
}

} // namespace rt
