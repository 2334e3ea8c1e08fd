// Step 03 asks: what does the mirror see?
#include "01_spheres/camera.h"
#include "01_spheres/program/counted.h"
#include "01_spheres/program/options.h"
#include "03_mirror/radiance.h"
#include "03_mirror/scene.h"
#include "common/cli/program.h"

using namespace rt;

/// Builds two mirrors that face each other across three spheres: one of steel, one of red lacquer over matte
/// paint, and a matte orange one.
Scene facing_mirrors(float reflectivity) {
    Scene scene;
    scene.sky = {.nadir = {0.75f, 0.4f, 0.22f}, .zenith = {0.1f, 0.28f, 0.7f}};
    const int orange = add(scene.materials, Diffuse{{0.85f, 0.42f, 0.1f}});
    const int red = add(scene.materials, Diffuse{{0.7f, 0.06f, 0.08f}});
    const int lacquer = add(scene.materials, Coated{reflectivity, red});
    const int steel = add(scene.materials, Mirror{{0.92f, 0.92f, 0.95f}});
    const int silver =
        add(scene.materials, Mirror{{0.82f, 0.9f, 0.86f}}); // old glass: greener with every reflection
    const int frame = add(scene.materials, Diffuse{{0.16f, 0.1f, 0.06f}});
    const int floor = add(scene.materials, Checkerboard{{0.72f, 0.7f, 0.66f}, {0.14f, 0.17f, 0.22f}, 0.5f});
    scene.lights = {{{0.6f, 4.5f, 3.2f}, vec3(42, 38, 32)}};
    scene.spheres = {{{-0.1f, 0.75f, -0.55f}, 0.75f, steel},
                     {{0.75f, 0.45f, 0.45f}, 0.45f, lacquer},
                     {{-0.55f, 0.28f, 0.75f}, 0.28f, orange}};
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}};
    scene.quads = {{{-1.9f, 0.06f, 1.5f}, {0, 0, -4}, {0, 2.1f, 0}, silver},
                   {{2.3f, 0.06f, 1.2f}, {-0.5f, 0, -3.6f}, {0, 2.1f, 0}, silver},
                   {{-1.91f, 0, 1.56f}, {0, 0, -4.12f}, {0, 2.22f, 0}, frame},
                   {{2.32f, 0, 1.26f}, {-0.516f, 0, -3.72f}, {0, 2.22f, 0}, frame}};
    return scene;
}

int main(int argc, char** argv) {
    Options options("03_mirror", "What does the mirror see?", {.width = 640, .height = 400, .samples = 16});
    const float& reflectivity = options.option("reflectivity", 0.25f, 0.0f, 1.0f,
                                               "fraction of light that the lacquer reflects like a mirror");
    const int& depth =
        options.option("depth", 12, 0, 100, "maximum number of reflections; beyond them the ray is black");
    const auto view = view_option(options);
    const CameraOptions camera_options(options,
                                       {.from = {1.72f, 1.5f, 3.7f}, .at = {-0.62f, 0.74f, 0}, .fov = 43});

    return run_program(options, argc, argv, [&](const RenderFunction& render) {
        const Counted<Scene> scene{facing_mirrors(reflectivity)};
        const LookAt look_at = camera_options.look_at();
        const Camera camera = make_camera(look_at, options.settings().width, options.settings().height);
        render([&](PixelSample& sample) {
            const Ray ray = camera_ray(camera, vec2(sample.x, sample.y) + r2_offset(sample.index));
            if (view == DebugView::radiance) return radiance(scene, ray, depth);
            return debug_colour(scene, ray, view, distance(look_at.from, look_at.at));
        });
    });
}
