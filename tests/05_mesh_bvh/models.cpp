// Facts about light on whole models: a glass mesh, and the Stanford bunny.
#include "04_refraction/radiance.h"
#include "05_mesh_bvh/scene.h"
#include "05_mesh_bvh/program/framing.h"
#include "tests/05_mesh_bvh/step.h"
#include "tests/check.h"
#include "tests/meshes.h"

#include <ctime>
#include <filesystem>

using namespace rt;

TEST_CASE("a glass mesh is a lens: from inside a ball of triangles light gets out again") {
    ObjModel file = icosphere(4);
    file.materials = {{.ior = 1.5f, .glass = true}};
    Scene scene = scene_of(file);
    scene.sky = {vec3(1), vec3(1)};
    for (const float offset : {0.0f, 0.2f, 0.5f, 0.7f}) {
        const Ray ray{vec3(offset, 0.1f, 4), {0, 0, -2}};
        INFO("offset ", offset);
        CHECK_MESSAGE(radiance(scene, ray, 20) == approx(vec3(1), 2e-3f),
                      "a white furnace; less: back faces are culled");
    }
}

TEST_CASE(
    "the bunny of Debian's glmark2-data loads and renders within seconds, and the tree changes nothing") {
    const std::string path = "/usr/share/glmark2/models/bunny.obj";
    if (!std::filesystem::exists(path)) {
        SKIP_CHECK(path + " is not there: apt-get install glmark2-data");
        return;
    }
    const std::clock_t start = std::clock();
    Scene scene = scene_of(read_obj(path));
    CHECK(scene.mesh.triangles.size() > 10000);
    const Aabb box = bounds(scene.mesh);
    const Framing framing = frame_model(box, 1);
    scene.lights = {{framing.key_light, vec3(3 * framing.intensity_scale)}};
    scene.sky = {vec3(0), vec3(0.2f)};
    const Camera camera = make_camera(framing.look_at, 60, 60);
    int covered = 0, unlit = 0;
    for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 60; ++x) {
            const Ray ray = camera_ray(camera, vec2(x, y) + 0.5f);
            if (!intersect(scene, ray)) continue;
            ++covered;
            const vec3 light = radiance(scene, ray, 3);
            unlit += !(light.x >= 0 && light.x < 10);
        }
    }
    const double seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
    CHECK_MESSAGE(covered > 300, "of 3,600 pixels");
    CHECK(unlit == 0);
    CHECK_MESSAGE(seconds < 20, "it took ", seconds, " s of processor time");
    check_tree_changes_nothing(scene, box, 60);
}
