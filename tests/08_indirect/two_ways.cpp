// Facts about direct lighting by light sampling and BSDF sampling, also for lamps in meshes.
// Both give the same light, and their combination has less noise. Statistical checks are z-tests with fixed
// seeds; a correct renderer exceeds |z| = 4 in one run out of 16,000.
#include "08_indirect/radiance.h"
#include "common/util/paths.h"
#include "08_indirect/scene.h"
#include "common/model/obj_file.h"
#include "tests/08_indirect/step.h"
#include "tests/08_indirect/lamps.h"
#include "tests/08_indirect/paths.h"
#include "tests/check.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

using namespace rt;

TEST_CASE("near a large lamp all strategies give the same light") {
    // A floor point closely below a lamp that fills much of its hemisphere: quad, triangle or ball.
    const vec3 position(0.2f, 0, 0.3f), up(0, 1, 0);
    const std::vector<vec3> triangle{{-2, 0.3f, -1}, {2.5f, 0.5f, -1.5f}, {0.2f, 0.4f, 3}};
    for (int kind = 0; kind < 3; ++kind) {
        Scene scene;
        const int lamp = add(scene.materials, emissive(vec3(3)));
        scene.planes = {{{0, 0, 0}, up, add(scene.materials, Diffuse{vec3(0.6f)})}};
        double factor = 0;
        if (kind == 0) {
            scene.quads = {{{-1.5f, 0.4f, -1.5f}, {3, 0.3f, 0}, {0, 0.1f, 3}, lamp}};
            factor = form_factor(corners_of(scene.quads[0]), position, up);
        } else if (kind == 1) {
            add_triangle(scene, triangle[0], triangle[1], triangle[2], lamp);
            factor = form_factor(triangle, position, up);
        } else {
            scene.spheres = {{{0.5f, 1.3f, 0.1f}, 1, lamp}};
            const vec3 way = scene.spheres[0].center - position;
            factor = double(dot(normalize(way), up)) / double(dot(way, way));
        }
        for (const DirectLighting direct : all_ways)
            for (const HemisphereSampling hemisphere_sampling :
                 {HemisphereSampling::cosine, HemisphereSampling::uniform}) {
                const PathSettings settings{1, true, direct, false, hemisphere_sampling};
                const Mean mean =
                    seen(scene, settings, {position + vec3(-9, 0.5f, 0), vec3(9, -0.5f, 0)}, 40'000);
                INFO(std::string(kind == 0   ? "quad, "
                                 : kind == 1 ? "triangle, "
                                             : "ball, ")
                     << words(settings) << ": " << mean.against(0.6 * 3 * factor));
                INFO("too bright or too dark with MIS: the weights do not add up, or one strategy has the "
                     "pdf of the other");
                CHECK(off(mean, 0.6 * 3 * factor) < 4);
            }
    }
}

TEST_CASE("MIS has less noise than either strategy both near a lamp and far from it") {
    // A large lamp just above the floor, where light sampling is noisy, and a small one far above,
    // where BSDF sampling is noisy.
    const auto variance = [](bool both, DirectLighting direct) {
        Scene scene;
        scene.planes = {{{0, 0, 0}, {0, 1, 0}, add(scene.materials, Diffuse{vec3(0.6f)})}};
        scene.quads = {
            {{-1.5f, 0.15f, -1.5f}, {3, 0.2f, 0}, {0, 0.1f, 3}, add(scene.materials, emissive(vec3(1)))}};
        if (both) {
            scene.quads[0] = {{0.25f, 0.05f, -1.5f}, {1.5f, 1.2f, 0}, {0, 0, 3}, scene.quads[0].material};
            scene.quads.push_back(
                {{-1, 4, 0}, {0.3f, 0, 0}, {0, 0, 0.3f}, add(scene.materials, emissive(vec3(40)))});
        }
        const PathSettings settings{1, true, direct, false};
        return seen(scene, settings, {vec3(-9, 0.2f, 0.3f), vec3(9.2f, -0.2f, 0)}, 40'000).variance();
    };
    for (const bool both : {false, true}) {
        const double mis = variance(both, DirectLighting::mis);
        const double lights = variance(both, DirectLighting::light_sampling),
                     bounces = variance(both, DirectLighting::bsdf_sampling);
        INFO("variance " << mis << " with MIS, " << lights << " by light sampling, " << bounces
                         << " by BSDF sampling");
        CHECK(mis < 0.9 * lights);
        if (both) CHECK(mis < 0.9 * bounces);
    }
}

TEST_CASE("a bright ball gives the same light by BSDF sampling as by light sampling") {
    // The lamp is small and bright: clamping its rare, large samples would lose light.
    for (const DirectLighting direct : all_ways) {
        Scene scene;
        const int floor = add(scene.materials, Diffuse{vec3(0.6f)});
        scene.planes = {{{0, 0, 0}, normalize(vec3(0.2f, 1, -0.1f)), floor}};
        scene.spheres = {{{1, 2, -1.5f}, 0.3f, add(scene.materials, emissive(vec3(500)))}};
        const vec3 normal = scene.planes[0].normal, way(1, 2, -1.5f);
        const double want = 0.6 * 500 * 0.09 / double(dot(way, way)) * double(dot(normalize(way), normal));
        const PathSettings settings{1, true, direct, false};
        const Mean mean = seen(scene, settings, {{-3, 2, 2}, {3, -2, -2}}, 60'000);
        INFO(words(settings) << ": " << mean.against(want));
        CHECK(off(mean, want) < 4);
    }
}

TEST_CASE("triangles with Ke in a mesh's MTL are area lights on both sides") {
    const auto folder =
        std::filesystem::temp_directory_path() / ("raysteps_08_" + std::to_string(std::random_device{}()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "box.mtl") << "newmtl glow\nKd .5 .5 .5\nKe 1 2 0\n"
                                         "newmtl lamp\nKd 0 0 0\nKe 6 6 6\nnewmtl grey\nKd .6 .6 .6\n";
    // A closed box of 2 x 1 x 3; and, separately, a lamp over a floor.
    std::ofstream(folder / "box.obj")
        << "mtllib box.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 3\nv 2 0 3\nv 2 1 3\nv 0 1 3\n"
           "usemtl glow\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";
    std::ofstream(folder / "lamp.obj") << "mtllib box.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\n"
                                          "v -.5 2 -.5\nv .7 2.3 -.4\nv .1 2.1 .8\n"
                                          "usemtl grey\nf 1 4 3 2\nusemtl lamp\nf 5 6 7\n";
    const ObjModel box = read_obj(text_of(folder / "box.obj"));
    const ObjModel lamp = read_obj(text_of(folder / "lamp.obj"));
    std::filesystem::remove_all(folder);

    Scene closed;
    add_model(closed, box, 30);
    build_bvhs(closed);
    const AreaLights lights = collect_area_lights(closed);
    CHECK_MESSAGE(lights.lights.size() == 12, "every emissive triangle must be a separate light");
    Random random(61);
    const Ray inside{{0.7f, 0.4f, 1.2f}, {0.3f, -0.5f, 0.2f}};
    const vec3 chance =
        radiance(closed, lights, {60, true, DirectLighting::bsdf_sampling, false}, inside, random);
    INFO("Ke 1, Kd .5, closed: Ke / (1 - Kd) = 2");
    CHECK(chance == approx(vec3(2, 4, 0), 1e-4f));
    const Mean once = seen(closed, {1, true, DirectLighting::light_sampling, false}, inside);
    INFO("light sampling, one bounce: " << once.against(1.5));
    CHECK(off(once, 1.5) < 4);

    Scene open;
    add_model(open, lamp, 30);
    const std::vector<vec3> triangle{{-0.5f, 2, -0.5f}, {0.7f, 2.3f, -0.4f}, {0.1f, 2.1f, 0.8f}};
    const double want = 0.6 * 6 * form_factor(triangle, {0.4f, 0, -0.3f}, {0, 1, 0});
    for (const DirectLighting direct : all_ways) {
        const PathSettings settings{1, true, direct, false};
        const Mean mean = seen(open, settings, {{2.4f, 1, -1.3f}, {-2, -1, 1}}, 40'000);
        INFO("under the lamp, " << words(settings) << ": " << mean.against(want));
        CHECK(off(mean, want) < 4);
    }
    const vec3 above(0.2f, 4, 0.1f);
    const Mean back = received(open, above, {0, -1, 0});
    INFO("above the lamp: " << back.against(6 * form_factor(triangle, above, {0, -1, 0})));
    CHECK(off(back, 6 * form_factor(triangle, above, {0, -1, 0})) < 4);
}
