// Step 07 asks: what is a pixel?
#include "01_spheres/program/counted.h"
#include "01_spheres/program/options.h"
#include "05_mesh_bvh/program/options.h"
#include "04_refraction/radiance.h"
#include "06_textures/scene.h"
#include "07_antialias/program/options.h"
#include "common/util/paths.h"
#include "common/cli/program.h"

using namespace rt;

/// Returns a zone plate, rings sin(r^2): their frequency grows linearly from the centre to the border, where
/// a ring is nine texels wide.
Bitmap zone_plate(int size) {
    Bitmap bitmap{size, size, {}};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const vec2 p = vec2(float(2 * x + 1 - size), float(2 * y + 1 - size)) / 2.0f;
            const float wave = 0.5f + 0.45f * std::cos(0.7f * dot(p, p) / float(size));
            bitmap.values.insert(bitmap.values.end(), 3, std::uint16_t(65535 * srgb_from_linear(wave)));
        }
    return bitmap;
}

const LookAt test_chart_view{.from = {0, 1.25f, 5.2f}, .at = {0, 0.95f, 0}, .fov = 32};

/// Builds a scene of everything that shows aliasing: a floor to the horizon, rings that become finer and
/// finer, a slanted edge, and a bright wire thinner than a pixel.
LookAt test_chart(Scene& scene) {
    scene.sky = {.nadir = {0.5f, 0.46f, 0.42f}, .zenith = {0.28f, 0.4f, 0.66f}};
    scene.lights = {{{-3, 5, 5}, vec3(85, 80, 70)}};
    const int floor = add(scene.materials, Checkerboard{{0.75f, 0.72f, 0.66f}, {0.1f, 0.12f, 0.16f}, 0.5f});
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}};

    const int rings = add(scene.materials, ImageTexture{add(scene.textures, make_texture(zone_plate(1024)))});
    const int white = add(scene.materials, Diffuse{vec3(0.85f)});
    const int black = add(scene.materials, Diffuse{vec3(0.03f)});
    const int wire = add(scene.materials, emissive(vec3(3.0f, 2.6f, 1.6f)));
    scene.quads = {{{-1.75f, 0.15f, -0.6f}, {1.7f, 0, -0.1f}, {0, 1.7f, 0}, rings},
                   {{0.35f, 0.15f, -0.75f}, {1.5f, 0, 0.25f}, {0, 1.7f, 0}, white},
                   {{0.47f, 0.19f, -0.72f}, {1.22f, 0.3f, 0.2f}, {-0.02f, 0.75f, 0}, black},
                   {{-2.3f, 2.25f, 0.3f}, {4.6f, -0.35f, 0.2f}, {0, 0.0035f, 0}, wire},
                   {{-2.3f, 0.5f, 0.9f}, {4.6f, 1.2f, 0.1f}, {0, 0.0035f, 0}, wire}};

    ObjModel cat = read_obj(asset_path("cat.obj"));
    transform(cat, 0.7f, -70, {1.45f, 0, 0.75f});
    add_model(scene, cat, 40);
    return test_chart_view;
}

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
    const CameraOptions camera_options(options, test_chart_view);

    return run_program(options, argc, argv, [&](const RenderFunction& render) {
        const auto [width, height] = std::pair(options.settings().width, options.settings().height);
        Counted<Scene> scene;
        scene.accel = accel;
        scene.count_tests = view == DebugView::traversal_cost;
        const bool has_model = !model.mesh.empty();
        const LookAt look_at =
            camera_options.look_at_or(has_model ? add_framed_model(scene, model, float(width) / float(height))
                                                : own_scene_or(scene, test_chart));
        build_bvhs(scene);
        const Camera camera = make_camera(look_at, width, height);
        const ThinLens lens = lens_options.lens(look_at);
        render([&](const PixelSample& sample) {
            Sampler sampler(sampler_kind, sample);
            const vec2 point = film_point(sample, sampler, filter.filter, filter.width);
            const Ray ray = sample_camera_ray(camera, lens, point, sampler);
            if (view == DebugView::radiance) return radiance(scene, ray, depth);
            return debug_colour(scene, ray, view, distance(look_at.from, look_at.at));
        });
    });
}
