// Facts about the automatic framing of an unknown model.
#include "05_mesh_bvh/scene.h"
#include "common/util/paths.h"
#include "05_mesh_bvh/program/options.h"
#include "common/cli/options.h"
#include "common/math/random.h"
#include "tests/check.h"

#include <chrono>
#include <filesystem>
#include <fstream>

using namespace rt;

namespace {

struct Temporary {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() /
        ("raysteps_05_" +
         std::to_string(
             Random(std::uint64_t(std::chrono::steady_clock::now().time_since_epoch().count())).bits()));
    explicit Temporary(const std::string& text) { std::ofstream(path) << text; }
    ~Temporary() { std::filesystem::remove(path); }
    Temporary(const Temporary&) = delete;
};

} // namespace

TEST_CASE("the framing shows all of any model in a picture of any aspect ratio") {
    const Aabb boxes[] = {{{-1, -1, -1}, {1, 1, 1}},
                          {{3, 0, -7}, {4, 50, -6.5f}},
                          {{-100, 5, 0}, {300, 6, 2}},
                          {{1e-4f, 1e-4f, 0}, {2e-4f, 3e-4f, 1e-4f}},
                          {{1e4f, 1e4f, 1e4f}, {1.1e4f, 1.2e4f, 1.3e4f}},
                          {{0, 0, 0}, {1, 1, 0}},
                          {{5, 5, 5}, {5, 5, 5}}};
    for (const Aabb& box : boxes) {
        for (const float aspect : {0.3f, 1.0f, 1.6f, 4.0f}) {
            INFO("box ", box.min, " to ", box.max, ", aspect ", aspect);
            const Framing framing = frame_model(box, aspect);
            const LookAt& look_at = framing.look_at;
            const Camera camera = make_camera(look_at, int(1000 * aspect), 1000);
            float reach = 0;
            for (int i = 0; i < 8; ++i) {
                const vec3 corner{i & 1 ? box.min.x : box.max.x, i & 2 ? box.min.y : box.max.y,
                                  i & 4 ? box.min.z : box.max.z};
                const vec3 p = corner - camera.origin;
                const float depth = dot(p, camera.forward);
                REQUIRE_MESSAGE(depth > 0, "the corner must be in front of the camera");
                const float x = dot(p, camera.half_width) / dot(camera.half_width, camera.half_width) / depth;
                const float y =
                    dot(p, camera.half_height) / dot(camera.half_height, camera.half_height) / depth;
                CHECK(std::abs(x) <= 1);
                CHECK(std::abs(y) <= 1);
                reach = std::max({reach, std::abs(x), std::abs(y)});
            }
            if (box.min != box.max) CHECK_MESSAGE(reach > 0.2f, "the model must not be tiny in the distance");
            const float under = box.min.y - framing.floor.y, size = std::max(length(box.max - box.min), 1.0f);
            CHECK_MESSAGE(under > 0, "a floor of the model itself must be above the added floor");
            CHECK(under < 1e-3f * size);
            CHECK(framing.key_light.y > box.max.y);
            CHECK(look_at.from.y > centroid(box).y);
            const float squared = dot(framing.key_light - centroid(box), framing.key_light - centroid(box));
            CHECK(framing.intensity_scale / squared == approx(1, 0.01f));
        }
    }
}

TEST_CASE("a user's model is on a floor under a lamp unless --bare is given") {
    const Temporary file("v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    for (const bool bare : {false, true}) {
        Options options("05_mesh_bvh", "?", {});
        const ModelOptions knobs(options);
        const std::string path = text_of(file.path);
        std::vector<const char*> arguments = {"05_mesh_bvh", "--mesh", path.c_str()};
        if (bare) arguments.push_back("--bare");
        REQUIRE(options.parse(int(arguments.size()), arguments.data()));
        Scene scene;
        const LookAt look_at = add_framed_model(scene, knobs, 1.6f);
        build_bvhs(scene);
        CHECK(scene.mesh.triangles.size() == 4);
        CHECK(scene.planes.empty() == bare);
        CHECK(scene.lights.empty() == bare);
        const Ray ray = camera_ray(make_camera(look_at, 160, 100), {80, 50});
        CHECK(intersect(scene, ray).has_value());
        if (!bare) CHECK(scene.planes[0].point.y == approx(0, 1e-3f));
    }
}
