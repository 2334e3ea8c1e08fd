// Facts about a counted scene: its queries give the results of the scene, and each is counted once.
#include "tests/check.h"

#include "01_spheres/program/counted.h"
#include "02_shadows/radiance.h"
#include "02_shadows/scene.h"

#include "tests/02_shadows/step.h"

using namespace rt;

TEST_CASE("a counted scene gives the same hits and counts each query once") {
    Counted<Scene> scene;
    scene.spheres = {{{1, 2, -5}, 1.5f, add(scene.materials, Diffuse{vec3(0.5f)})}};
    scene.lights = {{{-4, 9, 6}, vec3(70)}};
    const Scene& plain = scene;
    const Ray ray{{0, 0, 0}, {0.2f, 0.4f, -1}};
    ray_stats = {};
    const auto hit = intersect(scene, ray);
    REQUIRE(hit);
    CHECK(hit->t == intersect(plain, ray)->t);
    CHECK(occluded(scene, ray) == occluded(plain, ray));
    CHECK(ray_stats.rays == 2);
    CHECK(radiance(scene, ray) == radiance(plain, ray)); // one camera ray and one shadow ray
    CHECK(ray_stats.rays == 4);
}
