// Renders an image: tiles on all cores, samples averaged in linear light, identical for any thread count.
#pragma once

#include "common/image/image.h"
#include "common/math/random.h"
#include "common/render/settings.h"
#include "common/util/ray_stats.h"

#include <functional>
#include <string>

namespace rt {

/// One sample of a pixel. Coordinates refer to the whole image, even if only a crop is rendered.
struct PixelSample {
    int x = 0;                 ///< column, from the left
    int y = 0;                 ///< row, from the top
    int index = 0;             ///< 0 to count - 1
    int count = 1;             ///< samples per pixel
    Random random{0, 0, 0, 0}; ///< a stream of its own for each sample
    std::uint64_t seed = 0;    ///< of the image, for numbers shared by all samples of a pixel
};

/// Returns the radiance of a sample. It is called from many threads in parallel, and its result must depend
/// on the argument alone.
using SampleFunction = std::function<vec3(PixelSample&)>;

/// A sample of a pixel.
struct SamplePlace {
    int x = 0, y = 0, sample = 0;
};

/// A rendered image, the variance of its pixels, and the cost.
struct Film {
    /// Radiance, linear RGB. A pixel with a sample that was not finite is (NaN, NaN, NaN).
    Image mean;
    /// Variance of the mean's luminance, (sum of squares / n - mean^2) / (n - 1), in all three channels; 0
    /// for one sample per pixel, NaN where the mean is NaN. Unbiased for independent samples. For stratified
    /// or Sobol samples it is usually an overestimate, so a z-test with it is valid but less sensitive.
    Image variance;
    std::uint64_t invalid_samples = 0; ///< number of samples that were NaN or infinite
    SamplePlace first_invalid;         ///< the first of those in reading order, in the whole image
    RayStats ray_stats;
};

/// Returns how many threads render() uses for this image: as many as --threads says (0: usable_cores()), but
/// no more than there are tiles.
int thread_count(const RenderSettings& settings);

/// Returns why a film of this size cannot be rendered (too little memory, or too large to
/// write), or "" if it can.
std::string size_error(const Crop& crop);

/// Renders `settings.crop`. The result does not depend on `threads`, and a crop is bit-identical to that
/// part of the whole image. `progress` is called with the finished part, 0 to 1, from one thread at a
/// time; it may be empty.
Film render(const RenderSettings& settings, const SampleFunction& radiance,
            const std::function<void(float)>& progress = {});

} // namespace rt
