// Step 05 asks: what if there are a hundred thousand things to hit?
#include "01_spheres/view.h"
#include "04_refraction/radiance.h"
#include "05_mesh_bvh/scene.h"
#include "05_mesh_bvh/stage.h"
#include "common/paths.h"
#include "common/program.h"

using namespace rt;

/// A teapot of 57,600 triangles in a glaze, and a cat of a few hundred that shows its facets.
Pose teapot_and_cat(Scene& scene) {
    scene.sky = {.nadir = {0.3f, 0.26f, 0.24f}, .zenith = {0.36f, 0.46f, 0.62f}};
    scene.lights = {{{-2.6f, 4.2f, 3.4f}, vec3(50, 45, 37)}};
    const int floor = add(scene, Checker{{0.62f, 0.58f, 0.53f}, {0.5f, 0.45f, 0.4f}, 0.6f});
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}};

    ObjFile teapot = read_obj(asset("teapot_fine.obj"));
    teapot.material_list = {{.name = "glaze", .diffuse = {0.08f, 0.2f, 0.42f}, .reflectivity = 0.12f}};
    place(teapot, 0.5f, 25, {-0.45f, 0, 0});
    add(scene, teapot, 40);

    ObjFile cat = read_obj(asset("cat_low.obj"));
    cat.material_list = {{.name = "paper", .diffuse = {0.86f, 0.45f, 0.16f}}};
    for (auto& triangle : cat.triangles)
        for (ObjCorner& corner : triangle) corner.normal = -1;
    place(cat, 1.0f, -50, {1.05f, 0, 0.35f});
    add(scene, cat, 0); // no smoothing at all
    return {.from = {0.35f, 1.5f, 4.2f}, .at = {0.1f, 0.48f, 0}, .fov = 32};
}

int main(int argc, char** argv) {
    Options options("05_mesh_bvh", "What if there are a hundred thousand things to hit?",
                    {.width = 640, .height = 400, .samples = 16});
    const ModelKnobs model(options);
    const auto accel = options.choice("accel", {"brute", "bvh"}, Accel::bvh,
                                      "how a ray finds what it meets: ask every triangle, or descend a tree");
    const int& depth = options.knob("depth", 6, 0, 24, "mirrors and boundaries that a ray may meet");
    const auto view = view_knob(options);
    const CameraKnobs camera_knobs(options, {.from = {0.35f, 1.5f, 4.2f}, .at = {0.1f, 0.48f, 0}, .fov = 32});

    return run_program(options, argc, argv, [&](const RenderCall& render) {
        const auto [width, height] = std::pair(options.picture().width, options.picture().height);
        Scene scene;
        scene.accel = accel;
        const bool own = !model.mesh.empty();
        const Pose pose = camera_knobs.pose(own ? stage_model(scene, model, float(width) / float(height))
                                                : teapot_and_cat(scene));
        prepare(scene);
        const Camera camera = make_camera(pose, width, height);
        render([&](Sample& sample) {
            const Ray ray = camera_ray(camera, vec2(sample.x, sample.y) + in_pixel(sample.index));
            if (view == View::light) return radiance(scene, ray, depth);
            return what_is_hit(scene, ray, view, distance(pose.from, pose.at));
        });
    });
}
