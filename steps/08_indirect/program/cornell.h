// The Cornell box of "Ray Tracing: The Next Week", for comparison with other programs.
// Shirley, Black and Hollasch, 2020. Lengths as in the book: the box is 555 wide.
#pragma once

#include "01_spheres/camera.h"
#include "08_indirect/scene.h"

#include <cmath>

namespace rt {

/// Adds six quads that face outward: a box of this size with one corner at the origin, turned about the y
/// axis (degrees, from +z towards +x), then shifted.
inline void add_box(Scene& scene, vec3 size, float turn, vec3 shift, int material) {
    const float c = std::cos(glm::radians(turn)), s = std::sin(glm::radians(turn));
    const vec3 x = size.x * vec3(c, 0, -s), y(0, size.y, 0), z = size.z * vec3(s, 0, c);
    for (const Quad& face :
         {Quad{shift, y, x, material}, Quad{shift + z, x, y, material}, Quad{shift, z, y, material},
          Quad{shift + x, y, z, material}, Quad{shift, x, z, material}, Quad{shift + y, z, x, material}})
        scene.quads.push_back(face);
}

inline LookAt cornell(Scene& scene) {
    const int white = add(scene.materials, Diffuse{vec3(0.73f)});
    const int red = add(scene.materials, Diffuse{{0.65f, 0.05f, 0.05f}});
    const int green = add(scene.materials, Diffuse{{0.12f, 0.45f, 0.15f}});
    const int lamp = add(scene.materials, emissive(vec3(15)));
    const float side = 555;
    scene.quads = {{{0, 0, 0}, {side, 0, 0}, {0, 0, side}, white},    // floor
                   {{0, side, 0}, {0, 0, side}, {side, 0, 0}, white}, // ceiling
                   {{0, 0, side}, {side, 0, 0}, {0, side, 0}, white}, // back
                   {{0, 0, 0}, {0, 0, side}, {0, side, 0}, red},      // seen on the right
                   {{side, 0, 0}, {0, side, 0}, {0, 0, side}, green}, // seen on the left
                   {{343, 554, 332}, {-130, 0, 0}, {0, 0, -105}, lamp}};
    add_box(scene, {165, 330, 165}, 15, {265, 0, 295}, white);
    add_box(scene, {165, 165, 165}, -18, {130, 0, 65}, white);
    return {.from = {278, 278, -800}, .at = {278, 278, 0}, .fov = 40};
}

} // namespace rt
