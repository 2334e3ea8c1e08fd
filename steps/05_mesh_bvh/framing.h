// The framing of a model that nobody has seen before: camera, floor and key light, from its box alone.
#pragma once

#include "01_spheres/camera.h"
#include "02_shadows/point_light.h"
#include "05_mesh_bvh/mesh.h"
#include "common/util/error.h"

#include <cmath>
#include <string>

namespace rt {

struct Framing {
    LookAt look_at;        ///< shows all of the model from the front, a little from the right and from above
    vec3 floor;            ///< a point of the floor, a hair's breadth under the model
    vec3 key_light;        ///< where a lamp stands, beside the camera and well above the model
    float intensity_scale; ///< metres^2: an intensity of this many W/sr sheds about 1 W/m^2 on the model
};

/// `aspect` is the picture's width over its height. A model without any extent counts as 1 m large.
inline Framing frame_model(const Aabb& box, float aspect) {
    const vec3 center = centroid(box);
    const float radius = length(box.max - box.min) > 0 ? length(box.max - box.min) / 2 : 1;
    const float fov = 34;
    const float half_angle = std::atan(std::tan(glm::radians(fov) / 2) * glm::min(aspect, 1.0f));
    const float camera_distance = 1.02f * radius / std::sin(half_angle); // the ball around the box just fits
    const vec3 key_light = center + radius * vec3(-1.6f, 3.2f, 2.4f);
    return {{center + camera_distance * normalize(vec3(0.45f, 0.32f, 1)), center, {0, 1, 0}, fov},
            {center.x, box.min.y - 0x1p-12f * radius, center.z}, // so that a floor of the model's own shows
            key_light,
            dot(key_light - center, key_light - center)};
}

/// The options with which a user shows a model of their own.
struct ModelOptions {
    explicit ModelOptions(Options& options)
        : mesh(options.file("mesh", "an OBJ file to show in place of this step's scene")),
          model_only(options.flag(
              "bare", "with --mesh: the model alone, without floor and lamp, nor sky if it glows")),
          crease(
              options.knob("crease", 40.0f, 0.0f, 180.0f,
                           "edges sharper than this stay sharp where the file gives no normals, degrees")) {}

    const std::string& mesh; ///< empty: this step's own scene
    const bool& model_only;
    const float& crease;
};

/// Puts the model into an empty scene, on a floor under a lamp and a cloudy sky, and answers the camera that
/// shows it. A bare model gets no floor and no lamp, and no sky either if it brings light of its own.
template <typename Scene>
LookAt add_framed_model(Scene& scene, const ModelOptions& options, float aspect) {
    const ObjFile file = read_obj(options.mesh);
    add_model(scene, file, options.crease);
    Framing framing = frame_model(bounds(scene.mesh), aspect);
    framing.look_at.origin = scene.mesh.origin;
    const auto glows = [](const ObjMaterial& material) { return material.emission != vec3(0); };
    if (!options.model_only || std::ranges::none_of(file.material_list, glows))
        scene.sky = {.nadir = {0.22f, 0.21f, 0.2f}, .zenith = {0.4f, 0.46f, 0.56f}};
    if (options.model_only) return framing.look_at;
    const int floor = add(scene.materials, Diffuse{vec3(0.55f, 0.53f, 0.5f)});
    scene.planes = {{framing.floor, {0, 1, 0}, floor}};
    scene.lights = {{framing.key_light, framing.intensity_scale * vec3(2.3f, 2.15f, 1.9f)}};
    return framing.look_at;
}

} // namespace rt
