// Step 07 asks: what is a pixel?
#include "01_spheres/program/counted.h"
#include "01_spheres/program/options.h"
#include "05_mesh_bvh/program/options.h"
#include "04_refraction/radiance.h"
#include "06_textures/scene.h"
#include "07_antialias/program/dusk.h"
#include "07_antialias/program/options.h"
#include "common/cli/program.h"

using namespace rt;

int main(int argc, char** argv) {
    Options options("07_antialias", "What is a pixel?", {.width = 640, .height = 400, .samples = 64});
    const ModelOptions model(options);
    const auto sampler_kind = sampler_option(options);
    const FilterOptions filter(options);
    const LensOptions lens_options(options);
    const auto accel = accel_option(options, Accel::wide);
    const int& depth =
        options.option("depth", 6, 0, 24, "maximum number of reflections and refractions along a ray");
    const auto view = view_option(options);
    const CameraOptions camera_options(options, dusk_view);

    return run_program(options, argc, argv, [&](const RenderFunction& render) {
        const auto [width, height] = std::pair(options.settings().width, options.settings().height);
        Counted<Scene> scene;
        scene.accel = accel;
        scene.count_tests = view == DebugView::traversal_cost;
        const bool has_model = !model.mesh.empty();
        ThinLens scene_lens{.aperture_diameter = 0, .focus_distance = 0};
        const LookAt look_at =
            camera_options.look_at_or(has_model ? add_framed_model(scene, model, float(width) / float(height))
                                                : own_scene_or(scene, [&](Scene& own) {
                                                      scene_lens = dusk_lens;
                                                      return dusk(own);
                                                  }));
        build_bvhs(scene);
        const Camera camera = make_camera(look_at, width, height);
        const ThinLens lens = lens_options.lens(look_at, scene_lens);
        render([&](const PixelSample& sample) {
            Sampler sampler(sampler_kind, sample);
            const vec2 point = film_point(sample, sampler, filter.filter, filter.width);
            const Ray ray = sample_camera_ray(camera, lens, point, sampler);
            if (view == DebugView::radiance) return radiance(scene, ray, depth);
            return debug_colour(scene, ray, view, distance(look_at.from, look_at.at));
        });
    });
}
