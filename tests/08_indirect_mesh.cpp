// Facts about lamps in a mesh.
// Noisy facts are z-tests with a fixed seed: a right renderer is beyond |z| = 4 in one run of 16,000.
#include "08_indirect/radiance.h"
#include "08_indirect/scene.h"
#include "common/obj_file.h"
#include "tests/08_indirect.h"
#include "tests/08_indirect_lamps.h"
#include "tests/08_indirect_paths.h"
#include "tests/check.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace rt;

TEST_CASE("triangles with Ke in a mesh's MTL are area lights on both sides") {
    const auto folder = std::filesystem::temp_directory_path() / ("raysteps_08_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "box.mtl") << "newmtl glow\nKd .5 .5 .5\nKe 1 2 0\n"
                                         "newmtl lamp\nKd 0 0 0\nKe 6 6 6\nnewmtl grey\nKd .6 .6 .6\n";
    // A box 2 x 1 x 3 that is closed, and by itself a lamp over a floor.
    std::ofstream(folder / "box.obj")
        << "mtllib box.mtl\nv 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 0 0 3\nv 2 0 3\nv 2 1 3\nv 0 1 3\n"
           "usemtl glow\nf 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";
    std::ofstream(folder / "lamp.obj") << "mtllib box.mtl\nv -4 0 -4\nv 4 0 -4\nv 4 0 4\nv -4 0 4\n"
                                          "v -.5 2 -.5\nv .7 2.3 -.4\nv .1 2.1 .8\n"
                                          "usemtl grey\nf 1 4 3 2\nusemtl lamp\nf 5 6 7\n";
    const ObjFile box = read_obj((folder / "box.obj").string());
    const ObjFile lamp = read_obj((folder / "lamp.obj").string());
    std::filesystem::remove_all(folder);

    Scene closed;
    add(closed, box, 30);
    prepare(closed);
    const AreaLights lights = area_lights(closed);
    CHECK_MESSAGE(lights.list.size() == 12, "every triangle that glows is a light of its own");
    Random random(61);
    const Ray inside{{0.7f, 0.4f, 1.2f}, {0.3f, -0.5f, 0.2f}};
    const vec3 chance = radiance(closed, lights, {60, true, Direct::bounces, false}, inside, random);
    INFO("Ke 1, Kd .5, closed: Ke / (1 - Kd) = 2");
    CHECK(chance == approx(vec3(2, 4, 0), 1e-4f));
    const Mean once = seen(closed, {1, true, Direct::lights, false}, inside);
    INFO("lights sampled, one bounce: " << once.against(1.5));
    CHECK(off(once, 1.5) < 4);

    Scene open;
    add(open, lamp, 30);
    const std::vector<vec3> triangle{{-0.5f, 2, -0.5f}, {0.7f, 2.3f, -0.4f}, {0.1f, 2.1f, 0.8f}};
    const double want = 0.6 * 6 * form_factor(triangle, {0.4f, 0, -0.3f}, {0, 1, 0});
    for (const Direct direct : all_ways) {
        const Transport transport{1, true, direct, false};
        const Mean mean = seen(open, transport, {{2.4f, 1, -1.3f}, {-2, -1, 1}}, 40'000);
        INFO("under the lamp, " << words(transport) << ": " << mean.against(want));
        CHECK(off(mean, want) < 4);
    }
    const vec3 above(0.2f, 4, 0.1f);
    const Mean back = received(open, above, {0, -1, 0});
    INFO("above the lamp: " << back.against(6 * form_factor(triangle, above, {0, -1, 0})));
    CHECK(off(back, 6 * form_factor(triangle, above, {0, -1, 0})) < 4);
}
