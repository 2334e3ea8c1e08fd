// Finds where and how two pictures differ: "too bright by 12 % in the lower left".
#pragma once

#include "tools/compare/difference.h"

#include <optional>
#include <string>

namespace rt::compare {

/// A part of the picture: columns x0 <= x < x1 and rows y0 <= y < y1.
struct Region {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

struct Location {
    std::string words; ///< empty if nothing differs
    Region box;        ///< contains the middle 90 % of the difference, in x and in y
    double share = 0;  ///< share of the pixels that differ, or are in tiles that do
};

/// Locates the pixels with a channel that differs by more than the tolerance.
Location locate_difference(const Image& test, const Image& reference);
/// Locates the tiles that differ by more than noise explains.
Location locate_difference(const TileDifference& tiles, const Image& test, const Image& reference);

/// Returns "in the lower left", "on the right", "at the top", "in the middle", "all over the picture".
std::string place_in_words(const Region& box, int width, int height);

/// The pixels that are NaN or infinite, or magenta as write_image() stores them, where the
/// reference is neither.
struct NotANumber {
    std::size_t pixels = 0;
    int x = 0, y = 0; ///< the first one, row by row
};
NotANumber not_a_number(const Image& test, const Image& reference);

} // namespace rt::compare
