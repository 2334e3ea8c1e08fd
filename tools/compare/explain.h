// Finds out why two pictures differ.
// Undoes common errors on the test picture, one at a time, and names the one that removes the difference.
#pragma once

#include "tools/compare/encoded.h"

#include <string>

namespace rt::compare {

inline constexpr const char* none_of_these = "none of these";

/// The variance of each pixel's mean luminance; both are empty, or both have the size of the pictures.
struct Variances {
    Image test, reference;

    bool available() const { return !test.pixels.empty(); }
};

/// Returns "flipped left to right", "red and blue swapped", ..., or none_of_these. Empty if the pictures
/// agree as they are, up to noise if variances are given. Throws Error if the sizes differ.
std::string explain(const EncodedImage& test, const EncodedImage& reference, const Variances& variances);

/// Returns the list of all explanations that are tried, for a message.
std::string explanations_tried();

} // namespace rt::compare
