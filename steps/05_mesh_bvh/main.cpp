// Step 05 asks: what if there are a million things to hit?
#include "01_spheres/program/counted.h"
#include "01_spheres/program/options.h"
#include "04_refraction/radiance.h"
#include "05_mesh_bvh/program/options.h"
#include "05_mesh_bvh/program/tea_party.h"
#include "common/cli/program.h"

using namespace rt;

int main(int argc, char** argv) {
    Options options("05_mesh_bvh", "What if there are a million things to hit?",
                    {.width = 640, .height = 400, .samples = 16});
    const ModelOptions model(options);
    const auto accel = accel_option(options, Accel::bvh);
    const int& depth =
        options.option("depth", 6, 0, 24, "maximum number of reflections and refractions along a ray");
    const auto view = view_option(options);
    const CameraOptions camera_options(options, tea_party_view);

    return run_program(options, argc, argv, [&](const RenderFunction& render) {
        const auto [width, height] = std::pair(options.settings().width, options.settings().height);
        Counted<Scene> scene;
        scene.accel = accel;
        scene.count_tests = view == DebugView::traversal_cost;
        const bool has_model = !model.mesh.empty();
        const LookAt look_at =
            camera_options.look_at_or(has_model ? add_framed_model(scene, model, float(width) / float(height))
                                                : own_scene_or(scene, tea_party));
        build_bvhs(scene);
        const Camera camera = make_camera(look_at, width, height);
        render([&](PixelSample& sample) {
            const Ray ray = camera_ray(camera, vec2(sample.x, sample.y) + r2_offset(sample.index));
            if (view == DebugView::radiance) return radiance(scene, ray, depth);
            return debug_colour(scene, ray, view, distance(look_at.from, look_at.at));
        });
    });
}
