// Step 08 asks: where does all the light come from?
#include "01_spheres/program/counted.h"
#include "01_spheres/program/options.h"
#include "05_mesh_bvh/program/options.h"
#include "07_antialias/program/options.h"
#include "08_indirect/program/cat_room.h"
#include "08_indirect/program/cornell.h"
#include "08_indirect/program/cover.h"
#include "08_indirect/radiance.h"
#include "08_indirect/program/room.h"
#include "08_indirect/scene.h"
#include "08_indirect/program/weekend.h"
#include "common/cli/program.h"

using namespace rt;

enum class SceneName { room, furnace, cornell, weekend, cat, cover };

/// Builds a white furnace: a white sphere in a uniform environment. It reflects all the light that it
/// receives, so it must be invisible.
LookAt furnace(Scene& scene) {
    scene.sky = {vec3(0.5f), vec3(0.5f)};
    const int white = add(scene.materials, Diffuse{vec3(1)});
    scene.spheres = {{{0, 0, 0}, 1, white}};
    return {.from = {0, 0, 4}, .at = {0, 0, 0}, .fov = 40};
}

/// Returns the lens of a scene: most have a pinhole.
ThinLens lens_of(SceneName show) {
    if (show == SceneName::weekend) return weekend_lens;
    return show == SceneName::cover ? cover_lens : ThinLens{.aperture_diameter = 0, .focus_distance = 0};
}

/// Builds one of this step's own scenes.
LookAt build_scene(Scene& scene, SceneName show) {
    switch (show) {
    case SceneName::furnace: return furnace(scene);
    case SceneName::cornell: return cornell(scene);
    case SceneName::weekend: return weekend(scene);
    case SceneName::cat: return cat_room(scene);
    case SceneName::cover: return cover(scene);
    default: return room(scene);
    }
}

int main(int argc, char** argv) {
    Options options("08_indirect", "Where does all the light come from?",
                    {.width = 480, .height = 480, .samples = 64});
    const ModelOptions model(options);
    const std::string& spheres =
        options.file("spheres", "a list of spheres to show with the camera and light of --scene weekend");
    const auto show = options.choice(
        "scene", {"room", "furnace", "cornell", "weekend", "cat", "cover"}, SceneName::room,
        "what to show: the room of the reference; a white sphere in a white world, which must be invisible; "
        "a Cornell box; the spheres of a well-known book; a cat at home; a picture for a cover, best at 1280 "
        "x 720 pixels and 1024 samples");
    const auto accel = accel_option(options, Accel::wide);
    const auto sampler_kind = sampler_option(options);
    const FilterOptions filter(options);
    const LensOptions lens_options(options);
    const int& depth =
        options.option("depth", 5, 0, 1000, "maximum number of bounces of a path; light beyond is ignored");
    const bool& no_indirect = options.flag(
        "no-indirect", "matte surfaces receive light from lamps and sky, but not from each other");
    const auto direct =
        options.choice("direct", {"mis", "lights", "bounces"}, DirectLighting::mis,
                       "how a path finds lamps: by sampling them (lights), by hitting them (bounces), or by "
                       "both, weighted (mis): same image, different noise");
    const auto hemisphere_sampling =
        options.choice("bounce", {"cosine", "uniform"}, HemisphereSampling::cosine,
                       "density of the bounce directions: same image, different noise");
    const bool& no_roulette =
        options.flag("no-roulette", "every path continues to its full depth: same image, slower");
    const auto view = view_option(options);
    const CameraOptions camera_options(options, room_view);

    return run_program(options, argc, argv, [&](const RenderFunction& render) {
        const auto [width, height] = std::pair(options.settings().width, options.settings().height);
        Counted<Scene> scene;
        scene.accel = accel;
        scene.count_tests = view == DebugView::traversal_cost;
        const LookAt look_at = camera_options.look_at_or(
            !model.mesh.empty() ? add_framed_model(scene, model, float(width) / float(height))
            : !spheres.empty()  ? weekend(scene, read_sphere_list(spheres))
                                : own_scene_or(scene, [&](Scene& own) { return build_scene(own, show); }));
        build_bvhs(scene);
        const AreaLights lights = collect_area_lights(scene);
        const PathSettings settings{depth, !no_indirect, direct, !no_roulette, hemisphere_sampling};
        const Camera camera = make_camera(look_at, width, height);
        const SceneName shown = !model.mesh.empty() ? SceneName::room
                                : !spheres.empty()  ? SceneName::weekend
                                                    : show;
        const ThinLens lens = lens_options.lens(look_at, lens_of(shown));
        render([&](const PixelSample& sample) {
            Sampler sampler(sampler_kind, sample);
            const vec2 point = film_point(sample, sampler, filter.filter, filter.width);
            const Ray ray = sample_camera_ray(camera, lens, point, sampler);
            if (view == DebugView::radiance) return radiance(scene, lights, settings, ray, sampler);
            return debug_colour(scene, ray, view, distance(look_at.from, look_at.at));
        });
    });
}
