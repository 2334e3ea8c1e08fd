// The options of step 05 and later: the acceleration structure, and a model of the user's own.
#pragma once

#include "02_shadows/point_light.h"
#include "05_mesh_bvh/program/framing.h"
#include "05_mesh_bvh/shapes.h"
#include "common/cli/options.h"

#include <algorithm>
#include <string>

#if __has_include(                                                                                           \
    "05_mesh_bvh/program/own_scene.h") // a scene of the user's own, by ./learn run 08 --scene NAME
#include "05_mesh_bvh/program/own_scene.h"
#endif

namespace rt {

/// Declares --accel.
inline Choice<Accel> accel_option(Options& options, Accel initial) {
    return options.choice(
        "accel", {"brute", "bvh", "wide"}, initial,
        "how rays find hits: by testing every shape, by a binary tree, or by a tree that tests "
        "many boxes together");
}

/// Declares --mesh --bare --crease: a model of the user's own.
struct ModelOptions {
    explicit ModelOptions(Options& options)
        : mesh(options.file("mesh", "an OBJ file to show instead of this step's scene")),
          model_only(options.flag(
              "bare",
              "with --mesh: the model alone, without floor and light; without sky too if it is emissive")),
          crease(
              options.option("crease", 40.0f, 0.0f, 180.0f,
                             "edges sharper than this stay sharp where the file gives no normals, degrees")) {
    }

    const std::string& mesh; ///< empty: show this step's own scene
    const bool& model_only;
    const float& crease;
};

/// Adds the model to an empty scene, on a floor, with a light and a cloudy sky, and returns the camera that
/// shows it. With --bare there is no floor and no light, and no sky either if the model is emissive.
template <typename Scene>
LookAt add_framed_model(Scene& scene, const ModelOptions& options, float aspect) {
    const ObjModel file = read_obj(options.mesh);
    add_model(scene, file, options.crease);
    Framing framing = frame_model(bounds(scene.mesh), aspect);
    framing.look_at.origin = scene.mesh.origin;
    const auto glows = [](const ObjMaterial& material) { return material.emission != vec3(0); };
    if (!options.model_only || std::ranges::none_of(file.materials, glows))
        scene.sky = {.nadir = {0.22f, 0.21f, 0.2f}, .zenith = {0.4f, 0.46f, 0.56f}};
    if (options.model_only) return framing.look_at;
    const int floor = add(scene.materials, Diffuse{vec3(0.55f, 0.53f, 0.5f)});
    scene.planes = {{framing.floor, {0, 1, 0}, floor}};
    scene.lights = {{framing.key_light, framing.intensity_scale * vec3(2.3f, 2.15f, 1.9f)}};
    return framing.look_at;
}

/// Builds the user's own scene, if there is one, or else the step's by `build`, and returns the camera that shows it.
template <typename Scene, typename Build>
LookAt own_scene_or(Scene& scene, const Build& build) {
    if constexpr (requires { make_scene(scene); })
        return make_scene(scene);
    else
        return build(scene);
}

} // namespace rt
