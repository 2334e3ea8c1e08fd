// Facts about explanations: each known cause is named, and none is claimed without evidence.
#include "tools/compare/explain.h"
#include "tests/compare/pictures.h"

#include <doctest/doctest.h>

#include <functional>
#include <vector>

using namespace rt;
using namespace rt::compare;
using namespace rt::malformed;

namespace {

const std::vector<std::string> storages{"floats", ".hdr", ".png"};

EncodedImage encoded(const Image& image, const std::string& how) {
    return how == "floats" ? EncodedImage{image} : through_file(image, how);
}

std::string explained(const Image& test, const Image& reference, const std::string& how = "floats") {
    return explain(encoded(test, how), encoded(reference, how), {});
}

std::string explained_noisy(const Image& test, const Image& reference) {
    const NoisyPicture a(test, 1), b(reference, 2);
    return explain({a.mean}, {b.mean}, {a.variance, b.variance});
}

vec3 power(vec3 colour, float exponent) {
    return pow(colour, vec3(exponent));
}

} // namespace

TEST_CASE("a mirrored or rotated picture is explained, in floats, in files and under noise") {
    const Image right = lopsided(96, 64), square = lopsided(64, 64);
    for (const std::string& how : storages) {
        INFO(how);
        CHECK(explained(mirrored(right, true, false), right, how) == "flipped left to right");
        CHECK(explained(mirrored(right, false, true), right, how) == "flipped upside down");
        CHECK(explained(mirrored(right, true, true), right, how) ==
              "rotated by 180 degrees (flipped in x and y)");
        CHECK(explained(transposed(square), square, how) == "rows and columns swapped");
    }
    CHECK(explained_noisy(mirrored(right, true, false), right) == "flipped left to right");
    CHECK(explained_noisy(mirrored(right, false, true), right) == "flipped upside down");
    CHECK(explained_noisy(transposed(square), square) == "rows and columns swapped");
}

TEST_CASE("a picture with changed colours is explained, in floats, in files and under noise") {
    const Image right = lopsided(96, 64);
    const std::vector<std::pair<std::string, std::function<vec3(vec3)>>> slips{
        {"red and blue swapped", [](vec3 c) { return vec3(c.z, c.y, c.x); }},
        {"the sRGB encoding is missing", srgb_decoded},
        {"the sRGB encoding is done twice", srgb_encoded},
        {"gamma 2.2 instead of sRGB", [](vec3 c) { return srgb_decoded(power(c, 1 / 2.2f)); }},
        {"a square root instead of sRGB", [](vec3 c) { return srgb_decoded(power(c, 0.5f)); }}};
    for (const auto& [name, slip] : slips) {
        const Image wrong = changed(right, slip);
        for (const std::string& how : storages) {
            INFO(how);
            CHECK(explained(wrong, right, how) == name);
        }
    }
    CHECK(explained_noisy(changed(right, slips[0].second), right) == slips[0].first);
}

TEST_CASE("one gain for the whole picture is explained and named if it has a name") {
    const Image right = lopsided(96, 64);
    const double exact_pi = 3.14159265358979;
    const std::vector<std::pair<std::string, double>> gains{
        {"pi", exact_pi},       {"1/pi", 1 / exact_pi},           {"2", 2},     {"1/2", 0.5},
        {"4 pi", 4 * exact_pi}, {"1/(4 pi)", 1 / (4 * exact_pi)}, {"1.3", 1.3}, {"0.88", 0.88}};
    for (const auto& [named, gain] : gains) {
        const std::string name = named; // INFO is evaluated later and cannot capture a structured binding
        const auto brighter = [gain = float(gain)](vec3 c) { return c * gain; };
        const Image dim =
            changed(right, [](vec3 c) { return c * 0.06f; }); // so that a PNG can hold 4 pi of it
        INFO(name);
        CHECK(explained(changed(right, brighter), right) == "the whole picture times " + name);
        CHECK(explained(changed(right, brighter), right, ".hdr") == "the whole picture times " + name);
        if (gain > 1.5)
            CHECK(explained(changed(dim, brighter), dim, ".png") == "the whole picture times " + name);
        if (gain > 1.5 || gain < 0.6)
            CHECK(explained_noisy(changed(right, brighter), right) == "the whole picture times " + name);
    }
}

TEST_CASE("a gain is found although the PNG is clamped at white") {
    const Image right = lopsided(96, 64);
    const Image bright = changed(right, [](vec3 c) { return c * 2.0f; });
    CHECK(explained(bright, right, ".png") == "the whole picture times 2");
}

TEST_CASE("a shift by half a pixel is explained and a shift by a whole pixel is not called half a pixel") {
    const Image right = lopsided(96, 64);
    for (const std::string how : {"floats", ".hdr"}) {
        INFO(how);
        CHECK(explained(lopsided(96, 64, 0.5f, 0), right, how) == "shifted half a pixel to the left");
        CHECK(explained(lopsided(96, 64, 0, -0.5f), right, how) == "shifted half a pixel down");
        CHECK(explained(lopsided(96, 64, -0.5f, 0.5f), right, how) ==
              "shifted half a pixel to the right and up");
        CHECK(explained(lopsided(96, 64, 1, 0), right, how) == none_of_these);
    }
}

TEST_CASE("a shift by half a pixel is explained under noise") {
    // Steep enough that the noise of 64 samples does not hide it.
    const auto stripes = [](float left) {
        Image image(96, 64);
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 96; ++x) image(x, y) = vec3(1 + 0.98f * std::sin((float(x) + left) * 0.39f));
        return image;
    };
    CHECK(explained_noisy(stripes(0.5f), stripes(0)) == "shifted half a pixel to the left");
}

TEST_CASE("a picture with an unknown cause is not explained") {
    const Image right = lopsided(96, 64);
    Image ball = right; // an additional ball
    for (int y = 20; y < 40; ++y)
        for (int x = 20; x < 40; ++x) ball(x, y) = vec3(0.9f, 0.1f, 0.1f);
    const Image lifted = changed(right, [](vec3 c) { return c + 0.1f; });
    const Image random = changed(right, [source = Random(5)](vec3) mutable { return vec3(source.get_1d()); });
    for (const std::string& how : storages) {
        INFO(how);
        CHECK(explained(ball, right, how) == none_of_these);
        CHECK(explained(lifted, right, how) == none_of_these);
        CHECK(explained(random, right, how) == none_of_these);
        CHECK(explained(mirrored(ball, true, false), right, how) == none_of_these); // two causes together
    }
    CHECK(explained_noisy(ball, right) == none_of_these);
}

TEST_CASE("equal pictures need no explanation even if they are symmetric") {
    const Image right = lopsided(96, 64), flat = changed(right, [](vec3) { return vec3(0.5f); });
    const Image black(96, 64);
    for (const Image& image : {right, flat, black})
        for (const std::string& how : storages) CHECK(explained(image, image, how).empty());
    CHECK(explained_noisy(right, right).empty());
    // The rounding in a PNG of the correct picture needs no explanation either.
    CHECK(explain(through_file(right, ".png"), through_file(right, ".hdr"), {}).empty());
}

TEST_CASE("black, constant and symmetric pictures are not explained by changes that leave them unchanged") {
    const Image right = lopsided(96, 64), black(96, 64);
    const auto flat = [&](float value) { return changed(right, [value](vec3) { return vec3(value); }); };
    for (const std::string& how : storages) {
        INFO(how);
        CHECK(explained(black, right, how) == none_of_these);
        CHECK(explained(right, black, how) == none_of_these);
        CHECK(explained(flat(0.2f), flat(0.5f), how) == none_of_these); // any gain would fit
        CHECK(explained(flat(1), right, how) == none_of_these);
    }
    CHECK(explained(flat(0.5f), flat(0.25f)) == "the whole picture times 2"); // but 2 is a slip that is made
    Image symmetric = right;
    for (int y = 0; y < 64; ++y)
        for (int x = 48; x < 96; ++x) symmetric(x, y) = symmetric(95 - x, y);
    CHECK(explained(mirrored(symmetric, false, true), symmetric) ==
          "flipped upside down"); // the simpler of two
    CHECK(explained(changed(symmetric, [](vec3 c) { return c + 0.2f; }), symmetric) == none_of_these);
    Image defect = symmetric;
    for (int i = 0; i < 60; ++i) defect(3 + i % 10, 5 + i / 10) = vec3(0.9f);
    CHECK(explained(defect, symmetric) == none_of_these);
}

TEST_CASE("a picture with a pixel that is NaN is not explained") {
    const Image right = lopsided(96, 64);
    Image wrong = mirrored(right, true, false);
    wrong(3, 4).y = infinity;
    CHECK(explained(wrong, right) == none_of_these);
}

TEST_CASE("explaining pictures of different sizes is an error that states both") {
    CHECK_ERROR(error_of([] { explained(Image(3, 2), Image(2, 3)); }), "3 x 2", "2 x 3");
}
