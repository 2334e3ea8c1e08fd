// Facts about earlier materials combined with glass: coats over glass, and matte surfaces behind it.
#include "04_refraction/radiance.h"
#include "tests/04_refraction/scenes.h"

using namespace rt;

TEST_CASE("a coat of reflectivity r over glass shows r of the mirror and 1 - r of the glass") {
    Glassware scene; // a lake without a bottom: a ray crosses one boundary
    scene.sky = {{1, 0.2f, 0}, {0, 0.7f, 1}};
    const int lake = add(scene.materials, Dielectric{{1.333f}});
    const int mirror = add(scene.materials, Mirror{{0.9f, 0.5f, 0.3f}});
    const int coated = add(scene.materials, Coated{0.3f, lake, {0.9f, 0.5f, 0.3f}});
    const auto seen = [&](int material) {
        scene.planes = {{vec3(0), normal, material}};
        return radiance(scene, Ray{-arriving(60), arriving(60)}, 4);
    };
    CHECK(seen(coated) == approx(0.7f * seen(lake) + 0.3f * seen(mirror)));
}

TEST_CASE("a matte floor is lit and seen through clear glass as without it") {
    Scene scene;
    const int chalk = add(scene.materials, Diffuse{{0.8f, 0.4f, 0.5f}});
    const int squares = add(scene.materials, Checkerboard{{0.8f, 0.4f, 0.5f}, {0.8f, 0.4f, 0.5f}, 0.3f});
    scene.sky = {vec3(0), vec3(1)};
    scene.lights = {{{0, 4, 0}, vec3(20)}};
    for (const int material : {chalk, squares}) {
        scene.planes = {{{0, 0, 0}, {0, 1, 0}, material}};
        scene.spheres = {};
        const Ray ray{{0.5f, 2, 1.5f}, {0.1f, -1, -0.3f}};
        const vec3 bare = radiance(scene, ray, 4);
        CHECK(bare.x > 0.1f);
        scene.spheres = {{{0.6f, 1.2f, 1.25f}, 0.4f, add(scene.materials, Dielectric{air})}};
        REQUIRE(intersect(scene, ray)->material == scene.spheres[0].material);
        CHECK(radiance(scene, ray, 4) == approx(bare, 1e-4f));
    }
}
