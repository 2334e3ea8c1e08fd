// The sum of a pixel's samples, in order: the program and its twin in the web edition share it, and so make the same bits.
#pragma once

#include "common/image/image.h"

namespace rt {

/// Accumulates the samples of one pixel, in order. A sum of 2^20 equal floats is exact in double, so
/// constants keep their value.
class PixelSum {
  public:
    void add(vec3 radiance) {
        sum += glm::dvec3(radiance);
        ++count;
        // Welford 1962: sums squared differences; a difference of squares would suffer cancellation.
        const double value = double(luminance(radiance));
        const double before = value - mean_luminance;
        mean_luminance += before / count;
        squares += before * (value - mean_luminance);
    }
    vec3 mean() const { return vec3(sum / double(count)); }
    /// Returns the variance of the mean: the variance of one sample, squares / (count - 1), divided by count.
    float variance() const { return count > 1 ? float(squares / (double(count) * (count - 1))) : 0.0f; }

  private:
    int count = 0;
    glm::dvec3 sum{0.0};
    double mean_luminance = 0;
    double squares = 0;
};

} // namespace rt
