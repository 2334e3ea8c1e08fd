// Step 06 asks: how does a picture get onto a surface?
#include "01_spheres/program/counted.h"
#include "01_spheres/program/options.h"
#include "05_mesh_bvh/program/options.h"
#include "04_refraction/radiance.h"
#include "06_textures/scene.h"
#include "common/util/paths.h"
#include "common/cli/program.h"

using namespace rt;

const LookAt meadow_view{.from = {0.25f, 1.35f, 5.0f}, .at = {0.25f, 0.6f, 0}, .fov = 33};

/// Builds a cow and a cat on a checkered lawn, a globe, and the test card on an easel.
LookAt meadow(Scene& scene, int tiles) {
    scene.sky = {.nadir = {0.42f, 0.4f, 0.34f}, .zenith = {0.3f, 0.48f, 0.85f}};
    scene.lights = {{{-4.5f, 7, 6}, vec3(165, 150, 125)}};
    const int lawn = add(scene.materials, Checkerboard{{0.36f, 0.56f, 0.2f}, {0.28f, 0.47f, 0.16f}, 0.5f});
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, lawn}};

    const int globe =
        add(scene.materials,
            ImageTexture{add(scene.textures, make_texture(read_bitmap(asset_path("globe.png"))))});
    scene.spheres = {{{1.75f, 0.36f, 0.85f}, 0.36f, globe}};
    const int card_picture = add(scene.textures, make_texture(read_bitmap(asset_path("test_card.png"))));
    const int card =
        add(scene.materials, ImageTexture{.texture = card_picture, .uv_scale = vec2(float(tiles))});
    scene.quads = {{{0.75f, 0.25f, -1.0f}, {1.75f, 0, 0.35f}, {0.04f, 1.1f, -0.2f}, card}};

    ObjModel cow = read_obj(asset_path("cow.obj"));
    transform(cow, 1.35f, -35, {-0.85f, 0, -0.3f});
    add_model(scene, cow, 40);
    ObjModel cat = read_obj(asset_path("cat.obj"));
    transform(cat, 0.62f, -60, {0.55f, 0, 0.85f});
    add_model(scene, cat, 40);
    return meadow_view;
}

int main(int argc, char** argv) {
    Options options("06_textures", "How does a picture get onto a surface?",
                    {.width = 640, .height = 400, .samples = 16});
    const ModelOptions model(options);
    const int& tiles = options.option("tiles", 1, 1, 50, "repetitions of the test card along each side");
    const auto accel = accel_option(options, Accel::wide);
    const int& depth =
        options.option("depth", 6, 0, 24, "maximum number of reflections and refractions along a ray");
    const auto view = view_option(options);
    const CameraOptions camera_options(options, meadow_view);

    return run_program(options, argc, argv, [&](const RenderFunction& render) {
        const auto [width, height] = std::pair(options.settings().width, options.settings().height);
        Counted<Scene> scene;
        scene.accel = accel;
        scene.count_tests = view == DebugView::traversal_cost;
        const bool has_model = !model.mesh.empty();
        const LookAt look_at = camera_options.look_at_or(
            has_model ? add_framed_model(scene, model, float(width) / float(height))
                      : own_scene_or(scene, [&](Scene& own) { return meadow(own, tiles); }));
        build_bvhs(scene);
        const Camera camera = make_camera(look_at, width, height);
        render([&](PixelSample& sample) {
            const Ray ray = camera_ray(camera, vec2(sample.x, sample.y) + r2_offset(sample.index));
            if (view == DebugView::radiance) return radiance(scene, ray, depth);
            return debug_colour(scene, ray, view, distance(look_at.from, look_at.at));
        });
    });
}
