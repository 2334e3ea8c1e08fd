// LDR-FLIP: how visible the difference is, from 0 (not at all) to 1, per pixel (Andersson et al., HPG 2020).
#pragma once

#include "common/image/image.h"

#include <vector>

namespace rt::compare {

/// A screen 0.7 m wide with 3840 pixels, seen from 0.7 m: distance * pixels / width * pi / 180.
inline constexpr double usual_pixels_per_degree = 0.7 * 3840 / 0.7 * 3.14159265358979323846 / 180;

struct FlipMap {
    int width = 0, height = 0;
    std::vector<float> errors; ///< row by row from the top left
    double mean = 0;
    double max = 0;
};

/// Compares pictures in linear RGB; values outside [0, 1] are clamped. A pixel that is not finite in one of
/// the two has the error 1. Throws Error if the sizes differ.
FlipMap flip(const Image& reference, const Image& test, double pixels_per_degree = usual_pixels_per_degree);

} // namespace rt::compare
