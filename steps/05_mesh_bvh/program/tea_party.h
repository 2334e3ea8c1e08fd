// A tea party: two teapots and a cat on a checkered floor, watched by four hundred cats. A million triangles.
#pragma once

#include "01_spheres/camera.h"
#include "05_mesh_bvh/scene.h"
#include "common/util/paths.h"

#include <array>
#include <cmath>

namespace rt {

const LookAt tea_party_view{.from = {0.35f, 2.1f, 4.6f}, .at = {0.14f, 0.52f, 0}, .fov = 30};

/// Adds cats of 2,440 triangles each that look at the teapots, spread evenly over what the camera sees behind
/// them.
inline void add_audience(Scene& scene) {
    const std::array<vec3, 6> furs{vec3(0.8f, 0.76f, 0.7f),  vec3(0.75f, 0.38f, 0.12f),
                                   vec3(0.2f, 0.18f, 0.17f), vec3(0.42f, 0.42f, 0.44f),
                                   vec3(0.8f, 0.58f, 0.3f),  vec3(0.35f, 0.19f, 0.1f)};
    const ObjModel model = read_obj(asset_path("cat_coarse.obj"));
    const int count = 400;
    for (int i = 0; i < count; ++i) {
        const float share = float(i) / count, golden = glm::fract(0.618034f * float(i));
        const float depth = std::sqrt(glm::mix(35.0f, 484.0f, share)); // area grows with its square
        const vec3 place = tea_party_view.from + depth * vec3(golden - 0.5f, 0, -1);
        const float turn = glm::degrees(std::atan2(place.z - 0.5f, -place.x)); // toward the teapots
        ObjModel cat = model;
        cat.materials = {{.name = "fur", .diffuse = furs[std::size_t(i) % furs.size()]}};
        transform(cat, 0.5f + 0.15f * glm::fract(0.57f * float(i)),
                  turn + 60 * glm::fract(0.755f * float(i)) - 30, {place.x, 0, place.z});
        add_model(scene, cat, 40);
    }
}

/// Builds a glazed teapot of 57,360 triangles, one of 552 that shows its facets, a cat, and their audience.
inline LookAt tea_party(Scene& scene) {
    scene.sky = {.nadir = {0.14f, 0.11f, 0.1f}, .zenith = {0.2f, 0.27f, 0.45f}};
    scene.lights = {{{-9, 9, 5}, vec3(520, 430, 300)}};
    const int floor = add(scene.materials, Checkerboard{{0.7f, 0.56f, 0.4f}, {0.5f, 0.36f, 0.24f}, 0.6f});
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}};

    ObjModel fine = read_obj(asset_path("teapot_fine.obj"));
    fine.materials = {{.name = "glaze", .diffuse = {0.05f, 0.16f, 0.4f}, .reflectivity = 0.12f}};
    transform(fine, 0.62f, 25, {-0.5f, 0, -0.25f});
    add_model(scene, fine, 40);

    ObjModel coarse = read_obj(asset_path("teapot_coarse.obj"));
    coarse.materials = {{.name = "paper", .diffuse = {0.85f, 0.42f, 0.14f}}};
    for (auto& triangle : coarse.triangles)
        for (ObjIndex& corner : triangle) corner.normal = -1; // without its own normals
    transform(coarse, 0.34f, 150, {0.3f, 0, 0.95f});
    add_model(scene, coarse, 0); // crease 0: no smoothing

    ObjModel cat = read_obj(asset_path("cat.obj"));
    cat.materials = {{.name = "chalk", .diffuse = {0.8f, 0.76f, 0.7f}}};
    transform(cat, 0.85f, -50, {1.15f, 0, 0.05f});
    add_model(scene, cat, 40);
    add_audience(scene);
    return tea_party_view;
}

} // namespace rt
