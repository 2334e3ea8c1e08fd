// Where do two pictures differ, and how: "too bright by 12 % in the lower left".
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
    Region box;        ///< round nine tenths of what differs
    double share = 0;  ///< of the picture's pixels, or of its tiles
};

/// Pixels whose channels differ by more than the tolerance.
Location locate_difference(const Image& test, const Image& reference);
/// Tiles that differ by more than noise explains.
Location locate_difference(const TileDifference& tiles, const Image& test, const Image& reference);

/// "in the lower left", "on the right", "at the top", "in the middle", "all over the picture".
std::string place_in_words(const Region& box, int width, int height);

/// A pixel that is not a number, or magenta as write_image() leaves it, where the reference is neither.
struct NotANumber {
    std::size_t pixels = 0;
    int x = 0, y = 0; ///< the first, in reading order
};
NotANumber not_a_number(const Image& test, const Image& reference);

} // namespace rt::compare
