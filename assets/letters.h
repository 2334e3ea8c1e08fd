// A small alphabet of pen strokes, for text in images.
#pragma once

#include "assets/implicit.h"
#include "assets/picture.h"

#include <map>
#include <string>
#include <string_view>

namespace rt::assets {

/// Returns a glyph as strokes separated by spaces. A stroke is a sequence of points with two digits each: x
/// in 0..4 to the right, y in 0..6 upward.
inline std::string_view glyph(char letter) {
    // clang-format off
    static const std::map<char, std::string_view> glyphs{
        {'0', "103041453616050110"}, {'1', "052620 1030"},     {'2', "05163645440040"},
        {'3', "0516364544331342413010 01"}, {'4', "30360242"},   {'5', "460604344341301001"},
        {'6', "4536160501103041423303"}, {'7', "06464410"},      {'8', "13040516364544331302011030414233"},
        {'9', "433313040516364541301001"}, {'A', "0004264440 0242"}, {'B', "00063645443303 3342413000"},
        {'C', "4536160501103041"},     {'D', "00062644422000"},  {'E', "46060040 0333"},
        {'F', "460600 0333"},          {'G', "45361605011030414323"},     {'H', "0006 4046 0343"},
        {'I', "1030 1636 2026"},       {'J', "4641301001"},      {'K', "0006 4602 1340"},
        {'L', "060040"},               {'M', "0006234640"},      {'N', "00064046"},
        {'O', "103041453616050110"},   {'P', "00063645443303"},  {'Q', "103041453616050110 2240"},
        {'R', "00063645443303 2340"},  {'S', "453616050413334241301001"}, {'T', "0646 2620"},
        {'U', "060110304146"},         {'V', "062046"},          {'W', "0610243046"},
        {'X', "0046 0640"},            {'Y', "062346 2320"},     {'Z', "06460040"}};
    // clang-format on
    const auto found = glyphs.find(letter);
    return found == glyphs.end() ? std::string_view() : found->second;
}

/// The position and size of a line of text: the left end of its baseline in pixels (y down), the height of
/// its capitals, and the pen.
struct TextStyle {
    dvec2 at;
    double height;
    double pen; ///< half the width of a stroke
};

inline double segment(dvec2 point, dvec2 a, dvec2 b, double half_width) {
    return cone({point, 0}, {a, 0}, {b, 0}, half_width, half_width);
}

/// Returns the signed distance to the text. Letters are 4/6 as wide as they are high; the gap
/// is 1.6/6 of the height.
inline double text_distance(dvec2 point, std::string_view text, const TextStyle& style) {
    const double unit = style.height / 6;
    double nearest = 1e9;
    dvec2 corner = style.at;
    for (const char letter : text) {
        const std::string_view strokes = glyph(letter);
        const auto pen_position = [&](std::size_t i) {
            return corner + unit * dvec2(strokes[i] - '0', '0' - strokes[i + 1]);
        };
        std::size_t i = 0;
        while (i + 3 < strokes.size()) {
            const bool pen_lifts = strokes[i + 2] == ' ';
            if (!pen_lifts)
                nearest = std::min(nearest, segment(point, pen_position(i), pen_position(i + 2), style.pen));
            i += pen_lifts ? 3 : 2;
        }
        corner.x += 5.6 * unit;
    }
    return nearest;
}

} // namespace rt::assets
