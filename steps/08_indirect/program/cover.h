// A picture for a cover: a cat and other things on a table in the evening, through a lens.
#pragma once

#include "01_spheres/camera.h"
#include "07_antialias/thin_lens.h"
#include "08_indirect/program/cornell.h"
#include "08_indirect/scene.h"
#include "common/image/image.h"
#include "common/math/random.h"
#include "common/util/paths.h"

#include <cmath>

namespace rt {

/// The plane in focus goes through the point that the camera looks at.
inline constexpr ThinLens cover_lens{.aperture_diameter = 0.09f, .focus_distance = 0};

/// Returns boards of wood, which repeat in both directions: dark joints, and a grain of waves that bend.
inline Bitmap boards(int size) {
    Bitmap bitmap{size, size, {}};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const vec2 p = 2 * pi * vec2(x, y) / float(size); // an integer multiple of p repeats
            const float board = std::floor(float(8 * y) / float(size));
            const float bend =
                std::sin(p.x + 5 * board) + 0.5f * std::sin(2 * p.x + 7 * board + std::sin(3 * p.y));
            const float grain =
                std::sin(23 * p.y + 3 * bend) + 0.6f * std::sin(71 * p.y + 5 * bend + std::sin(9 * p.x));
            const bool joint = 8 * y % size < size / 24;
            const float tone = joint ? 0.25f : 0.8f + 0.1f * grain + 0.16f * std::sin(5 * board);
            for (const float channel : {0.43f, 0.23f, 0.115f})
                bitmap.values.push_back(std::uint16_t(65535 * srgb_from_linear(tone * channel)));
        }
    return bitmap;
}

/// Adds what gives light: a large warm lamp, a small one behind, and three chains of lamps far away.
inline void add_cover_lamps(Scene& scene) {
    const int key = add(scene.materials, emissive(vec3(21, 14.5f, 9)));
    const int rim = add(scene.materials, emissive(vec3(26, 13, 5)));
    const int fairy[] = {add(scene.materials, emissive(vec3(6, 3.3f, 1.3f))),
                         add(scene.materials, emissive(vec3(6, 4.1f, 2.2f))),
                         add(scene.materials, emissive(vec3(5.5f, 2.2f, 0.9f)))};
    scene.quads.push_back({{-2.5f, 2.3f, 1.6f}, {1.1f, 0.55f, 0}, {0, 0, -1.5f}, key});
    scene.spheres.push_back({{2.3f, 1.5f, -1.3f}, 0.17f, rim});
    Random random(3);
    for (const vec3 chain : // its height on the left and on the right, and how far it sags
         {vec3(1.9f, 2.5f, 0.9f), vec3(1.1f, 1.6f, 0.8f), vec3(2.5f, 0.7f, 0.5f)})
        for (int i = 0; i <= 14; ++i) {
            const float t = (float(i) + 0.5f * random.get_1d()) / 14;
            const float height = glm::mix(chain.x, chain.y, t) - 4 * chain.z * t * (1 - t);
            const vec3 place(-3.7f + 7.4f * t, height, -6.4f);
            scene.spheres.push_back({place, 0.045f + 0.02f * random.get_1d(), fairy[i % 3]});
        }
}

inline LookAt cover(Scene& scene) {
    scene.sky = {.nadir = {0.1f, 0.06f, 0.05f}, .zenith = {0.05f, 0.09f, 0.2f}};
    const int wood =
        add(scene.materials,
            ImageTexture{.texture = add(scene.textures, make_texture(boards(1024))), .uv_scale = {4, 4}});
    const int table = add(scene.materials, Coated{0.06f, wood});
    const int wall = add(scene.materials, Diffuse{{0.12f, 0.28f, 0.36f}});
    const int paper = add(scene.materials, Diffuse{{0.75f, 0.7f, 0.6f}});
    const int red = add(scene.materials, Coated{0.05f, add(scene.materials, Diffuse{{0.6f, 0.06f, 0.05f}})});
    const int navy = add(scene.materials, Coated{0.05f, add(scene.materials, Diffuse{{0.05f, 0.1f, 0.28f}})});
    const int brass = add(scene.materials, Metal{{0.93f, 0.71f, 0.36f}, 0.07f});
    const int globe =
        add(scene.materials,
            ImageTexture{add(scene.textures, make_texture(read_bitmap(asset_path("globe.png"))))});
    scene.quads = {{{-4, 0, 2.5f}, {8, 0, 0}, {0, 0, -4.5f}, table},
                   {{-12, -3, -7}, {24, 0, 0}, {0, 9, 0}, wall}};
    scene.spheres = {{{0.45f, 0.21f, 0.42f}, 0.21f, add(scene.materials, Dielectric{{1.5f}})},
                     {{1.36f, 0.31f, -0.8f}, 0.31f, add(scene.materials, Coated{0.04f, globe})},
                     {{-0.78f, 0.14f, 0.5f}, 0.14f, add(scene.materials, Mirror{vec3(0.92f)})},
                     {{-1.2f, 0.1f, 0.42f}, 0.1f, red},
                     {{1.12f, 0.12f, 0.5f}, 0.12f, add(scene.materials, Metal{{0.9f, 0.5f, 0.36f}, 0.25f})}};
    add_box(scene, {0.68f, 0.09f, 0.46f}, 14, {0.42f, 0, -0.55f}, navy);
    add_box(scene, {0.6f, 0.1f, 0.42f}, 5, {0.48f, 0.09f, -0.55f}, paper);
    add_box(scene, {0.56f, 0.08f, 0.4f}, 22, {0.46f, 0.19f, -0.5f}, red);
    add_cover_lamps(scene);
    const auto model = [](const char* file, float scale, float turn, vec3 place) {
        ObjModel asset = read_obj(asset_path(file));
        transform(asset, scale, turn, place);
        return asset;
    };
    add_model(scene, model("cat.obj", 0.95f, -62, {-0.22f, 0, -0.05f}), 40);
    add_model(scene, model("cow.obj", 0.4f, -150, {0.8f, 0.27f, -0.4f}), 40);
    append_model(scene.mesh, model("teapot.obj", 0.36f, -25, {-1.02f, 0, -0.45f}), {brass}, 40);
    return {.from = {0, 1.0f, 4.3f}, .at = {0, 0.56f, 0.05f}, .fov = 22};
}

} // namespace rt
