// Step 04 asks: where does light go in glass?
#include "01_spheres/camera.h"
#include "01_spheres/program/counted.h"
#include "01_spheres/program/options.h"
#include "04_refraction/radiance.h"
#include "04_refraction/scene.h"
#include "common/cli/program.h"

using namespace rt;

/// Builds a clear glass sphere, one with a bubble of air and one of tinted glass, in front of
/// a few coloured spheres.
Scene glass_balls(float ior, float bubble, float absorption) {
    Scene scene;
    scene.sky = {.nadir = {0.95f, 0.62f, 0.4f}, .zenith = {0.12f, 0.36f, 0.85f}};
    const Medium glass{ior};
    const int clear = add(scene.materials, Dielectric{glass});
    const int air = add(scene.materials, Dielectric{Medium{}, glass}); // inside is air, outside is glass
    const int tinted = add(scene.materials, Dielectric{{ior, absorption * vec3(0.35f, 0.06f, 0.9f)}});
    const int coral = add(scene.materials, Diffuse{{0.85f, 0.25f, 0.18f}});
    const int navy = add(scene.materials, Diffuse{{0.1f, 0.18f, 0.5f}});
    const int lemon = add(scene.materials, Diffuse{{0.9f, 0.75f, 0.15f}});
    const int floor = add(scene.materials, Checkerboard{{0.72f, 0.62f, 0.5f}, {0.32f, 0.2f, 0.15f}, 0.5f});
    scene.lights = {{{-3, 6, 4}, vec3(50, 47, 40)}};
    scene.spheres = {{{0, 0.85f, 0}, 0.85f, clear},          {{0, 0.85f, 0}, 0.85f * bubble, air},
                     {{-1.6f, 0.62f, 0.35f}, 0.62f, clear},  {{1.55f, 0.6f, 0.45f}, 0.6f, tinted},
                     {{-0.85f, 0.45f, -1.9f}, 0.45f, coral}, {{0.95f, 0.55f, -2.1f}, 0.55f, navy},
                     {{2.9f, 0.5f, -1.6f}, 0.5f, lemon},     {{-2.9f, 0.4f, -1.5f}, 0.4f, lemon},
                     {{0.75f, 0.2f, 1.35f}, 0.2f, coral}};
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}};
    return scene;
}

int main(int argc, char** argv) {
    Options options("04_refraction", "Where does light go in glass?",
                    {.width = 640, .height = 400, .samples = 9});
    const float& ior = options.option("ior", 1.5f, 1.0f, 2.5f, "index of refraction of the glass spheres");
    const float& bubble =
        options.option("bubble", 0.8f, 0.05f, 0.98f, "radius of the bubble, in radii of its sphere");
    const float& absorption =
        options.option("absorption", 2.5f, 0.0f, 50.0f, "absorption of the tinted glass, 1/m");
    const int& depth = options.option("depth", 7, 0, 14,
                                      "maximum number of boundaries along a ray; beyond them it is black; "
                                      "each more takes 1.5 times as long");
    const auto view = view_option(options);
    const CameraOptions camera_options(options,
                                       {.from = {0.3f, 1.55f, 5.6f}, .at = {0, 0.68f, 0}, .fov = 34});

    return run_program(options, argc, argv, [&](const RenderFunction& render) {
        const Counted<Scene> scene{glass_balls(ior, bubble, absorption)};
        const LookAt look_at = camera_options.look_at();
        const Camera camera = make_camera(look_at, options.settings().width, options.settings().height);
        render([&](PixelSample& sample) {
            const Ray ray = camera_ray(camera, vec2(sample.x, sample.y) + r2_offset(sample.index));
            if (view == DebugView::radiance) return radiance(scene, ray, depth);
            return debug_colour(scene, ray, view, distance(look_at.from, look_at.at));
        });
    });
}
