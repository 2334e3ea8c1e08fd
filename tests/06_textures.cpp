// Facts about pictures on surfaces: what a value in a file means as light, what lies between two texels, and
// where on a surface each point of the picture comes to lie.
#include "06_textures/radiance.h"
#include "06_textures/scene.h"
#include "common/image.h"
#include "common/random.h"
#include "tests/check.h"

#include <chrono>
#include <filesystem>
#include <fstream>

using namespace rt;

namespace {

/// An sRGB code of 0 to 255 as a Bitmap holds it.
std::uint16_t code(int value) {
    return std::uint16_t(value * 257);
}

/// A texture straight from linear colours, row by row from the top.
Texture texture_of(int width, int height, const std::vector<vec3>& texels) {
    return {width, height, texels};
}

/// 3 x 2, no two texels alike, nothing symmetric:   red  green blue
///                                                   grey  cyan  orange
const vec3 red{0.9f, 0.1f, 0.05f}, green{0.1f, 0.8f, 0.2f}, blue{0.05f, 0.1f, 0.7f};
const vec3 grey{0.3f, 0.3f, 0.3f}, cyan{0.1f, 0.6f, 0.65f}, orange{0.95f, 0.5f, 0.1f};
Texture card() {
    return texture_of(3, 2, {red, green, blue, grey, cyan, orange});
}

/// A scene under a sky that makes E = pi everywhere, so that the radiance of a matte surface is its albedo.
Scene evenly_lit() {
    Scene scene;
    scene.sky = {vec3(1), vec3(1)};
    return scene;
}

int add_texture(Scene& scene, const Texture& texture) {
    scene.textures.push_back(texture);
    return int(scene.textures.size()) - 1;
}

/// A folder that goes away with everything in it.
class Folder {
  public:
    Folder() {
        Random random{std::uint64_t(std::chrono::steady_clock::now().time_since_epoch().count())};
        path = std::filesystem::temp_directory_path() / ("raysteps_06_" + std::to_string(random.bits()));
        std::filesystem::create_directory(path);
    }
    ~Folder() { std::filesystem::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string file(const std::string& name) const { return (path / name).string(); }
    void write(const std::string& name, const std::string& text) const { std::ofstream(path / name) << text; }
    /// A picture of one colour; returned is that colour as 8 bits keep it.
    vec3 write_picture(const std::string& name, vec3 linear) const {
        Image image(2, 3);
        for (vec3& pixel : image.pixels) pixel = linear;
        write_image(file(name), image);
        return read_image(file(name))(0, 0);
    }

  private:
    std::filesystem::path path;
};

/// What the eye sees of the scene from straight above at (x, y), with z up.
vec3 seen_at(const Scene& scene, float x, float y) {
    return radiance(scene, Ray{{x, y, 5}, {0, 0, -2}}, 4);
}

} // namespace

// ----------------------------------------------------------------------------------------- sRGB decode

TEST_CASE("an sRGB value is decoded to linear light by the exact curve") {
    const std::string hint =
        "the value itself: not decoded (pale); .7354 for .5: encoded instead; .2176 for .5: a power "
        "of 2.2, which is wrong in the dark most of all";
    CHECK_MESSAGE(linear_from_srgb(0.5f) == approx(0.2140411f, 1e-6f), hint);
    CHECK_MESSAGE(linear_from_srgb(128.0f / 255) == approx(0.2158605f, 1e-6f), hint);
    CHECK_MESSAGE(linear_from_srgb(0.02f) == approx(0.0015480f, 1e-7f), ".00018: the linear toe is missing");
    CHECK(linear_from_srgb(0) == 0);
    CHECK(linear_from_srgb(1) == approx(1, 1e-6f));
}

TEST_CASE("the two pieces of the sRGB curve meet, and it grows everywhere") {
    CHECK(linear_from_srgb(0.04045f) == approx(0.0031308f, 1e-6f));
    CHECK(linear_from_srgb(0.04046f) - linear_from_srgb(0.04044f) == approx(0.00002f / 12.92f, 5e-7f));
    for (int i = 0; i < 1000; ++i)
        if (!(linear_from_srgb(float(i) / 1000) < linear_from_srgb(float(i + 1) / 1000)))
            FAIL_CHECK("it falls at ", float(i) / 1000);
}

TEST_CASE("decoding undoes what encoding did") {
    for (int i = 0; i <= 255; ++i) {
        const float value = float(i) / 255;
        if (!(srgb_from_linear(linear_from_srgb(value)) == approx(value, 2e-5f)))
            FAIL_CHECK("code ", i, " becomes ", 255 * srgb_from_linear(linear_from_srgb(value)));
    }
}

TEST_CASE("a file's values are decoded once and keep their place and channel") {
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

TEST_CASE("row 0 is the lowest row of the picture, column 0 its left one") {
    CHECK_MESSAGE(texel(card(), 0, 0) == grey,
                  "red: upside down; a file begins with its top row, v begins below");
    CHECK_MESSAGE(texel(card(), 2, 0) == orange, "blue: u and v exchanged, or upside down");
    CHECK(texel(card(), 0, 1) == red);
    CHECK(texel(card(), 1, 1) == green);
    CHECK(texel(card(), 2, 1) == blue);
}

TEST_CASE("an index past either end comes back in at the other") {
    for (const int size : {1, 3, 5, 8}) {
        for (int index = -20; index <= 20; ++index) {
            INFO("index ", index, ", size ", size);
            const int wrapped = wrap(index, size);
            CHECK(wrapped >= 0);
            CHECK(wrapped < size);
            CHECK_MESSAGE((index - wrapped) % size == 0,
                          "mirrored or clamped: -1 is the LAST one, -2 the one before");
        }
    }
    CHECK(wrap(-1, 5) == 4);
    CHECK(wrap(5, 5) == 0);
    CHECK(texel(card(), -1, -1) == blue);
    CHECK(texel(card(), 3, 2) == grey);
}

TEST_CASE("the middle of a texel returns the texel exactly") {
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            INFO("texel ", x, ", ", y, " from below");
            CHECK_MESSAGE(
                bilinear(card(), {(float(x) + 0.5f) / 3, (float(y) + 0.5f) / 2}) ==
                    approx(texel(card(), x, y), 2e-6f),
                "a mean of neighbours: half a texel is missing, a value holds in the texel's middle");
        }
    }
    const Texture checker = texture_of(4, 4, std::vector<vec3>(16, grey));
    Texture powers = checker;
    for (std::size_t i = 0; i < 16; ++i) powers.texels[i] = vec3(float(i) / 16, float(i), 0.1f * float(i));
    for (int i = 0; i < 16; ++i)
        CHECK(bilinear(powers, {(float(i % 4) + 0.5f) / 4, (float(i / 4) + 0.5f) / 4}) ==
              texel(powers, i % 4, i / 4));
}

TEST_CASE("half way between two texels lies the mean of their LIGHT") {
    CHECK_MESSAGE(bilinear(card(), {2 / 6.0f, 0.25f}) == approx((grey + cyan) / 2.0f, 2e-6f),
                  "one of the two: nearest texel in place of bilinear");
    CHECK(bilinear(card(), {4 / 6.0f, 0.75f}) == approx((green + blue) / 2.0f, 2e-6f));
    CHECK_MESSAGE(bilinear(card(), {0.5f, 0.5f}) == approx((green + cyan) / 2.0f, 2e-6f),
                  "and one above the other");
    CHECK(bilinear(card(), {2 / 6.0f, 0.5f}) == approx((grey + cyan + red + green) / 4.0f, 2e-6f));

    const Texture two = make_texture({2, 1, {0, 0, 0, 65535, 65535, 65535}});
    CHECK_MESSAGE(bilinear(two, {0.5f, 0.5f}) == approx(vec3(0.5f)), ".2140: blended before it was decoded");
}

TEST_CASE("between four texels each counts by how near it is") {
    // A third of the way from grey to cyan, a fifth of the way up to red and green.
    const vec2 uv{(0.5f + 1 / 3.0f) / 3, (0.5f + 0.2f) / 2};
    const vec3 lower = mix(grey, cyan, 1 / 3.0f), upper = mix(red, green, 1 / 3.0f);
    CHECK_MESSAGE(bilinear(card(), uv) == approx(mix(lower, upper, 0.2f), 5e-6f),
                  "the weights of u and v, or of near and far, are exchanged");
}

TEST_CASE("at the border the first and the last texel blend") {
    CHECK_MESSAGE(bilinear(card(), {0, 0.25f}) == approx((grey + orange) / 2.0f, 2e-6f),
                  "grey alone: clamped");
    CHECK(bilinear(card(), {1, 0.25f}) == approx((grey + orange) / 2.0f, 2e-6f));
    CHECK(bilinear(card(), {0.5f, 0}) == approx((cyan + green) / 2.0f, 2e-6f));
    CHECK(bilinear(card(), {0.5f, 1}) == approx((cyan + green) / 2.0f, 2e-6f));
    CHECK(bilinear(card(), {0, 0}) == approx((grey + orange + red + blue) / 4.0f, 2e-6f));
}

TEST_CASE("a picture repeats in both directions, to the left and downward too") {
    Random random(71);
    for (int i = 0; i < 2000; ++i) {
        const vec2 uv = random.uniform2();
        const vec2 shift{float(int(random.uniform() * 13) - 6), float(int(random.uniform() * 13) - 6)};
        if (!(bilinear(card(), uv + shift) == approx(bilinear(card(), uv), 2e-5f)))
            FAIL_CHECK("f(u + k) = f(u): at uv = ", uv, " and k = ", shift, " it is ",
                       bilinear(card(), uv + shift), " in place of ", bilinear(card(), uv),
                       " (below 0: mirrored or clamped)");
    }
    CHECK(bilinear(card(), {-1 / 6.0f, -0.25f}) == approx(blue, 2e-6f));
}

TEST_CASE("the blend is continuous, across borders and just beside zero too") {
    const auto near = [](vec3 a, vec3 b) { return a == approx(b, 1e-3f); };
    for (int i = -4000; i < 4000; ++i) {
        const float s = float(i) / 2000 * 1.0001f, step = 1e-5f;
        if (!near(bilinear(card(), {s, 0.37f}), bilinear(card(), {s + step, 0.37f})))
            FAIL_CHECK("it jumps at u = ", s);
        if (!near(bilinear(card(), {0.37f, s}), bilinear(card(), {0.37f, s + step})))
            FAIL_CHECK("it jumps at v = ", s);
    }
    for (const float tiny : {-1e-3f, -1e-7f, -1e-9f, -1e-30f, -0.0f, 1e-30f, 1e-9f, 1e-7f}) {
        INFO("u = v = ", tiny);
        CHECK(bilinear(card(), vec2(tiny)) == approx(bilinear(card(), vec2(0)), 5e-3f));
        CHECK(bilinear(card(), 1.0f + vec2(tiny)) == approx(bilinear(card(), vec2(0)), 5e-3f));
    }
}

TEST_CASE("one texel fills everything, and no uv makes a value that was not there") {
    const Texture one = texture_of(1, 1, {orange});
    for (const float u : {-3.3f, 0.0f, 0.2f, 0.5f, 1.0f, 7.9f})
        CHECK(bilinear(one, {u, -u}) == approx(orange));
    for (const float huge : {1e6f, -1e7f, 3e9f, -1e30f, 3e38f}) {
        INFO("uv ", huge);
        const vec3 value = bilinear(card(), {huge, 0.3f * huge});
        CHECK_MESSAGE(is_finite(value), "take fract before the cast to int, which overflows");
        CHECK(all(greaterThanEqual(value, vec3(0))));
        CHECK(all(lessThanEqual(value, vec3(1))));
    }
}

TEST_CASE("tint multiplies a picture, repeat tiles it, emission stands beside it") {
    const std::vector<Texture> textures = {texture_of(1, 1, {grey}), card()};
    const vec2 uv{0.31f, 0.83f};
    const Diffuse plain = at(Textured{1}, textures, uv);
    CHECK_MESSAGE(plain.albedo == approx(bilinear(card(), uv)), ".3: the wrong one of two textures");
    CHECK(plain.emission == vec3(0));
    const Diffuse tinted =
        at(Textured{.texture = 1, .tint = {0.5f, 0.2f, 0.8f}, .emission = {3, 0, 1}}, textures, uv);
    CHECK(tinted.albedo == approx(vec3(0.5f, 0.2f, 0.8f) * bilinear(card(), uv)));
    CHECK(tinted.emission == vec3(3, 0, 1));
    const Diffuse tiled = at(Textured{.texture = 1, .repeat = {3, 5}}, textures, uv);
    CHECK_MESSAGE(tiled.albedo == approx(bilinear(card(), {0.93f, 0.15f}), 2e-5f),
                  "uv times repeat, u by x and v by y");
}

// ------------------------------------------------------------------------------- where it comes to lie

TEST_CASE("on a sphere v is 0 at the south pole, .5 at the equator and 1 at the north pole") {
    CHECK_MESSAGE(sphere_uv({0, -1, 0}).y == approx(0), "1: upside down");
    CHECK(sphere_uv({0, 1, 0}).y == approx(1));
    CHECK(sphere_uv(normalize(vec3(3, 0, -2))).y == approx(0.5f));
    CHECK_MESSAGE(sphere_uv(normalize(vec3(0.6f, 1, -0.8f))).y == approx(0.75f),
                  "45 degrees north is half way from the equator: v goes by the angle, not by y (.854)");
    CHECK(sphere_uv(normalize(vec3(1.2f, -1, 1.6f))).y == approx(0.5f - std::atan(0.5f) / pi));
}

TEST_CASE("on a sphere u grows eastward from 0 to 1") {
    float previous = -1;
    for (int i = 1; i < 360; ++i) {
        // Looked at from outside with north up, east is to the right: from +z to +x, seen from between them.
        const float east = glm::radians(float(i) - 90);
        const float u = sphere_uv({0.8f * std::sin(east), 0.6f, 0.8f * std::cos(east)}).x;
        if (!(u >= 0 && u <= 1)) FAIL_CHECK("u = ", u, " lies outside [0, 1]");
        if (!(u > previous))
            FAIL_CHECK("u falls from ", previous, " to ", u, " at ", i, " degrees: a mirror Earth");
        previous = u;
    }
    CHECK(sphere_uv({0, 0, 1}).x == approx(sphere_uv({1, 0, 0}).x - 0.25f));
}

TEST_CASE("a point that rounding puts beyond a pole has a uv all the same") {
    for (const float y : {1.0000001f, -1.0000001f, 1.0f, -1.0f}) {
        const vec2 uv = sphere_uv({0, y, 0});
        INFO("y = ", y, ": uv = ", uv);
        CHECK_MESSAGE(std::isfinite(uv.x), "asin of more than 1 is not a number");
        CHECK(uv.y == approx(y > 0 ? 1 : 0));
    }
}

TEST_CASE("a picture on a sphere is upright and not mirrored") {
    Scene scene = evenly_lit();
    const int picture = add_texture(scene, card());
    scene.spheres = {{{3, -1, 2}, 1.5f, add(scene, Textured{picture})}};
    prepare(scene);
    // From far out above the middle of each texel, whose longitude and latitude are known.
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            const float longitude = ((float(x) + 0.5f) / 3 - 0.5f) * 2 * pi,
                        latitude = ((float(y) + 0.5f) / 2 - 0.5f) * pi;
            const vec3 outward{std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                               -std::cos(latitude) * std::sin(longitude)};
            const Ray ray{vec3(3, -1, 2) + 9.0f * outward, -2.0f * outward};
            INFO("texel ", x, ", ", y);
            CHECK(radiance(scene, ray, 2) == approx(texel(card(), x, y), 1e-4f));
        }
    }
}

TEST_CASE("a picture on a quad has its lower left corner at the quad's corner") {
    Scene scene = evenly_lit();
    const int picture = add_texture(scene, card());
    // Oblique, and turned in its plane.
    const vec3 corner{-2, 1, -4}, u{3, 0.5f, 1}, v{-0.7f, 2, 0.4f};
    scene.quads = {{corner, u, v, add(scene, Textured{picture})}};
    prepare(scene);
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            const vec3 target = corner + (float(x) + 0.5f) / 3 * u + (float(y) + 0.5f) / 2 * v;
            const vec3 from{1, 2, 6};
            INFO("texel ", x, ", ", y);
            CHECK_MESSAGE(radiance(scene, Ray{from, target - from}, 2) == approx(texel(card(), x, y), 1e-4f),
                          "u runs along edge_u and v along edge_v");
        }
    }
}

TEST_CASE("a picture on a mesh follows the uv of the corners") {
    // Two triangles over [0, 3] x [0, 2] with the corners of each in another order.
    ObjFile file;
    file.positions = {{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {0, 2, 0}};
    file.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    file.triangles = {{{{0, 0}, {1, 1}, {2, 2}}}, {{{3, 3}, {0, 0}, {2, 2}}}};
    file.materials = {0, 0};
    Bitmap bitmap{3, 2, {}};
    for (int i = 0; i < 18; ++i) bitmap.values.push_back(code(14 * i));
    file.textures = {bitmap};
    file.material_list = {{.name = "card", .diffuse = vec3(1), .texture = 0}};
    Scene scene = evenly_lit();
    add(scene, file, 40);
    prepare(scene);
    const Texture texture = make_texture(bitmap);
    for (int i = 0; i < 29; ++i) {
        for (int k = 0; k < 19; ++k) {
            const float x = 0.1f + 0.1f * float(i), y = 0.1f + 0.1f * float(k) - 0.003f * float(i);
            if (!(seen_at(scene, x, y) == approx(bilinear(texture, {x / 3, y / 2}), 1e-4f)))
                FAIL_CHECK("at (", x, ", ", y, ") it shows ", seen_at(scene, x, y), " in place of ",
                           bilinear(texture, {x / 3, y / 2}),
                           " (torn at the diagonal: weights in the wrong order)");
        }
    }
    CHECK(seen_at(scene, 0.5f, 0.5f) == approx(texture.texels[3], 1e-4f));
    CHECK(seen_at(scene, 2.5f, 1.5f) == approx(texture.texels[2], 1e-4f));
}

TEST_CASE("a lit picture reflects albedo / pi of what arrives, and shines by itself where it is told to") {
    Scene scene;
    const int picture = add_texture(scene, texture_of(1, 1, {{0.8f, 0.4f, 0.2f}}));
    scene.planes = {{{0, 0, 0},
                     {0, 0, 1},
                     add(scene, Textured{.texture = picture, .tint = {0.5f, 1, 1}, .emission = {0, 0, 3}})}};
    scene.lights = {{{0, 0, 2}, vec3(pi)}};
    prepare(scene);
    CHECK(radiance(scene, Ray{{0.5f, 0, 1}, {-0.5f, 0, -1}}, 2) == approx(vec3(0.1f, 0.1f, 0.05f + 3)));
}

TEST_CASE("a reflective coat lies over a picture as over any other material") {
    Scene scene;
    scene.sky = {vec3(0.2f), vec3(1)};
    const int base = add(scene, Textured{add_texture(scene, card()), vec3(1)});
    const int mirror = add(scene, Mirror{});
    const int coat = add(scene, Reflective{0.3f, base});
    const auto seen = [&](int material) {
        scene.spheres = {{{0, 0, 0}, 2, material}};
        prepare(scene);
        return radiance(scene, Ray{{1, 1.2f, 5}, {-0.2f, 0.05f, -1}}, 3);
    };
    CHECK(seen(coat) == approx(0.7f * seen(base) + 0.3f * seen(mirror)));
}

// ----------------------------------------------------------------------------------------- the checker

TEST_CASE("a checker changes at every square, at zero too") {
    const Checker checker{vec3(0.8f), vec3(0.15f), 0.5f};
    for (int y = -5; y < 5; ++y) {
        for (int x = -5; x < 5; ++x) {
            INFO("square ", x, ", ", y);
            CHECK_MESSAGE(at(checker, {(float(x) + 0.3f) / 2, (float(y) + 0.7f) / 2}).albedo.x ==
                              ((x + y) % 2 == 0 ? 0.8f : 0.15f),
                          "a cast to int makes the two squares beside zero one");
        }
    }
}

TEST_CASE("a checker of .8 and .15 seen from far away averages .475") {
    // 400 x 400 rays over some 3,000 squares: the mean of a fair coin between .8 and .15 has a standard error
    // of .325 / 400 = .0008 (less, since the rays are spread evenly). |z| < 4: one false alarm in 16,000.
    Scene scene = evenly_lit();
    scene.planes = {{{0.3f, 0, 0.2f}, {0, 1, 0}, add(scene, Checker{vec3(0.8f), vec3(0.15f), 0.37f})}};
    prepare(scene);
    Random random(72);
    Mean mean;
    for (int i = 0; i < 160000; ++i) {
        const vec2 jitter = random.uniform2();
        const vec2 p = vec2(float(i % 400), float(i / 400)) + jitter;
        const vec3 from{0, 60, 0};
        const vec3 target{(p.x - 200) / 20, 0, (p.y - 200) / 20};
        mean.add(double(radiance(scene, Ray{from, target - from}, 1).x));
    }
    INFO(mean.against(0.475));
    CHECK(std::abs(mean.z(0.475)) < 4);
}

TEST_CASE("a texture of .8 and .15 seen from far away averages .475 too") {
    Scene scene = evenly_lit();
    const Texture squares = texture_of(2, 2, {vec3(0.8f), vec3(0.15f), vec3(0.15f), vec3(0.8f)});
    scene.quads = {{{-10, 0, 10},
                    {20, 0, 0},
                    {0, 0, -20},
                    add(scene, Textured{.texture = add_texture(scene, squares), .repeat = vec2(31)})}};
    prepare(scene);
    Random random(73);
    Mean mean;
    for (int i = 0; i < 100000; ++i) {
        const vec2 p = 19.9f * (random.uniform2() - 0.5f);
        mean.add(double(radiance(scene, Ray{{p.x, 60, p.y}, {0, -2, 0}}, 1).x));
    }
    INFO(mean.against(0.475));
    CHECK(std::abs(mean.z(0.475)) < 4);
}

// ------------------------------------------------------------------------------------- a model's files

TEST_CASE("one mesh carries several materials and several textures") {
    const Folder folder;
    const vec3 wood = folder.write_picture("wood.png", {0.5f, 0.3f, 0.1f});
    const vec3 stone = folder.write_picture("stone.png", {0.2f, 0.25f, 0.6f});
    folder.write("model.mtl",
                 "newmtl wood\nKd 1 1 1\nmap_Kd wood.png\n"
                 "newmtl plain\nKd 0.8 0.4 0.2\n"
                 "newmtl stone\nKd 0.5 1 0.25\nmap_Kd stone.png\n"
                 "newmtl wood again\nmap_Kd wood.png\n"
                 "newmtl lamp\nKd 0 0 0\nKe 3 2 1\n"
                 "newmtl wet stone\nKd 0.5 1 0.25\nmap_Kd stone.png\nillum 3\nKs 0.25 0.25 0.25\n");
    std::string obj = "mtllib model.mtl\nvt 0 0\nvt 1 0\nvt 0 1\n";
    const char* names[] = {"wood", "plain", "stone", "wood again", "lamp", "wet stone"};
    for (int i = 0; i < 6; ++i) {
        const std::string x = std::to_string(2 * i), right = std::to_string(2 * i + 1);
        obj += "v " + x + " 0 0\nv " + right + " 0 0\nv " + x + " 1 0\nusemtl " + names[i] +
               "\nf -3/1 -2/2 -1/3\n";
    }
    folder.write("model.obj", obj);

    Scene scene = evenly_lit();
    add_texture(scene, card()); // something is in the scene before the model
    add(scene, Diffuse{vec3(0.01f)});
    add(scene, read_obj(folder.file("model.obj")), 40);
    prepare(scene);
    CHECK_MESSAGE(scene.textures.size() == 3, "each picture is loaded once");
    const auto seen = [&](int i) { return seen_at(scene, float(2 * i) + 0.3f, 0.3f); };
    CHECK(seen(0) == approx(wood, 1e-4f));
    CHECK(seen(1) == approx({0.8f, 0.4f, 0.2f}, 1e-4f));
    CHECK_MESSAGE(seen(2) == approx(vec3(0.5f, 1, 0.25f) * stone, 1e-4f), "Kd multiplies the picture");
    CHECK_MESSAGE(seen(3) == approx(wood, 1e-4f), "a picture without Kd is shown as it is");
    CHECK(seen(4) == approx({3, 2, 1}, 1e-4f));
    CHECK(seen(5) == approx(0.75f * vec3(0.5f, 1, 0.25f) * stone + 0.25f, 1e-4f));
}

TEST_CASE("two models keep their own textures") {
    const Folder folder;
    Scene scene = evenly_lit();
    std::vector<vec3> colours;
    for (int i = 0; i < 3; ++i) {
        const std::string name = "part" + std::to_string(i), x = std::to_string(2 * i);
        colours.push_back(
            folder.write_picture(name + ".png", vec3(0.2f * float(i + 1), 0.5f, 0.9f - 0.3f * float(i))));
        folder.write(name + ".mtl", "newmtl a\nmap_Kd " + name + ".png\n");
        folder.write(name + ".obj", "mtllib " + name + ".mtl\nusemtl a\nv " + x + " 0 0\nv " +
                                        std::to_string(2 * i + 1) + " 0 0\nv " + x + " 1 0\nf 1 2 3\n");
        add(scene, read_obj(folder.file(name + ".obj")), 40);
    }
    prepare(scene);
    for (int i = 0; i < 3; ++i) {
        INFO("model ", i);
        CHECK_MESSAGE(seen_at(scene, float(2 * i) + 0.3f, 0.3f) == approx(colours[std::size_t(i)], 1e-4f),
                      "the numbers of a model's textures start where those of the model before it end");
    }
}

TEST_CASE("a texture that is missing shows as a magenta checker") {
    const Folder folder;
    folder.write("model.mtl", "newmtl a\nmap_Kd nowhere.png\n");
    folder.write("model.obj", "mtllib model.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                              "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    Scene scene = evenly_lit();
    add(scene, read_obj(folder.file("model.obj")), 40); // it says so on stderr
    prepare(scene);
    int magenta = 0, black = 0;
    for (int i = 0; i < 900; ++i) {
        const vec3 colour = seen_at(scene, (float(i % 30) + 0.5f) / 30, (float(i / 30) + 0.5f) / 30);
        if (!(colour.y == approx(0, 1e-4f) && colour.x == approx(colour.z, 1e-4f)))
            FAIL_CHECK("got ", colour, ", which is no shade of magenta");
        magenta += colour.x > 0.5f;
        black += colour.x < 0.5f;
    }
    INFO("magenta ", magenta, ", black ", black, " of 900 places");
    CHECK_MESSAGE(magenta > 300, "a file that is missing must not go unseen");
    CHECK(black > 300);
}

TEST_CASE("a picture from a file lies upright on a mesh") {
    const Folder folder;
    Image image(3, 2);
    image.pixels = {red, green, blue, grey, cyan, orange};
    write_image(folder.file("card.png"), image);
    folder.write("model.mtl", "newmtl a\nmap_Kd card.png\n");
    folder.write("model.obj", "mtllib model.mtl\nusemtl a\nv 0 0 0\nv 3 0 0\nv 3 2 0\nv 0 2 0\n"
                              "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n");
    Scene scene = evenly_lit();
    add(scene, read_obj(folder.file("model.obj")), 40);
    prepare(scene);
    CHECK_MESSAGE(seen_at(scene, 0.5f, 1.5f) == approx(red, 6e-3f), "grey: upside down; blue: mirrored");
    CHECK(seen_at(scene, 2.5f, 1.5f) == approx(blue, 6e-3f));
    CHECK(seen_at(scene, 0.5f, 0.5f) == approx(grey, 6e-3f));
    CHECK(seen_at(scene, 2.5f, 0.5f) == approx(orange, 6e-3f));
}

TEST_CASE("a glass model stays glass, and a tree changes nothing about textured shapes") {
    Scene scene = evenly_lit();
    const auto material = [&](const ObjMaterial& m) {
        return scene.materials[std::size_t(add(scene, m, 0))];
    };
    CHECK(std::get<Glass>(material({.ior = 1.33f, .glass = true})).inside.ior == 1.33f);
    CHECK(std::get<Diffuse>(material({.diffuse = {0.8f, 0.4f, 0.2f}, .emission = {1, 2, 3}})).emission ==
          vec3(1, 2, 3));
    const Textured lamp =
        std::get<Textured>(material({.diffuse = {0.8f, 0.4f, 0.2f}, .emission = {1, 2, 3}, .texture = 4}));
    CHECK(lamp.texture == 4);
    CHECK(lamp.tint == vec3(0.8f, 0.4f, 0.2f));
    CHECK(lamp.emission == vec3(1, 2, 3));
    CHECK(lamp.repeat == vec2(1));

    const int picture = add(scene, Textured{add_texture(scene, card())});
    Random random(74);
    for (int i = 0; i < 60; ++i) {
        const vec2 p = random.uniform2();
        scene.spheres.push_back({{p.x, p.y, random.uniform()}, 0.1f, picture});
    }
    for (const Accel accel : {Accel::bvh, Accel::wide}) {
        scene.accel = accel;
        prepare(scene);
    }
    for (int i = 0; i < 500; ++i) {
        const vec2 p = random.uniform2();
        const Ray ray{{p.x, p.y, 4}, {0.01f, -0.02f, -1}};
        scene.accel = i % 2 ? Accel::bvh : Accel::wide;
        const vec3 tree = radiance(scene, ray, 2);
        const bool tree_shadow = occluded(scene, ray);
        scene.accel = Accel::brute;
        if (!(radiance(scene, ray, 2) == approx(tree))) FAIL_CHECK("ray ", i, " differs");
        CHECK(occluded(scene, ray) == tree_shadow);
    }
}

TEST_CASE("tinted glass, mirrors and depth work among textures as they did in step 04") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    Scene scene = evenly_lit();
    scene.spheres = {{{1, 2, 3}, 2, add(scene, Glass{{1, absorption}})},
                     {{1, 2, 3}, 0.5f, add(scene, Mirror{{0.5f, 0.6f, 0.7f}})}};
    prepare(scene);
    const Ray ray{{1, 2, 9}, {0, 0, -2}};
    CHECK(radiance(scene, ray, 5) == approx(vec3(0.5f, 0.6f, 0.7f) * exp(-absorption * 3.0f), 1e-4f));
    scene.spheres[0].material = add(scene, Glass{{1.5f}});
    scene.spheres.pop_back();
    prepare(scene);
    CHECK(radiance(scene, ray, 1) == approx(vec3(0.04f)));
    CHECK(radiance(scene, ray, 2) == approx(vec3(0.9616f)));
    CHECK(radiance(scene, ray, 30) == approx(vec3(1), 1e-4f));
}
