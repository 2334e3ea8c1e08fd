// An image of 8-bit sRGB values, functions for painting on it, and a PNG writer.
#pragma once

#include "assets/mesh.h"
#include "assets/output_file.h"

#include <stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rt::assets {

/// An sRGB colour, 0 to 255 per channel: colours are chosen and mixed by eye, as in a paint program.
using Colour = dvec3;

/// Returns the colour 0xRRGGBB, as written on the web.
constexpr Colour hex(int rgb) {
    return {rgb >> 16, (rgb >> 8) & 255, rgb & 255};
}

/// An image, row by row from the top left.
struct Picture {
    int width, height;
    std::vector<Colour> pixels;

    Picture(int w, int h, Colour ground)
        : width(w), height(h), pixels(std::size_t(w) * std::size_t(h), ground) {}

    Colour& operator()(int x, int y) { return pixels[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
};

/// Returns `paint` where `distance` is negative, and `ground` elsewhere; the border
/// fades over 2 * `softness`.
inline Colour over(Colour ground, Colour paint, double distance, double softness) {
    return mix(ground, paint, glm::smoothstep(softness, -softness, distance));
}

inline void write_png(const std::string& path, const Picture& picture) {
    std::vector<unsigned char> bytes;
    for (const Colour& pixel : picture.pixels)
        for (int channel = 0; channel < 3; ++channel)
            bytes.push_back(static_cast<unsigned char>(std::lround(std::clamp(pixel[channel], 0.0, 255.0))));
    const auto append = [](void* file, void* data, int size) {
        static_cast<OutputFile*>(file)->write({static_cast<const char*>(data), std::size_t(size)});
    };
    OutputFile file(path);
    stbi_write_png_to_func(append, &file, picture.width, picture.height, 3, bytes.data(), 3 * picture.width);
    file.finish();
}

} // namespace rt::assets
