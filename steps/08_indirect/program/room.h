// The room of the reference image: a variant of the Cornell box.
#pragma once

#include "01_spheres/camera.h"
#include "08_indirect/scene.h"
#include "common/model/obj_file.h"
#include "common/util/paths.h"

namespace rt {

inline const LookAt room_view{.from = {0, 1, 4.6f}, .at = {0, 0.98f, 0}, .fov = 31};

/// Builds a variant of the Cornell box, 2 m wide and open to the camera: red and green walls, a lamp in the
/// ceiling, a cow that looks at itself in a mirror sphere, and a glass sphere.
inline LookAt room(Scene& scene) {
    const int white = add(scene.materials, Diffuse{vec3(0.74f, 0.72f, 0.68f)});
    const int red = add(scene.materials, Diffuse{{0.63f, 0.065f, 0.05f}});
    const int green = add(scene.materials, Diffuse{{0.14f, 0.45f, 0.09f}});
    const int lamp = add(scene.materials, emissive(vec3(11.5f, 9.4f, 6.6f)));
    const int mirror = add(scene.materials, Mirror{vec3(0.93f)});
    const int glass = add(scene.materials, Dielectric{Medium{1.5f}});
    scene.quads = {{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, white}, // floor
                   {{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}, white}, // ceiling
                   {{-1, 0, -1}, {2, 0, 0}, {0, 2, 0}, white}, // back
                   {{-1, 0, 1}, {0, 0, -2}, {0, 2, 0}, red},   // left
                   {{1, 0, -1}, {0, 0, 2}, {0, 2, 0}, green},  // right
                   {{-0.5f, 1.998f, -0.45f}, {1, 0, 0}, {0, 0, 0.8f}, lamp}};
    scene.spheres = {{{0.52f, 0.4f, -0.42f}, 0.4f, mirror}, {{0.42f, 0.24f, 0.45f}, 0.24f, glass}};

    ObjModel cow = read_obj(asset_path("cow.obj"));
    transform(cow, 0.85f, -40, {-0.38f, 0, -0.05f});
    add_model(scene, cow, 40);
    return room_view;
}

} // namespace rt
