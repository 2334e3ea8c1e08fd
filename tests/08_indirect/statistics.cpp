// Facts about light transport in scenes without a closed form.
// Different strategies agree, and reversed paths carry the same light. These are z-tests with fixed seeds; a
// correct renderer exceeds |z| = 4 in one run out of 16,000.
#include "01_spheres/program/counted.h"
#include "08_indirect/area_lights.h"
#include "08_indirect/hemisphere.h"
#include "08_indirect/radiance.h"
#include "08_indirect/scene.h"
#include "tests/08_indirect/lamps.h"
#include "tests/08_indirect/paths.h"
#include "tests/check.h"

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace rt;

namespace {

/// Returns the difference of two independent means in standard errors.
double apart(const Mean& a, const Mean& b) {
    const double error = std::hypot(a.standard_error(), b.standard_error());
    const double difference = std::abs(a.mean() - b.mean());
    return difference <= 1e-5 * std::max(1.0, std::abs(b.mean())) ? 0 : difference / error;
}

using Channels = std::array<Mean, 3>;

template <Occludable S>
Channels channels_seen(const S& scene, const PathSettings& settings, const Ray& ray, int samples,
                       std::uint64_t seed) {
    const AreaLights lights = collect_area_lights(scene);
    Random random(seed);
    Channels mean;
    for (int i = 0; i < samples; ++i) {
        const vec3 got = radiance(scene, lights, settings, ray, random);
        for (int k = 0; k < 3; ++k) mean[std::size_t(k)].add(double(got[k]));
    }
    return mean;
}

void check_same(const Channels& a, const Channels& b) {
    for (std::size_t k = 0; k < 3; ++k) {
        INFO("channel " << k << ": " << a[k].mean() << " +- " << a[k].standard_error() << " and "
                        << b[k].mean() << " +- " << b[k].standard_error() << ", z = " << apart(a[k], b[k]));
        CHECK(apart(a[k], b[k]) < 4);
    }
}

/// Builds a scene without any axis-aligned surface: a floor and a wall; an emissive quad, ball and triangle;
/// and a board between them.
Scene oblique_scene() {
    Scene scene;
    scene.sky = {{0.1f, 0.05f, 0}, {0.1f, 0.2f, 0.4f}};
    const int floor = add(scene.materials, Diffuse{{0.8f, 0.5f, 0.4f}});
    const int wall = add(scene.materials, Checkerboard{{0.2f, 0.6f, 0.8f}, {0.7f, 0.1f, 0.3f}, 0.7f});
    scene.quads = {
        {{-4, -0.5f, 4}, {8, 0.6f, 0.4f}, {0.3f, 0.5f, -8}, floor},
        {{-3, -1, -2}, {6, 0.2f, -0.8f}, {0.3f, 5, -0.6f}, wall},
        {{-1.5f, 3, -1},
         {1.2f, 0.3f, 0.1f},
         {0.1f, 0.4f, 1.4f},
         add(scene.materials, emissive(vec3(6, 4, 2)))},
        {{-1.2f, 1.5f, -0.6f}, {1.1f, 0.3f, 0}, {0, -0.2f, 0.9f}, add(scene.materials, Diffuse{vec3(0.5f)})}};
    scene.spheres = {{{1.6f, 2.4f, 0.4f}, 0.5f, add(scene.materials, Diffuse{vec3(0.4f), vec3(1, 3, 8)})},
                     {{0.8f, 0.9f, 0.5f}, 0.4f, add(scene.materials, Diffuse{{0.3f, 0.7f, 0.5f}})}};
    add_triangle(scene, {2.5f, 0.4f, -1}, {3, 1.8f, -0.5f}, {2.7f, 0.9f, 1},
                 add(scene.materials, emissive(vec3(5, 1, 1))));
    return scene;
}
const Ray into_it{{0.5f, 2.5f, 6}, {-0.6f, -2, -5.8f}}; // hits the floor under the board

} // namespace

TEST_CASE("all strategies of direct lighting and hemisphere sampling give the same picture") {
    // The most sensitive test: an error in a cosine, a distance, an area, a pdf or a factor of pi affects
    // only one of the strategies.
    Scene scene = oblique_scene();
    build_bvhs(scene);
    for (const int depth : {1, 2, 5})
        for (const bool indirect : {true, false}) {
            const Channels chance = channels_seen(
                scene, {depth, indirect, DirectLighting::bsdf_sampling, false}, into_it, 150'000, 2);
            for (const DirectLighting direct : all_ways)
                for (const HemisphereSampling hemisphere_sampling :
                     {HemisphereSampling::cosine, HemisphereSampling::uniform}) {
                    const PathSettings settings{depth, indirect, direct, false, hemisphere_sampling};
                    const Channels other = channels_seen(scene, settings, into_it, 100'000, 1);
                    INFO("depth " << depth << ", indirect light " << std::string(indirect ? "on" : "off")
                                  << ": " << words(settings)
                                  << ", then by BSDF and cosine sampling; too bright: counted twice");
                    check_same(other, chance);
                }
        }
}

TEST_CASE("with mirrors, metal and glass, all strategies agree: no caustic is lost or counted twice") {
    Scene scene = oblique_scene();
    const int glass = add(scene.materials, Dielectric{{1.5f, {0.5f, 0.1f, 0.3f}}});
    const int coat = add(scene.materials, Coated{0.6f, 0, {0.9f, 0.8f, 0.7f}});
    const int shiny_lamp = add(scene.materials, Coated{0.4f, add(scene.materials, emissive(vec3(9, 7, 5)))});
    scene.spheres.push_back({{-0.3f, 0.7f, 1.6f}, 0.6f, glass});
    scene.spheres.push_back(
        {{-1.1f, 0.6f, 0.4f}, 0.4f, add(scene.materials, Metal{{0.9f, 0.6f, 0.3f}, 0.4f})});
    scene.quads.push_back({{-2.2f, 0, -1}, {0.3f, 2.5f, 0.2f}, {0.2f, 0.1f, 3}, coat});
    scene.quads.push_back({{0.2f, 2.8f, 1.6f}, {0.7f, 0.2f, 0.3f}, {0.1f, 0.1f, 0.5f}, shiny_lamp});
    build_bvhs(scene);
    for (const int depth : {2, 3, 6}) {
        const Channels chance =
            channels_seen(scene, {depth, true, DirectLighting::bsdf_sampling, true}, into_it, 150'000, 4);
        for (const DirectLighting direct : {DirectLighting::mis, DirectLighting::light_sampling}) {
            const PathSettings settings{depth, true, direct, true};
            const Channels asked = channels_seen(scene, settings, into_it, 100'000, 3);
            INFO("depth " << depth << ": " << words(settings) << ", then by BSDF sampling");
            check_same(asked, chance);
        }
    }
}

TEST_CASE("roulette leaves the picture unchanged") {
    Scene scene = oblique_scene();
    build_bvhs(scene);
    for (const DirectLighting direct : all_ways) {
        const Channels without = channels_seen(scene, {12, true, direct, false}, into_it, 50'000, 5);
        const Channels with = channels_seen(scene, {12, true, direct, true}, into_it, 50'000, 6);
        INFO("strategy "
             << int(direct)
             << ": first without, then with roulette; too dark: divide survivors by their probability");
        check_same(without, with);
    }
}

TEST_CASE("roulette saves work: in a dim closed room most paths end long before the maximum depth") {
    Counted<Scene> scene;
    scene.spheres = {{{1, 2, 3}, 2, add(scene.materials, Diffuse{vec3(0.4f), vec3(1)})}};
    build_bvhs(scene);
    const auto rays = [&](bool with_roulette) {
        ray_stats = {};
        channels_seen(scene, {30, true, DirectLighting::light_sampling, with_roulette},
                      {{0.5f, 2, 3}, {1, 0.3f, -0.2f}}, 500, 7);
        return double(ray_stats.rays);
    };
    const double full = rays(false), played = rays(true);
    INFO(full << " rays without roulette, " << played << " with it");
    CHECK(full > 500 * 59);
    CHECK(played < 0.3 * full);
}

TEST_CASE("camera and light can be exchanged: between matte surfaces the same light arrives") {
    // A point light at one point, and all light that arrives at another from all directions: G(p, q)
    // = G(q, p). The points are beside surfaces of different colour, so that a missing or extra
    // cosine has different effects.
    Scene scene = oblique_scene();
    scene.sky = {};
    for (Material& material : scene.materials)
        if (Diffuse* diffuse = std::get_if<Diffuse>(&material)) *diffuse = {{0.8f, 0.6f, 0.4f}};
    build_bvhs(scene);
    const vec3 p(0.3f, 0.35f, 1.4f), q(2.2f, 1.9f, -0.9f);
    for (const int depth : {1, 4}) {
        const auto arriving = [&](vec3 eye, vec3 light, std::uint64_t seed) {
            scene.lights = {{light, vec3(10)}};
            Random random(seed);
            Channels mean;
            for (int i = 0; i < 250'000; ++i) {
                const vec3 direction = sample_area(Sphere{vec3(0), 1, 0}, random.get_2d()).normal;
                const vec3 got = radiance(scene, AreaLights{}, {.depth = depth}, {eye, direction}, random);
                for (int k = 0; k < 3; ++k) mean[std::size_t(k)].add(double(got[k]));
            }
            return mean;
        };
        INFO("depth " << depth << ": first the camera at p and the light at q, then exchanged");
        check_same(arriving(p, q, 7), arriving(q, p, 8));
    }
}

TEST_CASE("opposite faces of a cube have a form factor of .1998249 and adjacent ones of .2000438") {
    // The means over a whole square. Bounces from it hit the emissive face with this probability.
    Mean across, around, sampled;
    for (const bool opposite : {true, false}) {
        Scene scene;
        const int glow = add(scene.materials, emissive(vec3(1)));
        scene.quads = {opposite ? Quad{{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, glow}
                                : Quad{{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, glow}};
        scene.planes = {{{0, 0, 0}, {0, 1, 0}, add(scene.materials, Diffuse{vec3(1)})}};
        build_bvhs(scene);
        const AreaLights lights = collect_area_lights(scene);
        Random random(9);
        for (int i = 0; i < 300'000; ++i) {
            const vec2 place = random.get_2d();
            const Ray ray{{place.x, 1e-3f, place.y}, {0, -1, 0}};
            const vec3 chance =
                radiance(scene, lights, {1, true, DirectLighting::bsdf_sampling, false}, ray, random);
            (opposite ? across : around).add(double(chance.x));
            if (opposite)
                sampled.add(double(
                    radiance(scene, lights, {1, true, DirectLighting::light_sampling, false}, ray, random)
                        .x));
        }
    }
    INFO("opposite, BSDF sampling: " << across.against(0.1998249));
    CHECK(off(across, 0.1998249) < 4);
    INFO("opposite, light sampling: " << sampled.against(0.1998249));
    CHECK(off(sampled, 0.1998249) < 4);
    INFO("adjacent, BSDF sampling: " << around.against(0.2000438));
    CHECK(off(around, 0.2000438) < 4);
    const double cube = across.mean() + 4 * around.mean();
    const double error = std::hypot(across.standard_error(), 4 * around.standard_error());
    INFO("the opposite and the four adjacent faces are the whole cube: " << cube << " +- " << error);
    CHECK(std::abs(cube - 1) < 4 * error);
}

TEST_CASE("A1 F12 = A2 F21 for lamps of different sizes") {
    const Quad small{{-0.4f, 0.2f, 0.1f}, {0.7f, 0.1f, 0}, {0, 0.2f, 0.6f}, 0};
    const Quad large{{-1.5f, 2, -1}, {2.6f, 0.4f, 0.2f}, {0.1f, 0.5f, 2.4f}, 0};
    const auto power = [](const Quad& lamp, const Quad& receiver, std::uint64_t seed) {
        Scene scene;
        add(scene.materials, emissive(vec3(1)));
        scene.quads = {lamp};
        build_bvhs(scene);
        const AreaLights lights = collect_area_lights(scene);
        Random random(seed);
        Mean mean;
        for (int i = 0; i < 100'000; ++i) {
            const LightSample place = sample_area(receiver, random.get_2d());
            const vec3 normal =
                dot(lamp.corner - place.position, place.normal) < 0 ? -place.normal : place.normal;
            const float error = position_error(place.position, place.position);
            const Hit hit{0, place.position, normal, normal, vec2(0), 0, false, error};
            mean.add(double(sample_area_lights(scene, lights, hit, random).x) * double(area(receiver)));
        }
        return mean;
    };
    const Mean up = power(large, small, 10), down = power(small, large, 11);
    INFO(up.mean() << " W reach the small square, " << down.mean()
                   << " W the large one, z = " << apart(up, down));
    CHECK(apart(up, down) < 4);
}

TEST_CASE("in a closed box of emission Le whose walls reflect half of the light, the radiance is 2 Le") {
    // Near an edge, light sampling has rare large values, so one false alarm in
    // 16,000 is only approximate here.
    Scene scene;
    const int wall = add(scene.materials, Diffuse{vec3(0.5f), vec3(1)});
    const std::array<vec3, 8> v{vec3(0, 0, 0),    {2, 0.3f, 0}, {2.2f, 1.5f, 0.2f}, {0.1f, 1, 0},
                                vec3(0, 0.2f, 3), {2, 0, 3.2f}, {2, 1.4f, 3},       {0, 1.2f, 2.8f}};
    for (const std::array<int, 4>& f :
         {std::array{0, 3, 2, 1}, std::array{4, 5, 6, 7}, std::array{0, 1, 5, 4}, std::array{3, 7, 6, 2},
          std::array{0, 4, 7, 3}, std::array{1, 2, 6, 5}}) {
        const auto corner = [&](int i) { return v[std::size_t(f[std::size_t(i)])]; };
        add_triangle(scene, corner(0), corner(1), corner(2), wall);
        add_triangle(scene, corner(0), corner(2), corner(3), wall);
    }
    build_bvhs(scene);
    const Ray ray{{1, 0.7f, 1.5f}, {0.3f, -0.5f, 0.2f}};
    for (const PathSettings& settings : {PathSettings{25, true, DirectLighting::mis, true},
                                         PathSettings{25, true, DirectLighting::light_sampling, false},
                                         PathSettings{25, true, DirectLighting::bsdf_sampling, true}}) {
        const Channels mean = channels_seen(scene, settings, ray, 15'000, 12);
        INFO(words(settings) << ", roulette: " << settings.roulette << ": " << mean[0].against(2));
        CHECK(off(mean[0], 2) < 4);
    }
}

TEST_CASE("no path is negative or NaN in any scene") {
    int worst = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
        Random random(seed + 1000);
        const auto cube = [&](float size) {
            const float x = random.get_1d(), y = random.get_1d(), z = random.get_1d();
            return size * (2.0f * vec3(x, y, z) - 1.0f);
        };
        const auto colour = [&] { return 0.5f + cube(0.5f); };
        Scene scene;
        scene.sky = {colour(), colour()};
        const int picture = add(scene.textures, make_texture(Bitmap{1, 2, {65535, 0, 4711, 0, 65535, 1}}));
        for (int i = 0; i < 4; ++i) {
            add(scene.materials, Diffuse{colour(), random.get_1d() < 0.3f ? 1e4f * colour() : vec3(0)});
            add(scene.materials, Checkerboard{colour(), colour(), 0.3f});
            add(scene.materials, Mirror{colour()});
            add(scene.materials, Coated{random.get_1d(), int(random.get_1d() * 3)});
            add(scene.materials,
                Dielectric{{1 + 1.5f * random.get_1d(), 2.0f * colour()}, {1 + random.get_1d()}});
            add(scene.materials,
                ImageTexture{picture, colour(), random.get_1d() < 0.3f ? colour() : vec3(0)});
            add(scene.materials, Metal{colour(), random.get_1d()});
        }
        const auto material = [&] { return int(random.get_1d() * 28); };
        const auto dull = [&] { return 1 + 7 * int(random.get_1d() * 4); }; // planes must not be emissive
        for (int i = 0; i < 4; ++i) {
            const vec3 center = cube(2);
            scene.spheres.push_back({center, 0.05f + random.get_1d(), material()});
            const vec3 corner = cube(2), u = cube(2);
            scene.quads.push_back({corner, u, cube(2), material()});
            const vec3 a = cube(2), b = cube(2);
            add_triangle(scene, a, b, a + cube(0.1f), material());
        }
        scene.planes = {{{0, -2, 0}, {0, 1, 0}, dull()}};
        scene.lights = {{cube(2), 10.0f * colour()}};
        if (seed % 4 == 0) scene.spheres.push_back({{0, 0, 0}, 6, 0}); // closed
        if (seed % 5 == 0) scene.quads.push_back(scene.quads[0]);      // duplicate
        build_bvhs(scene);
        const AreaLights lights = collect_area_lights(scene);
        for (int i = 0; i < 120; ++i) {
            const PathSettings settings{i % 13, i % 5 != 0, all_ways[std::size_t(i % 3)], i % 2 != 0,
                                        i % 7 < 4 ? HemisphereSampling::cosine : HemisphereSampling::uniform};
            const vec3 from = cube(3), direction = cube(1);
            const vec3 got = radiance(scene, lights, settings, {from, direction}, random);
            const bool good = is_finite(got) && got.x >= 0 && got.y >= 0 && got.z >= 0;
            if (good) continue;
            INFO("scene " << seed << ", path " << i << " from " << to_text(from) << " towards "
                          << to_text(direction) << ": " << to_text(got));
            CHECK_MESSAGE(
                good, "a division by a distance, a cosine or an area of 0, or the root of a negative number");
            if (++worst > 3) return;
        }
    }
    CHECK(worst == 0);
}

TEST_CASE(
    "light in a coloured medium is absorbed along its path whether by light sampling or BSDF sampling") {
    // A lamp and a matte plate in a ball of coloured glass of index 1, and the camera outside.
    Scene scene;
    const int lamp = add(scene.materials, emissive(vec3(5)));
    const int plate = add(scene.materials, Diffuse{vec3(0.8f)});
    scene.spheres = {{{0, 0, 0}, 3, add(scene.materials, Dielectric{{1.0f, {0.6f, 0.2f, 0}}})}};
    scene.quads = {{{-1, -1, -1}, {2, 0.2f, 0}, {0, 0.1f, 2}, plate},
                   {{-0.5f, 1, -0.5f}, {1, 0, 0.1f}, {0, 0.2f, 1}, lamp}};
    build_bvhs(scene);
    const Ray ray{{4, 1.4f, 4.1f}, {-4, -2.2f, -4}};
    const Channels asked =
        channels_seen(scene, {2, true, DirectLighting::light_sampling, false}, ray, 60'000, 13);
    const Channels chance =
        channels_seen(scene, {2, true, DirectLighting::bsdf_sampling, false}, ray, 120'000, 14);
    INFO("first light sampling, then BSDF sampling; the first is brighter: the shadow ray ignores "
         "Beer-Lambert absorption");
    check_same(asked, chance);
}
