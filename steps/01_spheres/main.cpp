// Step 01 asks: what does a ray see first?
#include "01_spheres/camera.h"
#include "01_spheres/radiance.h"
#include "01_spheres/scene.h"
#include "01_spheres/program/counted.h"
#include "01_spheres/program/options.h"
#include "common/cli/program.h"

using namespace rt;

/// Builds three spheres on a checkered floor, under an evening sky that is brighter on the left.
Scene three_spheres(float radius, float squares) {
    Scene scene;
    scene.sky = {.nadir = {0, 0.1f, 0.5f}, .zenith = {1.45f, 1.05f, 0.65f}, .up = vec3(-6, 3, 2) / 7.0f};
    const int terracotta = add(scene.materials, Diffuse{{0.85f, 0.22f, 0.09f}});
    const int teal = add(scene.materials, Diffuse{{0.02f, 0.4f, 0.46f}});
    const int mustard = add(scene.materials, Diffuse{{0.95f, 0.6f, 0.05f}});
    const int floor =
        add(scene.materials, Checkerboard{{0.8f, 0.62f, 0.42f}, {0.28f, 0.14f, 0.08f}, squares});
    scene.spheres = {{{0, radius, 0}, radius, terracotta},
                     {{1.75f, 0.6f, 0.55f}, 0.6f, teal},
                     {{-1.45f, 0.38f, 1.0f}, 0.38f, mustard}};
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}};
    return scene;
}

int main(int argc, char** argv) {
    Options options("01_spheres", "What does a ray see first?", {.width = 640, .height = 400, .samples = 16});
    const float& radius = options.option("radius", 1.0f, 0.1f, 3.0f, "radius of the middle sphere, metres");
    const float& squares =
        options.option("squares", 0.5f, 0.05f, 10.0f, "width of the floor's squares, metres");
    const auto view = view_option(options);
    const CameraOptions camera_options(options,
                                       {.from = {0.3f, 1.1f, 5.5f}, .at = {0.1f, 0.8f, 0}, .fov = 36});

    return run_program(options, argc, argv, [&](const RenderFunction& render) {
        const Counted<Scene> scene{three_spheres(radius, squares)};
        const LookAt look_at = camera_options.look_at();
        const Camera camera = make_camera(look_at, options.settings().width, options.settings().height);
        render([&](PixelSample& sample) {
            const Ray ray = camera_ray(camera, vec2(sample.x, sample.y) + r2_offset(sample.index));
            if (view == DebugView::radiance) return radiance(scene, ray);
            return debug_colour(scene, ray, view, distance(look_at.from, look_at.at));
        });
    });
}
