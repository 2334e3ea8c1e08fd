// Facts about comparing: equal pictures pass, a bias is located, and noise causes no false alarm.
#include "tools/compare/difference.h"

#include "common/util/error.h"
#include "tests/compare/pictures.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace rt;
using namespace rt::compare;
using namespace rt::malformed;

namespace {

constexpr int width = 160, height = 100; // 20 x 13 tiles, the last row of them half as high

Image scene() {
    Image image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) image(x, y) = vec3(0.2f + float(x) * 0.002f, 0.5f, float(y) * 0.004f);
    }
    return image;
}

TileDifference compared(const NoisyPicture& a, const NoisyPicture& b) {
    return compare_tiles(a.mean, b.mean, a.variance, b.variance);
}

} // namespace

TEST_CASE("a picture is the same as itself") {
    const Conclusion same = conclude(compare_pixels(scene(), scene()));
    CHECK(same.same);
    CHECK(same.words == "same picture (largest difference 0, mean 0)");
    const NoisyPicture noisy(scene(), 1);
    CHECK(conclude(compared(noisy, noisy)).same);
}

TEST_CASE("the largest difference is located with its size and sign") {
    Image test = scene();
    test(120, 80) *= 1.12f;
    const Difference d = compare_pixels(test, scene());
    CHECK(d.x == 120);
    CHECK(d.y == 80);
    CHECK(d.differing == 1);
    CHECK(std::abs(d.largest - 0.06f) < 1e-5f); // of .5
    CHECK(std::abs(d.mean - (0.12 * (0.44 + 0.5 + 0.32) / 3) / (width * height)) < 1e-9);
    CHECK(conclude(d).same); // one pixel of 16,000 is within the limits
    for (int x = 0; x < 17; ++x) test(x, 80) *= 1.1f;
    const Conclusion brighter = conclude(compare_pixels(test, scene()));
    CHECK_FALSE(brighter.same);
    CHECK_ERROR(brighter.words, "different: 18 of 16000 pixels", "largest 0.06 at 120,80",
                "brighter by 12 % there");
    CHECK_ERROR(conclude(compare_pixels(scene(), test)).words, "darker by 10.7 % there");
}

TEST_CASE("in the picture of a step more pixels may differ if it is as bright as before") {
    const auto with_row = [](float change, float next) {
        Image test = scene();
        for (int x = 80; x < 120; x += 2) test(x, 80) *= 1 + change, test(x + 1, 80) *= 1 + next;
        return compare_pixels(test, scene());
    };
    CHECK_FALSE(conclude(with_row(0.01f, -0.01f)).same); // 40 pixels of 16,000
    CHECK(conclude(with_row(0.01f, -0.01f), 4).same);
    CHECK_FALSE(conclude(with_row(0.03f, 0.03f), 4).same); // a mistake prefers brighter or darker
    CHECK_FALSE(conclude(with_row(0.9f, -0.9f), 4).same);
}

TEST_CASE("the tolerance is absolute for dark pixels and relative for bright ones") {
    const auto differing = [](float value, float change) {
        Image a(1, 1), b(1, 1);
        b(0, 0) = vec3(value);
        a(0, 0) = vec3(value, value, value + change);
        return compare_pixels(a, b).differing;
    };
    CHECK(differing(0.1f, 0.0009f) == 0);
    CHECK(differing(0.1f, -0.0011f) == 1);
    CHECK(differing(100, 0.09f) == 0);
    CHECK(differing(100, 0.11f) == 1);
}

TEST_CASE(
    "a small change of the whole picture fails by its mean although each pixel is within the tolerance") {
    Image test = scene();
    for (vec3& pixel : test.pixels) pixel += vec3(0.0005f);
    const Difference d = compare_pixels(test, scene());
    CHECK(d.differing == 0);
    CHECK_FALSE(conclude(d).same);
    CHECK_ERROR(conclude(d).words, "mean 0.0005", "% brighter");
}

TEST_CASE("one pixel in a thousand may differ and two may not") {
    Image test = scene();
    for (int i = 0; i < 16; ++i) test.pixels[std::size_t(i) * 1000] += vec3(0.01f);
    CHECK(conclude(compare_pixels(test, scene())).same);
    test.pixels[77] += vec3(0.01f);
    CHECK_FALSE(conclude(compare_pixels(test, scene())).same);
}

TEST_CASE("a pixel that is NaN is the largest possible difference") {
    Image test = scene();
    test(3, 4).y = std::numeric_limits<float>::quiet_NaN();
    const Difference d = compare_pixels(test, scene());
    CHECK(d.x == 3);
    CHECK(d.y == 4);
    CHECK(d.differing == 1);
    CHECK_FALSE(conclude(d).same);
    CHECK_ERROR(conclude(d).words, "at 3,4", "not a number there");
    const Image still(width, height);
    CHECK_FALSE(conclude(compare_tiles(test, scene(), still, still)).same);
}

TEST_CASE("pictures of different sizes are an error that states both") {
    const Image a(160, 100), b(100, 160);
    CHECK_ERROR(error_of([&] { compare_pixels(a, b); }), "160 x 100", "100 x 160");
    CHECK_ERROR(error_of([&] { compare_tiles(a, a, a, b); }), "160 x 100", "100 x 160");
    CHECK_ERROR(error_of([&] { compare_tiles(a, a, b, a); }), "160 x 100", "100 x 160");
    CHECK_ERROR(error_of([&] { compare_tiles(a, b, a, a); }), "160 x 100", "100 x 160");
}

TEST_CASE("two correct renders with different seeds are the same picture up to noise") {
    const Image truth = scene();
    int outliers = 0, tiles = 0, failures = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const TileDifference d = compared(NoisyPicture(truth, 2 * seed), NoisyPicture(truth, 2 * seed + 1));
        CHECK(d.tiles == 20 * 13);
        outliers += d.outliers;
        tiles += d.tiles;
        failures += conclude(d).same ? 0 : 1;
    }
    CHECK_MESSAGE(failures == 0, (std::to_string(failures) + " of 20 correct pairs were called different"));
    CHECK_MESSAGE(outliers <= 3,
                  (std::to_string(outliers) + " false outliers in " + std::to_string(tiles) + " tiles"));
}

TEST_CASE("z has a standard normal distribution if only noise differs") {
    const Image truth = scene();
    double squares = 0;
    int count = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) { // one tile at a time
        Image tile(8, 8);
        for (vec3& pixel : tile.pixels) pixel = truth(70, 70);
        const double z = compared(NoisyPicture(tile, 2 * seed), NoisyPicture(tile, 2 * seed + 1)).largest_z;
        squares += z * z;
        ++count;
    }
    CHECK(squares / count > 0.7); // 1, within four standard errors of .1 and the skewness of the samples
    CHECK(squares / count < 1.4);
}

TEST_CASE("a bias is located in its tile with its sign and size") {
    Image changed = scene();
    for (int y = 48; y < 56; ++y) {
        for (int x = 104; x < 112; ++x) changed(x, y) *= 1.2f;
    }
    const NoisyPicture right(scene(), 5), wrong(changed, 6);
    const TileDifference d = compared(wrong, right);
    CHECK(d.outliers == 1);
    CHECK(d.x == 104);
    CHECK(d.y == 48);
    CHECK(d.largest_z > 5);
    const Conclusion found = conclude(d);
    CHECK_FALSE(found.same);
    CHECK_ERROR(found.words, "different: 1 of 260 tiles", "at 104,48", "brighter by");
    const TileDifference swapped = compared(right, wrong);
    CHECK(swapped.largest_z == doctest::Approx(-d.largest_z));
    CHECK_ERROR(conclude(swapped).words, "darker by");
}

TEST_CASE("a change of the whole picture by a tenth marks many tiles") {
    Image changed = scene();
    for (vec3& pixel : changed.pixels) pixel *= 0.9f;
    const TileDifference d = compared(NoisyPicture(changed, 7), NoisyPicture(scene(), 8));
    CHECK(d.outliers > 100);
    CHECK(d.largest_z < -4);
}

TEST_CASE("tiles without noise are compared directly") {
    const Image still(width, height);
    Image test = scene();
    test(10, 10) += vec3(0.03f); // 0.03 / 64 is within the tolerance for the tile's mean
    CHECK(conclude(compare_tiles(test, scene(), still, still)).same);
    test(10, 10) -= vec3(0.13f);
    const TileDifference d = compare_tiles(test, scene(), still, still);
    CHECK(d.outliers == 1);
    CHECK(d.x == 8);
    CHECK(d.y == 8);
    CHECK(d.largest_z == -std::numeric_limits<double>::infinity());
    CHECK_FALSE(conclude(d).same);
}

TEST_CASE("rounding to .hdr is not reported as a difference if there is almost no noise") {
    Image test = scene(), reference = scene(), variance(width, height);
    Random random(1);
    for (std::size_t i = 0; i < test.pixels.size(); ++i) {
        test.pixels[i] += vec3((random.get_1d() - 0.5f) / 512);
        reference.pixels[i] += vec3((random.get_1d() - 0.5f) / 512);
        variance.pixels[i] = vec3(1e-12f);
    }
    CHECK(conclude(compare_tiles(test, reference, variance, variance)).same);
}
