// A cat at home: a textured mesh in a closed room with a window and a lamp, among spheres of other materials.
#pragma once

#include "01_spheres/camera.h"
#include "08_indirect/scene.h"
#include "common/util/paths.h"

namespace rt {

inline LookAt cat_room(Scene& scene) {
    const int wall = add(scene.materials, Diffuse{{0.72f, 0.66f, 0.56f}});
    const int blue = add(scene.materials, Diffuse{{0.16f, 0.3f, 0.42f}});
    const int ceiling = add(scene.materials, Diffuse{vec3(0.78f)});
    const int floor = add(scene.materials, Checkerboard{{0.5f, 0.32f, 0.18f}, {0.36f, 0.21f, 0.11f}, 0.12f});
    const int window = add(scene.materials, emissive(vec3(7, 8.5f, 11)));
    const int lamp = add(scene.materials, emissive(vec3(34, 21, 10)));
    scene.quads = {{{-2, 0, 3}, {4, 0, 0}, {0, 0, -5}, floor},
                   {{-2, 2.6f, -2}, {4, 0, 0}, {0, 0, 5}, ceiling},
                   {{-2, 0, -2}, {4, 0, 0}, {0, 2.6f, 0}, blue}, // behind the cat
                   {{2, 0, 3}, {-4, 0, 0}, {0, 2.6f, 0}, wall},  // behind the camera
                   {{-2, 0, 3}, {0, 0, -5}, {0, 0.8f, 0}, wall}, // below, above and beside the window
                   {{-2, 2.2f, 3}, {0, 0, -5}, {0, 0.4f, 0}, wall},
                   {{-2, 0.8f, 3}, {0, 0, -1.8f}, {0, 1.4f, 0}, wall},
                   {{-2, 0.8f, -0.4f}, {0, 0, -1.6f}, {0, 1.4f, 0}, wall},
                   {{2, 0, -2}, {0, 0, 5}, {0, 2.6f, 0}, wall},
                   {{-2, 0.8f, 1.2f}, {0, 0, -1.6f}, {0, 1.4f, 0}, window}};
    scene.spheres = {{{1.0f, 0.3f, -0.8f}, 0.3f, add(scene.materials, Metal{{0.95f, 0.72f, 0.4f}, 0.12f})},
                     {{-0.72f, 0.22f, 0.25f}, 0.22f, add(scene.materials, Dielectric{{1.5f}})},
                     {{-0.85f, 0.34f, -1.2f}, 0.34f, add(scene.materials, Mirror{vec3(0.92f)})},
                     {{0.62f, 0.13f, 0.4f}, 0.13f, add(scene.materials, Diffuse{{0.7f, 0.1f, 0.08f}})},
                     {{1.2f, 1.75f, -1.3f}, 0.14f, lamp}};

    ObjModel cat = read_obj(asset_path("cat.obj"));
    transform(cat, 1.1f, -55, {0.1f, 0, -0.4f});
    add_model(scene, cat, 40);
    return {.from = {-0.25f, 0.95f, 2.85f}, .at = {0.05f, 0.62f, -0.4f}, .fov = 40};
}

} // namespace rt
