// Step 02 asks: does the light get there?
#include "01_spheres/camera.h"
#include "01_spheres/program/counted.h"
#include "01_spheres/program/options.h"
#include "02_shadows/radiance.h"
#include "02_shadows/scene.h"
#include "common/cli/program.h"

using namespace rt;

/// Builds spheres at dusk between a warm light and a cool one. One floats just above the floor, and one is
/// behind the warm light, where it must not cast a shadow.
Scene two_lights(float warm, float cool) {
    Scene scene;
    scene.sky = {.nadir = {0.05f, 0.045f, 0.06f}, .zenith = {0.02f, 0.03f, 0.08f}};
    const int chalk = add(scene.materials, Diffuse{{0.82f, 0.8f, 0.76f}});
    const int rose = add(scene.materials, Diffuse{{0.8f, 0.3f, 0.32f}});
    const int sage = add(scene.materials, Diffuse{{0.35f, 0.6f, 0.4f}});
    const int floor = add(scene.materials, Checkerboard{{0.62f, 0.6f, 0.57f}, {0.42f, 0.41f, 0.42f}, 0.5f});
    scene.lights = {{{-2.2f, 3.0f, 2.0f}, warm * vec3(1, 0.72f, 0.42f)},
                    {{3.2f, 2.2f, 1.2f}, cool * vec3(0.4f, 0.62f, 1)}};
    scene.spheres = {{{0, 0.9f, 0}, 0.9f, chalk},
                     {{1.55f, 0.62f, 0.75f}, 0.42f, rose}, // floats: its lowest point is at y = 0.2
                     {{-1.5f, 0.45f, 0.6f}, 0.45f, sage},
                     {{-3.1f, 4.2f, 2.9f}, 0.7f, rose}}; // behind the warm light
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}};
    return scene;
}

int main(int argc, char** argv) {
    Options options("02_shadows", "Does the light get there?", {.width = 640, .height = 400, .samples = 16});
    const float& warm = options.option("warm", 22.0f, 0.0f, 1000.0f, "intensity of the warm light, W/sr");
    const float& cool = options.option("cool", 14.0f, 0.0f, 1000.0f, "intensity of the cool light, W/sr");
    const auto view = view_option(options);
    const CameraOptions camera_options(options, {.from = {0.2f, 2.4f, 6.2f}, .at = {0, 0.7f, 0}, .fov = 34});

    return run_program(options, argc, argv, [&](const RenderFunction& render) {
        const Counted<Scene> scene{two_lights(warm, cool)};
        const LookAt look_at = camera_options.look_at();
        const Camera camera = make_camera(look_at, options.settings().width, options.settings().height);
        render([&](PixelSample& sample) {
            const Ray ray = camera_ray(camera, vec2(sample.x, sample.y) + r2_offset(sample.index));
            if (view == DebugView::radiance) return radiance(scene, ray);
            return debug_colour(scene, ray, view, distance(look_at.from, look_at.at));
        });
    });
}
