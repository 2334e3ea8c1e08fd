// A stage for a model that nobody has seen before: where to put the camera, the floor and a lamp, from its
// box alone.
#pragma once

#include "01_spheres/camera.h"
#include "02_shadows/point_light.h"
#include "05_mesh_bvh/mesh.h"
#include "common/util/error.h"

#include <cmath>
#include <string>

namespace rt {

struct Stage {
    LookAt look_at;   ///< shows all of the model from the front, a little from the right and from above
    vec3 floor;       ///< a point of the floor, a hair's breadth under the model
    vec3 lamp;        ///< where a lamp stands, beside the camera and well above the model
    float lamp_scale; ///< metres^2: an intensity of this many W/sr sheds about 1 W/m^2 on the model
};

/// `aspect` is the picture's width over its height. A model without any extent gets a stage of 1 m.
inline Stage stage_for(const Box& box, float aspect) {
    const vec3 center = middle(box);
    const float radius = length(box.high - box.low) > 0 ? length(box.high - box.low) / 2 : 1;
    const float fov = 34;
    const float half_angle = std::atan(std::tan(glm::radians(fov) / 2) * glm::min(aspect, 1.0f));
    const float away = 1.02f * radius / std::sin(half_angle); // the ball around the box just fits
    const vec3 lamp = center + radius * vec3(-1.6f, 3.2f, 2.4f);
    return {{center + away * normalize(vec3(0.45f, 0.32f, 1)), center, {0, 1, 0}, fov},
            {center.x, box.low.y - 0x1p-12f * radius, center.z}, // so that a floor of the model's own shows
            lamp,
            dot(lamp - center, lamp - center)};
}

/// The knobs with which a user shows a model of their own.
struct ModelKnobs {
    explicit ModelKnobs(Options& options)
        : mesh(options.file("mesh", "an OBJ file to show in place of this step's scene")),
          bare(options.flag("bare",
                            "with --mesh: the model alone, without floor and lamp, nor sky if it glows")),
          crease(
              options.knob("crease", 40.0f, 0.0f, 180.0f,
                           "edges sharper than this stay sharp where the file gives no normals, degrees")) {}

    const std::string& mesh; ///< empty: this step's own scene
    const bool& bare;
    const float& crease;
};

/// Puts the model into an empty scene, on a floor under a lamp and a cloudy sky, and answers the camera that
/// shows it. A bare model gets no floor and no lamp, and no sky either if it brings light of its own.
template <typename Scene>
LookAt stage_model(Scene& scene, const ModelKnobs& knobs, float aspect) {
    const ObjFile file = read_obj(knobs.mesh);
    add_model(scene, file, knobs.crease);
    Stage stage = stage_for(bounds(scene.mesh), aspect);
    stage.look_at.origin = scene.mesh.origin;
    const auto glows = [](const ObjMaterial& material) { return material.emission != vec3(0); };
    if (!knobs.bare || std::ranges::none_of(file.material_list, glows))
        scene.sky = {.nadir = {0.22f, 0.21f, 0.2f}, .zenith = {0.4f, 0.46f, 0.56f}};
    if (knobs.bare) return stage.look_at;
    const int floor = add(scene.materials, Diffuse{vec3(0.55f, 0.53f, 0.5f)});
    scene.planes = {{stage.floor, {0, 1, 0}, floor}};
    scene.lights = {{stage.lamp, stage.lamp_scale * vec3(2.3f, 2.15f, 1.9f)}};
    return stage.look_at;
}

} // namespace rt
