// Why do two pictures differ? Undoes the usual slips on the test picture, one after the other, and names the
// one with which the difference vanishes.
#pragma once

#include "tools/compare/encoded.h"

#include <string>

namespace rt::compare {

inline constexpr const char* none_of_these = "none of these";

/// Both empty, or both as large as the pictures: the variance of each pixel's mean luminance.
struct Variances {
    Image test, reference;

    bool available() const { return !test.pixels.empty(); }
};

/// "flipped left to right", "red and blue swapped", ..., or none_of_these. Empty if there is nothing to
/// explain: the pictures agree as they are, up to noise where variances are given. Throws Error if the sizes
/// differ.
std::string explain(const EncodedImage& test, const EncodedImage& reference, const Variances& variances);

/// All that is tried, in words, for a message that names it.
std::string explanations_tried();

} // namespace rt::compare
