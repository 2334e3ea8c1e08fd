// Facts about paths through glass: reflection, absorption and transmission.
// Statistical checks are z-tests with fixed seeds; a correct renderer exceeds |z| =
// 4 in one run out of 16,000.
#include "08_indirect/radiance.h"
#include "08_indirect/scene.h"
#include "tests/08_indirect/step.h"
#include "tests/08_indirect/lamps.h"
#include "tests/08_indirect/paths.h"
#include "tests/check.h"

#include <cmath>

using namespace rt;

TEST_CASE("glass reflects the share given by Fresnel's equations") {
    // A ball of radius 2, hit at 60 degrees. With one bounce, a refracted path is still inside and black, so
    // only the reflection remains in a white world: F(60) = .0891867. The direction has length 1.7.
    Scene scene;
    scene.sky = {vec3(1), vec3(1)};
    scene.spheres = {{{1, 0, 0}, 2, add(scene.materials, Dielectric{{1.5f}})}};
    const vec3 normal = normalize(vec3(1, 2, -2));
    const vec3 side = normalize(cross(normal, vec3(0, 1, 0)));
    const vec3 direction = -0.5f * normal + std::sqrt(0.75f) * side;
    const Ray ray{vec3(1, 0, 0) + 2.0f * normal - direction, 1.7f * direction};
    const Mean mean = seen(scene, {.depth = 1}, ray, 40'000);
    INFO(mean.against(0.0891867) << "; .0400: the same at all angles; .0700: Schlick's approximation");
    CHECK(off(mean, 0.0891867) < 4);
}

TEST_CASE("a clear ball in a white furnace has radiance 1 from outside and from inside") {
    for (const Medium inside : {Medium{1.5f}, Medium{2.417f}, Medium{1.0f}}) {
        Scene scene;
        scene.sky = {vec3(1), vec3(1)};
        scene.spheres = {
            {{1, 0, 0},
             2,
             add(scene.materials, Dielectric{inside, inside.ior == 1 ? Medium{1.5f} : Medium{}})}};
        for (const vec3 from : {vec3(4, 3, 5), vec3(1.3f, 0.2f, 1.1f)}) {
            const Mean plain =
                seen(scene, {.depth = 1000, .roulette = false}, {from, {-0.6f, -0.4f, -1}}, 2000);
            CHECK_MESSAGE(float(plain.mean()) == approx(1), "no path may lose or gain light");
            CHECK(plain.variance() < 1e-8);
            const Mean played = seen(scene, {.depth = 1000}, {from, {-0.6f, -0.4f, -1}});
            INFO(played.against(1));
            CHECK(off(played, 1) < 4);
        }
    }
}

TEST_CASE("coloured glass absorbs by the length of the path within it") {
    // Index 1: the ray is not refracted, so the chord is known. The direction does not have unit length.
    Scene scene;
    scene.sky = {vec3(2), vec3(2)};
    const vec3 absorption(0.3f, 0.8f, 0);
    const int clear = add(scene.materials, Dielectric{{1.0f, absorption}});
    const int mirror = add(scene.materials, Mirror{vec3(0.5f)});
    scene.spheres = {{{0, 1, -6}, 2, clear}, {{20, 1, -6}, 2, clear}, {{20, 1, -6}, 0.5f, mirror}};
    build_bvhs(scene);
    Random random(59);
    const PathSettings settings{.depth = 6, .roulette = false};
    const vec3 direction = 3.0f * normalize(vec3(0.1f, 0.1f, -1));
    const vec3 unit = normalize(direction);
    const float closest = length(vec3(0, 1, -6) - dot(vec3(0, 1, -6), unit) * unit);
    const float chord = 2 * std::sqrt(4 - closest * closest);
    INFO("the chord is " << chord << " long");
    CHECK(radiance(scene, AreaLights{}, settings, {{0, 0, 0}, direction}, random) ==
          approx(2.0f * exp(-absorption * chord), 1e-4f));
    INFO("in to the mirror at the centre, and back out: 2 * 1.5");
    CHECK(radiance(scene, AreaLights{}, settings, {{20, 1, 0}, {0, 0, -2}}, random) ==
          approx(1.0f * exp(-absorption * 3.0f), 1e-4f));
}

TEST_CASE("a matte core in coloured glass is lit through the glass and seen through it") {
    // Core of radius 1 in a ball of radius 2, index 1. Inward: 1 m. Outward, at angle
    // theta: sqrt(4 - sin^2) - cos.
    Scene scene;
    scene.sky = {vec3(1), vec3(1)};
    const int shell = add(scene.materials, Dielectric{{1.0f, vec3(0.7f)}});
    scene.spheres = {{{3, 1, -6}, 2, shell}, {{3, 1, -6}, 1, add(scene.materials, Diffuse{vec3(0.8f)})}};
    double out = 0;
    for (int i = 0; i < 10'000; ++i) {
        const double sin2 = (i + 0.5) / 10'000; // uniform for cosine-weighted directions
        out += std::exp(-0.7 * (std::sqrt(4 - sin2) - std::sqrt(1 - sin2))) / 10'000;
    }
    const double want = std::exp(-0.7) * 0.8 * out;
    const Mean mean = seen(scene, {.depth = 5}, {{3, 1, 0}, {0, 0, -0.5f}});
    INFO(mean.against(want) << "; exp(.7) times brighter: absorption is missing after the bounce");
    CHECK(off(mean, want) < 4);
}

TEST_CASE("an infinite coloured medium transmits nothing") {
    Scene scene;
    scene.sky = {vec3(1), vec3(1)};
    scene.quads = {
        {{-1, -1, -4}, {2, 0, 0}, {0, 2, 0}, add(scene.materials, Dielectric{{1.0f, vec3(0.1f)}})}};
    // The normal of the boundary faces away: the ray enters the medium and never leaves it.
    const Mean mean = seen(scene, {.depth = 5}, {{0, 0, 0}, {0.1f, 0.1f, -1}}, 100);
    CHECK(mean.mean() == 0);
}

TEST_CASE("a lamp behind clear glass shines through it exactly once") {
    // A ball of index 1 around the lamp refracts nothing: all its light is a caustic,
    // invisible to light sampling.
    for (const DirectLighting direct : all_ways) {
        Scene scene;
        const int floor = add(scene.materials, Diffuse{vec3(0.6f)});
        const int lamp = add(scene.materials, emissive(vec3(5)));
        scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}};
        scene.quads = {{{-0.5f, 2, -0.5f}, {1, 0.3f, 0}, {0, 0, 1}, lamp}};
        scene.spheres = {{{0, 2.1f, 0}, 1.2f, add(scene.materials, Dielectric{{1.0f}})}};
        const vec3 position(0.3f, 0, 0.2f);
        const double want = 0.6 * 5 * form_factor(corners_of(scene.quads[0]), position, {0, 1, 0});
        const PathSettings settings{3, true, direct, false};
        const Mean mean = seen(scene, settings, {position + vec3(-3, 1, 1), vec3(3, -1, -1)}, 40'000);
        INFO(words(settings) << ": " << mean.against(want));
        CHECK(off(mean, want) < 4);
    }
}
