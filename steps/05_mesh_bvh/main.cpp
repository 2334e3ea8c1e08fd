// Step 05 asks: what if there are a hundred thousand things to hit?
#include "01_spheres/program/counted.h"
#include "01_spheres/program/options.h"
#include "04_refraction/radiance.h"
#include "05_mesh_bvh/scene.h"
#include "05_mesh_bvh/program/options.h"
#include "common/util/paths.h"
#include "common/cli/program.h"

using namespace rt;

const LookAt tea_table_view{.from = {0.35f, 1.5f, 4.2f}, .at = {0.12f, 0.48f, 0}, .fov = 32};

/// Builds a glazed teapot of 57,360 triangles, one of 552 that shows its facets, and a cat.
LookAt tea_table(Scene& scene) {
    scene.sky = {.nadir = {0.3f, 0.26f, 0.24f}, .zenith = {0.36f, 0.46f, 0.62f}};
    scene.lights = {{{-2.6f, 4.2f, 3.4f}, vec3(50, 45, 37)}};
    const int floor = add(scene.materials, Checkerboard{{0.62f, 0.58f, 0.53f}, {0.5f, 0.45f, 0.4f}, 0.6f});
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}};

    ObjModel fine = read_obj(asset_path("teapot_fine.obj"));
    fine.materials = {{.name = "glaze", .diffuse = {0.05f, 0.16f, 0.4f}, .reflectivity = 0.12f}};
    transform(fine, 0.62f, 25, {-0.5f, 0, -0.25f});
    add_model(scene, fine, 40);

    ObjModel coarse = read_obj(asset_path("teapot_coarse.obj"));
    coarse.materials = {{.name = "paper", .diffuse = {0.85f, 0.42f, 0.14f}}};
    for (auto& triangle : coarse.triangles)
        for (ObjIndex& corner : triangle) corner.normal = -1; // without its own normals
    transform(coarse, 0.34f, 150, {0.3f, 0, 0.95f});
    add_model(scene, coarse, 0); // crease 0: no smoothing

    ObjModel cat = read_obj(asset_path("cat.obj"));
    cat.materials = {{.name = "chalk", .diffuse = {0.8f, 0.76f, 0.7f}}};
    transform(cat, 0.85f, -50, {1.15f, 0, 0.05f});
    add_model(scene, cat, 40);
    return tea_table_view;
}

int main(int argc, char** argv) {
    Options options("05_mesh_bvh", "What if there are a hundred thousand things to hit?",
                    {.width = 640, .height = 400, .samples = 16});
    const ModelOptions model(options);
    const auto accel = accel_option(options, Accel::bvh);
    const int& depth =
        options.option("depth", 6, 0, 24, "maximum number of reflections and refractions along a ray");
    const auto view = view_option(options);
    const CameraOptions camera_options(options, tea_table_view);

    return run_program(options, argc, argv, [&](const RenderFunction& render) {
        const auto [width, height] = std::pair(options.settings().width, options.settings().height);
        Counted<Scene> scene;
        scene.accel = accel;
        scene.count_tests = view == DebugView::traversal_cost;
        const bool has_model = !model.mesh.empty();
        const LookAt look_at =
            camera_options.look_at_or(has_model ? add_framed_model(scene, model, float(width) / float(height))
                                                : own_scene_or(scene, tea_table));
        build_bvhs(scene);
        const Camera camera = make_camera(look_at, width, height);
        render([&](PixelSample& sample) {
            const Ray ray = camera_ray(camera, vec2(sample.x, sample.y) + r2_offset(sample.index));
            if (view == DebugView::radiance) return radiance(scene, ray, depth);
            return debug_colour(scene, ray, view, distance(look_at.from, look_at.at));
        });
    });
}
