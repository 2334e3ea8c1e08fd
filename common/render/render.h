// Renders a picture: tiles over all cores, samples averaged in linear light, the same bits for any number of
// threads.
#pragma once

#include "common/image/image.h"
#include "common/math/random.h"
#include "common/render/settings.h"
#include "common/util/ray_stats.h"

#include <functional>
#include <string>

namespace rt {

/// One sample of one pixel of the whole picture, whichever crop is rendered.
struct PixelSample {
    int x = 0;                 ///< column, from the left
    int y = 0;                 ///< row, from the top
    int index = 0;             ///< 0 to count - 1
    int count = 1;             ///< samples a pixel
    Random random{0, 0, 0, 0}; ///< numbers that no other sample gets
    std::uint64_t seed = 0;    ///< of the picture, for numbers that the samples of a pixel share
};

/// From a sample to the radiance that it sees. Called from many threads at once; must depend on nothing but
/// its argument.
using SampleFunction = std::function<vec3(PixelSample&)>;

/// Which sample of which pixel.
struct SamplePlace {
    int x = 0, y = 0, sample = 0;
};

/// A picture, how sure it is of each pixel, and what it cost.
struct Film {
    /// Radiance, linear RGB; a pixel with a sample that was not finite is (nan, nan, nan).
    Image mean;
    /// Of the mean's luminance, (sum of squares / n - mean^2) / (n - 1), in all three channels; 0 for one
    /// sample a pixel, nan where the mean is. True for samples that know nothing of each other, as a rule too
    /// large for samples that are spread evenly: a z-test with it stays valid, but is milder.
    Image variance;
    std::uint64_t invalid_samples = 0; ///< NaN or infinite
    SamplePlace first_invalid;         ///< of those, in reading order and in the whole picture
    RayStats ray_stats;
};

/// How many threads render() takes for this picture: as --threads asks (0: usable_cores()), but no more than
/// there are tiles.
int thread_count(const RenderSettings& settings);

/// Why a film of this size is not rendered: it needs more memory than there is, or cannot be written; "" if it
/// is.
std::string size_error(const Crop& crop);

/// Renders `settings.crop`. The result does not depend on `threads`; a crop has the bits of that part of the
/// whole. `progress` is told the finished share, 0 to 1, from one thread at a time; it may be empty.
Film render(const RenderSettings& settings, const SampleFunction& radiance,
            const std::function<void(float)>& progress = {});

} // namespace rt
