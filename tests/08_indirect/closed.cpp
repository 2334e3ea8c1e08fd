// Facts about coarse smooth meshes: their interpolated normals neither let light in nor lose light.
#include "08_indirect/radiance.h"
#include "08_indirect/scene.h"
#include "common/math/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

using namespace rt;

namespace {

/// Builds a coarse ball with smooth normals in a uniformly bright world, optionally with lamps beside it.
Scene ball(vec3 albedo, Accel accel, bool lamps) {
    Scene scene;
    scene.accel = accel;
    scene.sky = {.nadir = vec3(1), .zenith = vec3(1)};
    if (lamps) scene.lights = {{{1.5f, 0.3f, 0.2f}, vec3(9)}};
    ObjModel file = icosphere(1);
    file.materials[0].diffuse = albedo;
    add_model(scene, file, 180);
    if (lamps)
        scene.quads = {{{-2, 1.2f, -2}, {4, 0.1f, 0}, {0, 0, 4}, add(scene.materials, emissive(vec3(5)))}};
    build_bvhs(scene);
    return scene;
}

} // namespace

TEST_CASE("no light gets into a closed smooth mesh from the sky, a point light or an area light") {
    for (const Accel accel : {Accel::brute, Accel::bvh, Accel::wide}) {
        const Scene scene = ball(vec3(0.9f), accel, true);
        const AreaLights lights = collect_area_lights(scene);
        Random random(3);
        int bright = 0;
        for (int i = 0; i < 6000; ++i) {
            const vec3 way = normalize(2.0f * vec3(random.get_1d(), random.get_1d(), random.get_1d()) - 1.0f);
            bright += radiance(scene, lights, {.depth = 8}, Ray{{0.1f, 0.2f, -0.1f}, way}, random) != vec3(0);
        }
        CHECK_MESSAGE(bright == 0,
                      "of 6000 paths: a bounce or a shadow ray starts on the far side of the wall");
    }
}

TEST_CASE(
    "a white smooth mesh in a white world is invisible because it reflects all the light that it receives") {
    const Scene scene = ball(vec3(1), Accel::wide, false);
    Random random(4);
    Mean mean;
    for (int i = 0; i < 6000; ++i) {
        const vec3 target = 0.9f * (2.0f * vec3(random.get_1d(), random.get_1d(), random.get_1d()) - 1.0f);
        mean.add(double(radiance(scene, {}, {.depth = 60, .roulette = false},
                                 Ray{{1, 3, 4}, target - vec3(1, 3, 4)}, random)
                            .x));
    }
    INFO(mean.against(1));
    CHECK(mean.mean() == doctest::Approx(1).epsilon(1e-4));
}
