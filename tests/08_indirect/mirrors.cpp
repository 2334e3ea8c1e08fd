// Facts about paths over metals, coats and mirrors, and about the mirror images of lamps.
// Statistical checks are z-tests with fixed seeds; a correct renderer exceeds |z| =
// 4 in one run out of 16,000.
#include "08_indirect/radiance.h"
#include "08_indirect/scene.h"
#include "tests/08_indirect/step.h"
#include "tests/08_indirect/lamps.h"
#include "tests/08_indirect/paths.h"
#include "tests/check.h"

#include <array>
#include <cmath>
#include <vector>

using namespace rt;

TEST_CASE("in a white world a metal shows its albedo, minus the loss by its fuzz") {
    for (const float fuzz : {0.0f, 0.3f, 1.0f}) {
        Scene scene;
        scene.sky = {vec3(1), vec3(1)};
        scene.quads = {{{-1, -1, -4}, {2, 0, 0}, {0, 2, 0}, add(scene.materials, Metal{vec3(0.8f), fuzz})}};
        const float cosine = 0.25f;
        const vec3 direction(0, std::sqrt(1 - cosine * cosine), -cosine);
        const Mean mean =
            seen(scene, {.depth = 3, .roulette = false}, {vec3(0, 0, -4) - direction, direction});
        const double kept = fuzz > cosine ? 1 - (1 - double(cosine / fuzz)) / 2 : 1;
        INFO("fuzz " << fuzz << ": " << mean.against(0.8 * kept));
        CHECK(off(mean, 0.8 * kept) < 4);
    }
}

TEST_CASE("a coat of reflectivity k shows k of the mirror and 1 - k of its base") {
    for (const float k : {0.0f, 0.3f, 0.85f, 1.0f}) {
        Scene once;
        once.sky = {vec3(1), vec3(1)};
        const int base = add(once.materials, Diffuse{vec3(0.4f), vec3(2)});
        const int coat = add(once.materials, Coated{k, base, vec3(0.9f)});
        const int second = add(once.materials, Coated{0.5f, coat, vec3(0.6f)});
        Scene twice = once;
        once.quads = {{{-1, -1, -4}, {2, 0, 0.5f}, {0, 2, 0}, coat}};
        twice.quads = {{{-1, -1, -4}, {2, 0, 0.5f}, {0, 2, 0}, second}};
        const double one = double(k) * 0.9 + (1 - double(k)) * (2 + 0.4);
        const double two = 0.5 * 0.6 + 0.5 * one;
        for (const DirectLighting direct : all_ways) {
            const PathSettings settings{3, true, direct, false};
            const Ray ray{{0, 0, 0}, {0.1f, 0.1f, -1}};
            const Mean single = seen(once, settings, ray), both = seen(twice, settings, ray);
            INFO("k = " << k << ": " << single.against(one)
                        << "; is k counted twice, as a weight and as a probability?");
            CHECK(off(single, one) < 4);
            INFO("under a second coat: " << both.against(two));
            CHECK(off(both, two) < 4);
        }
        CHECK(emission(once, coat) == approx(vec3((1 - k) * 2)));
        CHECK(emission(once, second) == approx(vec3(0.5f * (1 - k) * 2)));
    }
}

TEST_CASE("a coated lamp lights its surroundings like a lamp of 1 - k of its radiance") {
    for (const DirectLighting direct : all_ways) {
        Scene scene;
        const int floor = add(scene.materials, Diffuse{vec3(0.6f)});
        const int coat = add(scene.materials, Coated{0.25f, add(scene.materials, emissive(vec3(8)))});
        scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}};
        scene.quads = {{{-0.5f, 2, -1}, {1, 0.2f, 0}, {0, 0, 2}, coat}};
        // A bounce reflected by the coat reaches the sky, which is black, or passes the lamp to the floor.
        const vec3 position(0.2f, 0, 0.3f);
        const double want = 0.6 * 6 * form_factor(corners_of(scene.quads[0]), position, {0, 1, 0});
        const PathSettings settings{1, true, direct, false};
        const Mean mean = seen(scene, settings, {position + vec3(-2, 1, 1), vec3(2, -1, -1)}, 40'000);
        INFO(words(settings) << ": " << mean.against(want));
        CHECK(off(mean, want) < 4);
    }
}

TEST_CASE("the depth counts mirrors: after k mirrors s^k remains, at a smaller depth nothing") {
    // Two facing mirrors one metre apart; the ray climbs one metre between bounces and leaves after three.
    Scene scene;
    const int mirror = add(scene.materials, Mirror{{0.9f, 0.5f, 1}});
    scene.quads = {{{0, 0, -5}, {0, 3.2f, 0}, {0, 0, 10}, mirror},
                   {{1, 0, -5}, {0, 3.2f, 0}, {0, 0, 10}, mirror}};
    scene.sky = {vec3(2), vec3(2)};
    build_bvhs(scene);
    for (const bool with_roulette : {false, true})
        for (const int depth : {0, 2, 3, 9}) {
            std::array<Mean, 2> mean;
            Random random(53);
            for (int i = 0; i < 4000; ++i) {
                const PathSettings settings{depth, i % 2 == 0, all_ways[std::size_t(i % 3)], with_roulette};
                const vec3 got =
                    radiance(scene, AreaLights{}, settings, {{0.5f, 0, 0}, {1, 1, 0.2f}}, random);
                mean[0].add(double(got.x));
                mean[1].add(double(got.y));
            }
            const bool through = depth >= 3;
            INFO("depth " << depth << ": " << mean[0].against(through ? 2 * 0.729 : 0));
            CHECK(off(mean[0], through ? 2 * 0.729 : 0) < 4);
            CHECK(off(mean[1], through ? 2 * 0.125 : 0) < 4);
        }
}

TEST_CASE("a mirror on the wall doubles a lamp: its caustic is neither lost nor counted twice") {
    // The mirror wall x = -1 shows an image of the lamp, with the mirror's tint, at x -> -2 - x.
    for (const DirectLighting direct : all_ways) {
        Scene scene;
        const int floor = add(scene.materials, Diffuse{vec3(0.6f)});
        const int wall = add(scene.materials, Mirror{vec3(0.7f)});
        scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}, {{-1, 0, 0}, {1, 0, 0}, wall}};
        const Quad lamp{
            {0.5f, 1, -1}, {0.4f, 0.8f, 0}, {0.1f, 0, 2}, add(scene.materials, emissive(vec3(5)))};
        scene.quads = {lamp};
        const vec3 position(-0.3f, 0, 0.2f), up(0, 1, 0);
        std::vector<vec3> image = corners_of(lamp);
        for (vec3& corner : image) corner.x = -2 - corner.x;
        const double straight = 0.6 * 5 * form_factor(corners_of(lamp), position, up);
        const double caustic = 0.6 * 5 * 0.7 * form_factor(image, position, up);
        const Ray ray{position + vec3(1, 3, 1), vec3(-1, -3, -1)};
        const auto check = [&](const PathSettings& settings, double want) {
            const Mean mean = seen(scene, settings, ray, 40'000);
            INFO(words(settings) << ": " << mean.against(want) << "; " << straight << " directly, " << caustic
                                 << " by the mirror");
            CHECK(off(mean, want) < 4);
        };
        check({2, true, direct, false}, straight + caustic);
        check({2, true, direct, true}, straight + caustic);
        check({1, true, direct, false}, straight);
    }
}
