// Settings of every render: the size of the image, its samples, threads and files.
#pragma once

#include <cstdint>
#include <string>

namespace rt {

/// A part of the image: columns x0 <= x < x1 and rows y0 <= y < y1 of the whole image.
struct Crop {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

struct RenderSettings {
    int width = 640;
    int height = 400;
    int samples = 1;        ///< per pixel
    int threads = 0;        ///< 0: as many as usable_cores()
    std::uint64_t seed = 1; ///< a different seed gives different noise
    Crop crop{};            ///< the whole image unless --crop is given
    std::string out{};      ///< NAME.png, NAME.hdr, or NAME for both
    std::string variance{}; ///< NAME.hdr for the variance of each pixel's mean, or empty
    bool quiet = false;
};

} // namespace rt
