// Facts about FLIP: values on which two other implementations agree, and general properties.
#include "tools/compare/flip.h"

#include "common/util/error.h"
#include "common/math/random.h"
#include "tests/malformed/folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace rt;
using namespace rt::compare;
using namespace rt::malformed;

namespace {

constexpr int side = 64;

float decoded(double srgb) {
    return float(srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4));
}

/// Builds a picture from the sRGB value of each pixel.
template <typename Value>
Image grey_picture(Value value) {
    Image image(side, side);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) image(x, y) = vec3(decoded(value(x, y)));
    return image;
}

Image grey(double srgb) {
    return grey_picture([srgb](int, int) { return srgb; });
}

Image filled(vec3 linear) {
    Image image(side, side);
    std::fill(image.pixels.begin(), image.pixels.end(), linear);
    return image;
}

Image srgb(double r, double g, double b) {
    return filled({decoded(r), decoded(g), decoded(b)});
}

Image checker(int shift) {
    return grey_picture([shift](int x, int y) {
        const int column = (x + side + shift) % side / 8;
        return (column + y / 8) % 2 == 1 ? 0.9 : 0.1;
    });
}

double hashed(int x, int y, int k) {
    std::uint32_t h = std::uint32_t(x) + 4096u * std::uint32_t(y) + 16777259u * std::uint32_t(k);
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    h ^= h >> 16;
    return double(h) / 4294967296.0;
}

/// Builds a picture with edges, colours and noise.
Image lively(int width, int height, std::uint64_t seed) {
    Image image(width, height);
    Random random(seed);
    for (vec3& pixel : image.pixels) pixel = {random.get_1d(), random.get_1d(), random.get_1d()};
    return image;
}

void check_golden(const Image& reference, const Image& test, double mean, double max) {
    const FlipMap result = flip(reference, test, 67.020645);
    CHECK_MESSAGE(std::abs(result.mean - mean) <= 1e-4,
                  "mean " << result.mean << " where " << mean << " is known");
    CHECK_MESSAGE(std::abs(result.max - max) <= 5e-4,
                  "max " << result.max << " where " << max << " is known");
}

} // namespace

TEST_CASE("FLIP of flat pictures equals the values of two other implementations") {
    check_golden(filled(vec3(0.0f)), filled(vec3(1.0f)), 0.967388, 0.967388);
    check_golden(filled({0, 1, 0}), filled({0, 0, 1}), 1, 1);
    check_golden(grey(0.5), grey(0.6), 0.285063, 0.285063);
    check_golden(grey(128 / 255.0), grey(129 / 255.0), 0.029868, 0.029868);
    check_golden(srgb(0.8, 0.2, 0.1), srgb(0.72, 0.18, 0.09), 0.301997, 0.301997);
}

TEST_CASE("FLIP of a shifted checkerboard, a firefly and a noisy ramp equals the values of two other "
          "implementations") {
    check_golden(checker(0), checker(-1), 0.286646, 0.987794);
    Image firefly = grey(0.5);
    firefly(32, 32) = vec3(1.0f);
    check_golden(grey(0.5), firefly, 0.001055, 0.380198);
    const auto ramp = [](int x, int) { return x / 63.0; };
    const auto noisy = [](int x, int y) {
        return std::clamp(x / 63.0 + (hashed(x, y, 0) - 0.5) * 16 / 255, 0.0, 1.0);
    };
    check_golden(grey_picture(ramp), grey_picture(noisy), 0.034334, 0.135017);
}

TEST_CASE("the default display has 67.0206 pixels per degree") {
    CHECK(std::abs(usual_pixels_per_degree - 67.0206) < 5e-5);
}

TEST_CASE("FLIP is zero for equal pictures and symmetric in its arguments") {
    const Image a = lively(50, 40, 1), b = lively(50, 40, 2);
    const FlipMap same = flip(a, a);
    CHECK(same.mean == 0);
    CHECK(same.max == 0);
    const FlipMap ab = flip(a, b), ba = flip(b, a);
    CHECK(ab.mean > 0.1);
    CHECK(ab.mean == ba.mean);
    CHECK(ab.errors == ba.errors);
    CHECK(ab.max == *std::max_element(ab.errors.begin(), ab.errors.end()));
}

TEST_CASE("pictures smaller than FLIP's filters are treated as if their borders continued without end") {
    for (const auto& [width, height] :
         {std::pair(1, 1), std::pair(1, 9), std::pair(3, 2), std::pair(40, 1)}) {
        Image black(width, height), white(width, height);
        std::fill(white.pixels.begin(), white.pixels.end(), vec3(1.0f));
        const FlipMap result = flip(black, white);
        CHECK(result.errors.size() == black.pixels.size());
        CHECK(std::abs(result.mean - 0.967388) < 1e-4);
        CHECK(std::abs(result.max - 0.967388) < 1e-4);
    }
    CHECK(flip(Image(), Image()).mean == 0);
}

TEST_CASE("swapping rows and columns in both pictures transposes the errors") {
    const Image a = lively(30, 30, 3), b = lively(30, 30, 4);
    const auto swapped = [](const Image& image) {
        Image result(image.height, image.width);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) result(y, x) = image(x, y);
        return result;
    };
    const FlipMap plain = flip(a, b), turned = flip(swapped(a), swapped(b));
    float furthest = 0;
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 30; ++x)
            furthest = std::max(furthest, std::abs(plain.errors[std::size_t(y * 30 + x)] -
                                                   turned.errors[std::size_t(x * 30 + y)]));
    CHECK(furthest < 1e-4f);
}

TEST_CASE("light above white is shown as white and a pixel that is NaN has the maximum error") {
    Image bright = filled(vec3(7.0f));
    CHECK(flip(filled(vec3(1.0f)), bright).mean == 0);
    bright(5, 6).y = std::numeric_limits<float>::quiet_NaN();
    const FlipMap result = flip(filled(vec3(1.0f)), bright);
    CHECK(result.errors[6 * side + 5] == 1);
    CHECK(std::isfinite(result.mean));
    CHECK(result.max == 1);
}

TEST_CASE("FLIP of pictures of different sizes is an error that states both") {
    CHECK_ERROR(error_of([] { flip(Image(3, 2), Image(2, 3)); }), "3 x 2", "2 x 3");
}
