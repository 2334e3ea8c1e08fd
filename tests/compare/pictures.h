// Pictures for the checks of the comparison: without symmetry, with noise, after a file round trip.
#pragma once

#include "tools/compare/explain.h"
#include "common/image/image_file.h"
#include "common/math/random.h"
#include "tests/malformed/folder.h"

#include <cmath>
#include <string>

namespace rt::compare {

/// Builds smooth light with a ball and no symmetry, seen through a window at (left, top).
inline Image lopsided(int width, int height, float left = 0, float top = 0) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float u = (float(x) + left) / float(width), v = (float(y) + top) / float(height);
            const float ball = std::exp(-((u - 0.7f) * (u - 0.7f) + (v - 0.3f) * (v - 0.3f)) * 60);
            image(x, y) = vec3(0.1f + 0.5f * u, 0.15f + 0.3f * v + 0.2f * u * v, 0.4f - 0.3f * u) +
                          ball * vec3(0.3f, 0.1f, 0.05f);
        }
    return image;
}

template <typename Change>
Image changed(Image image, Change change) {
    for (vec3& pixel : image.pixels) pixel = change(pixel);
    return image;
}

inline Image mirrored(const Image& image, bool in_x, bool in_y) {
    Image result(image.width, image.height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            result(x, y) = image(in_x ? image.width - 1 - x : x, in_y ? image.height - 1 - y : y);
    return result;
}

inline Image transposed(const Image& image) {
    Image result(image.height, image.width);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) result(y, x) = image(x, y);
    return result;
}

/// Writes a picture to a file and reads it back.
inline EncodedImage through_file(const Image& image, const std::string& ending) {
    const malformed::Folder folder;
    const std::string path = folder / ("picture" + ending);
    write_image(path, image);
    return read_encoded(path);
}

/// The mean and variance of a simulated correct render: 64 samples per pixel with an exponential
/// distribution, which is typical of light.
struct NoisyPicture {
    Image mean, variance;

    NoisyPicture(const Image& truth, std::uint64_t seed) : mean(truth), variance(truth) {
        constexpr int samples = 64;
        for (int y = 0; y < truth.height; ++y)
            for (int x = 0; x < truth.width; ++x) {
                Random random(x, y, 0, seed);
                double sum = 0, squares = 0;
                for (int i = 0; i < samples; ++i) {
                    const double weight = -std::log(1 - double(random.get_1d()));
                    sum += weight;
                    squares += weight * weight;
                }
                const double m = sum / samples, light = double(luminance(truth(x, y)));
                mean(x, y) = truth(x, y) * float(m);
                variance(x, y) = vec3(float((squares / samples - m * m) / (samples - 1) * light * light));
            }
    }
};

} // namespace rt::compare
