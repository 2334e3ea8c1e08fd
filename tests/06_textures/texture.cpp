// Facts about textures: the decoding of file values to linear light, and interpolation between texels.
#include "06_textures/texture.h"
#include "common/math/random.h"
#include "tests/06_textures/step.h"
#include "tests/check.h"

#include <vector>

using namespace rt;

// ----------------------------------------------------------------------------------------- sRGB decode

TEST_CASE("an sRGB value is decoded to linear light by the exact curve") {
    const std::string hint = "the value itself: not decoded (pale); .7354 for .5: encoded instead; .2176 for "
                             ".5: a power of 2.2, which is most inaccurate in dark colours";
    CHECK_MESSAGE(linear_from_srgb(0.5f) == approx(0.2140411f, 1e-6f), hint);
    CHECK_MESSAGE(linear_from_srgb(128.0f / 255) == approx(0.2158605f, 1e-6f), hint);
    CHECK_MESSAGE(linear_from_srgb(0.02f) == approx(0.0015480f, 1e-7f),
                  ".00018: the linear segment is missing");
    CHECK(linear_from_srgb(0) == 0);
    CHECK(linear_from_srgb(1) == approx(1, 1e-6f));
}

TEST_CASE("the two pieces of the sRGB curve meet, and it increases everywhere") {
    CHECK(linear_from_srgb(0.04045f) == approx(0.0031308f, 1e-6f));
    CHECK(linear_from_srgb(0.04046f) - linear_from_srgb(0.04044f) == approx(0.00002f / 12.92f, 5e-7f));
    for (int i = 0; i < 1000; ++i)
        if (!(linear_from_srgb(float(i) / 1000) < linear_from_srgb(float(i + 1) / 1000)))
            FAIL_CHECK("the curve decreases at ", float(i) / 1000);
}

TEST_CASE("decoding inverts encoding") {
    for (int i = 0; i <= 255; ++i) {
        const float value = float(i) / 255;
        if (!(srgb_from_linear(linear_from_srgb(value)) == approx(value, 2e-5f)))
            FAIL_CHECK("code ", i, " becomes ", 255 * srgb_from_linear(linear_from_srgb(value)));
    }
}

TEST_CASE("a file's values are decoded once and keep their position and channel") {
    const Texture texture = make_texture(
        {3,
         2,
         {code(128), code(0), code(255), code(5), code(64), code(200), code(17), code(99), code(250),
          code(10), code(20), code(30), code(40), code(50), code(60), code(70), code(80), code(90)}});
    REQUIRE(texture.width == 3);
    REQUIRE(texture.height == 2);
    REQUIRE(texture.texels.size() == 6);
    CHECK_MESSAGE(texture.texels[0] == approx({0.2158605f, 0, 1}, 1e-6f),
                  ".5: not decoded; .0382: decoded twice");
    CHECK(texture.texels[1] == approx({5 / 255.0f / 12.92f, 0.0512695f, 0.5775804f}, 1e-6f));
    CHECK(texture.texels[3] == approx({linear_from_srgb(10 / 255.0f), linear_from_srgb(20 / 255.0f),
                                       linear_from_srgb(30 / 255.0f)},
                                      1e-6f));
}

TEST_CASE("16-bit values keep what 8 bits would lose") {
    const Texture texture = make_texture({1, 1, {32768, 1, 65535}});
    CHECK(texture.texels[0].x == approx(0.2140482f, 1e-6f));
    CHECK(texture.texels[0].y > 0);
    CHECK(texture.texels[0].y < 2e-6f);
    CHECK(texture.texels[0].z == approx(1, 1e-6f));
}

// --------------------------------------------------------------------------------------- texels and uv

TEST_CASE("row 0 is the lowest row of the texture and column 0 is the leftmost") {
    CHECK_MESSAGE(texel(card(), 0, 0) == grey,
                  "red: upside down; a file begins with its top row, v begins at the bottom");
    CHECK_MESSAGE(texel(card(), 2, 0) == orange, "blue: u and v are swapped, or upside down");
    CHECK(texel(card(), 0, 1) == red);
    CHECK(texel(card(), 1, 1) == green);
    CHECK(texel(card(), 2, 1) == blue);
}

TEST_CASE("an index past either end wraps around to the other end") {
    for (const int size : {1, 3, 5, 8}) {
        for (int index = -20; index <= 20; ++index) {
            INFO("index ", index, ", size ", size);
            const int wrapped = wrap(index, size);
            CHECK(wrapped >= 0);
            CHECK(wrapped < size);
            CHECK_MESSAGE((index - wrapped) % size == 0,
                          "mirrored or clamped: -1 is the last texel, -2 the one before it");
        }
    }
    CHECK(wrap(-1, 5) == 4);
    CHECK(wrap(5, 5) == 0);
    CHECK(texel(card(), -1, -1) == blue);
    CHECK(texel(card(), 3, 2) == grey);
}

TEST_CASE("the centre of a texel returns the texel exactly") {
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            INFO("texel ", x, ", ", y, " from below");
            CHECK_MESSAGE(bilinear(card(), {(float(x) + 0.5f) / 3, (float(y) + 0.5f) / 2}) ==
                              approx(texel(card(), x, y), 2e-6f),
                          "a mean of neighbours: an offset of half a texel is missing; a value applies at "
                          "the texel's centre");
        }
    }
    const Texture checker = texture_of(4, 4, std::vector<vec3>(16, grey));
    Texture powers = checker;
    for (std::size_t i = 0; i < 16; ++i) powers.texels[i] = vec3(float(i) / 16, float(i), 0.1f * float(i));
    for (int i = 0; i < 16; ++i)
        CHECK(bilinear(powers, {(float(i % 4) + 0.5f) / 4, (float(i / 4) + 0.5f) / 4}) ==
              texel(powers, i % 4, i / 4));
}

TEST_CASE("halfway between two texels is the mean of their linear light") {
    CHECK_MESSAGE(bilinear(card(), {2 / 6.0f, 0.25f}) == approx((grey + cyan) / 2.0f, 2e-6f),
                  "one of the two: nearest texel instead of bilinear");
    CHECK(bilinear(card(), {4 / 6.0f, 0.75f}) == approx((green + blue) / 2.0f, 2e-6f));
    CHECK_MESSAGE(bilinear(card(), {0.5f, 0.5f}) == approx((green + cyan) / 2.0f, 2e-6f), "vertically, too");
    CHECK(bilinear(card(), {2 / 6.0f, 0.5f}) == approx((grey + cyan + red + green) / 4.0f, 2e-6f));

    const Texture two = make_texture({2, 1, {0, 0, 0, 65535, 65535, 65535}});
    CHECK_MESSAGE(bilinear(two, {0.5f, 0.5f}) == approx(vec3(0.5f)), ".2140: interpolated before decoding");
}

TEST_CASE("four texels are weighted by their distance") {
    // A third of the way from grey to cyan, a fifth of the way up to red and green.
    const vec2 uv{(0.5f + 1 / 3.0f) / 3, (0.5f + 0.2f) / 2};
    const vec3 lower = mix(grey, cyan, 1 / 3.0f), upper = mix(red, green, 1 / 3.0f);
    CHECK_MESSAGE(bilinear(card(), uv) == approx(mix(lower, upper, 0.2f), 5e-6f),
                  "the weights of u and v, or of near and far, are swapped");
}

TEST_CASE("at the border the first and the last texel are interpolated") {
    CHECK_MESSAGE(bilinear(card(), {0, 0.25f}) == approx((grey + orange) / 2.0f, 2e-6f),
                  "grey alone: clamped");
    CHECK(bilinear(card(), {1, 0.25f}) == approx((grey + orange) / 2.0f, 2e-6f));
    CHECK(bilinear(card(), {0.5f, 0}) == approx((cyan + green) / 2.0f, 2e-6f));
    CHECK(bilinear(card(), {0.5f, 1}) == approx((cyan + green) / 2.0f, 2e-6f));
    CHECK(bilinear(card(), {0, 0}) == approx((grey + orange + red + blue) / 4.0f, 2e-6f));
}

TEST_CASE("a texture repeats in both directions including left and down") {
    Random random(71);
    for (int i = 0; i < 2000; ++i) {
        const vec2 uv = random.get_2d();
        const vec2 shift{float(int(random.get_1d() * 13) - 6), float(int(random.get_1d() * 13) - 6)};
        if (!(bilinear(card(), uv + shift) == approx(bilinear(card(), uv), 2e-5f)))
            FAIL_CHECK("f(u + k) = f(u): at uv = ", uv, " and k = ", shift, " it is ",
                       bilinear(card(), uv + shift), " instead of ", bilinear(card(), uv),
                       " (below 0: mirrored or clamped)");
    }
    CHECK(bilinear(card(), {-1 / 6.0f, -0.25f}) == approx(blue, 2e-6f));
}

TEST_CASE("interpolation is continuous even across borders and close to zero") {
    const auto near = [](vec3 a, vec3 b) { return a == approx(b, 1e-3f); };
    for (int i = -4000; i < 4000; ++i) {
        const float s = float(i) / 2000 * 1.0001f, step = 1e-5f;
        if (!near(bilinear(card(), {s, 0.37f}), bilinear(card(), {s + step, 0.37f})))
            FAIL_CHECK("discontinuous at u = ", s);
        if (!near(bilinear(card(), {0.37f, s}), bilinear(card(), {0.37f, s + step})))
            FAIL_CHECK("discontinuous at v = ", s);
    }
    for (const float tiny : {-1e-3f, -1e-7f, -1e-9f, -1e-30f, -0.0f, 1e-30f, 1e-9f, 1e-7f}) {
        INFO("u = v = ", tiny);
        CHECK(bilinear(card(), vec2(tiny)) == approx(bilinear(card(), vec2(0)), 5e-3f));
        CHECK(bilinear(card(), 1.0f + vec2(tiny)) == approx(bilinear(card(), vec2(0)), 5e-3f));
    }
}

TEST_CASE("a single texel fills everything and no uv produces a value out of range") {
    const Texture one = texture_of(1, 1, {orange});
    for (const float u : {-3.3f, 0.0f, 0.2f, 0.5f, 1.0f, 7.9f})
        CHECK(bilinear(one, {u, -u}) == approx(orange));
    for (const float huge : {1e6f, -1e7f, 3e9f, -1e30f, 3e38f}) {
        INFO("uv ", huge);
        const vec3 value = bilinear(card(), {huge, 0.3f * huge});
        CHECK_MESSAGE(is_finite(value), "apply fract before the cast to int, which overflows");
        CHECK(all(greaterThanEqual(value, vec3(0))));
        CHECK(all(lessThanEqual(value, vec3(1))));
    }
}

TEST_CASE("the tint multiplies a texture, uv_scale repeats it, and emission is unaffected") {
    const std::vector<Texture> textures = {texture_of(1, 1, {grey}), card()};
    const vec2 uv{0.31f, 0.83f};
    const Diffuse plain = evaluate(ImageTexture{1}, textures, uv);
    CHECK_MESSAGE(plain.albedo == approx(bilinear(card(), uv)), ".3: the wrong texture of two");
    CHECK(plain.emission == vec3(0));
    const Diffuse tinted =
        evaluate(ImageTexture{.texture = 1, .tint = {0.5f, 0.2f, 0.8f}, .emission = {3, 0, 1}}, textures, uv);
    CHECK(tinted.albedo == approx(vec3(0.5f, 0.2f, 0.8f) * bilinear(card(), uv)));
    CHECK(tinted.emission == vec3(3, 0, 1));
    const Diffuse tiled = evaluate(ImageTexture{.texture = 1, .uv_scale = {3, 5}}, textures, uv);
    CHECK_MESSAGE(tiled.albedo == approx(bilinear(card(), {0.93f, 0.15f}), 2e-5f),
                  "uv times uv_scale: u by x and v by y");
}
