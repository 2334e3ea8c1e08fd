// The scene of step 07: a cat at dusk, between lamps that are too near or too far to be in focus.
#pragma once

#include "01_spheres/camera.h"
#include "06_textures/scene.h"
#include "07_antialias/thin_lens.h"
#include "common/image/image.h"
#include "common/math/random.h"
#include "common/util/paths.h"

namespace rt {

inline const LookAt dusk_view{.from = {0, 0.74f, 4.4f}, .at = {0, 0.67f, 0}, .fov = 25};

/// The plane in focus goes through the point that the camera looks at, where the cat and the poster are.
inline constexpr ThinLens dusk_lens{.aperture_diameter = 0.17f, .focus_distance = 0};

/// Returns a zone plate, rings sin(r^2): their frequency grows linearly from the centre to the border, where
/// a ring is nine texels wide.
inline Bitmap zone_plate(int size) {
    Bitmap bitmap{size, size, {}};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const vec2 p = vec2(float(2 * x + 1 - size), float(2 * y + 1 - size)) / 2.0f;
            const float wave = 0.5f + 0.45f * std::cos(0.7f * dot(p, p) / float(size));
            bitmap.values.insert(bitmap.values.end(), 3, std::uint16_t(65535 * srgb_from_linear(wave)));
        }
    return bitmap;
}

/// A chain of lamps from one point to another.
struct FairyLights {
    vec3 from, to;
    int lamps;
    float radius;     ///< of each lamp
    float brightness; ///< 1 is the radiance of `lamp_color`
};

inline vec3 lamp_color(int i) {
    const vec3 colors[] = {
        {4.4f, 2.2f, 0.75f}, {4.4f, 2.9f, 1.3f}, {4.1f, 1.4f, 0.5f}, {4.4f, 2.5f, 0.95f}, {1.2f, 2.4f, 3.3f}};
    return colors[i % 5];
}

/// Hangs a chain up: straight pieces of wire, thinner than a pixel, that sag like a parabola, and a lamp at
/// each joint.
inline void add_fairy_lights(Scene& scene, const FairyLights& chain, int wire) {
    const auto joint = [&](int i) {
        const float t = float(i) / float(chain.lamps + 1);
        return mix(chain.from, chain.to, t) -
               vec3(0, 0.28f * distance(chain.from, chain.to) * t * (1 - t), 0);
    };
    for (int i = 0; i <= chain.lamps; ++i) {
        scene.quads.push_back({joint(i), joint(i + 1) - joint(i), {0, 0.0035f, 0}, wire});
        if (i == 0) continue;
        const int lamp = add(scene.materials, emissive(chain.brightness * lamp_color(i)));
        scene.spheres.push_back({joint(i), chain.radius, lamp});
    }
}

/// Adds the lamps of a town, the farther the larger, so that each of them blurs to a disc.
inline void add_town(Scene& scene) {
    Random random(7);
    for (int i = 0; i < 44; ++i) {
        const vec2 place = random.get_2d();
        const float ahead = 7 + 20 * random.get_1d();
        const vec3 center(mix(vec2(-0.02f, 0.03f), vec2(0.44f, 0.26f), vec2(place.x, place.y * place.y)) *
                              (ahead + 4.4f),
                          -ahead);
        const int lamp = add(scene.materials, emissive((0.5f + 0.5f * random.get_1d()) * lamp_color(i)));
        scene.spheres.push_back({center, 0.0095f * ahead, lamp});
    }
}

/// Builds the scene: everything that shows aliasing (rings that become finer and finer, slanted edges, wires
/// thinner than a pixel, a floor to the horizon), with a lens.
inline LookAt dusk(Scene& scene) {
    scene.sky = {.nadir = {0.5f, 0.19f, 0.12f}, .zenith = {0, 0.03f, 0.16f}};
    scene.lights = {{{-0.9f, 2.1f, 1.6f}, vec3(11, 6.6f, 3.3f)},
                    {{2.2f, 1.2f, 0.9f}, vec3(3.6f, 2.2f, 1.2f)}};
    const int tiles = add(scene.materials, Checkerboard{{0.36f, 0.33f, 0.31f}, {0.1f, 0.1f, 0.12f}, 0.25f});
    const int wet = add(scene.materials, Coated{0.25f, tiles});
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, wet}};

    const int rings = add(scene.materials, ImageTexture{add(scene.textures, make_texture(zone_plate(1024)))});
    const int plaster = add(scene.materials, Diffuse{{0.46f, 0.4f, 0.36f}});
    const int black = add(scene.materials, Diffuse{vec3(0.03f)});
    const int wire = add(scene.materials, emissive(vec3(2.6f, 1.6f, 0.7f)));
    scene.quads = {{{-4, 0, -0.02f}, {3.75f, 0, 0}, {0, 3, 0}, plaster},
                   {{-0.25f, 0, -0.02f}, {0, 0, -0.35f}, {0, 3, 0}, plaster},
                   {{-1.44f, 0.33f, -0.01f}, {0.95f, 0.06f, 0}, {-0.06f, 0.95f, 0}, black},
                   {{-1.395f, 0.38f, 0}, {0.86f, 0.054f, 0}, {-0.054f, 0.86f, 0}, rings}};
    for (const FairyLights& chain : {FairyLights{{-2, 1.5f, 0.03f}, {-0.25f, 1.4f, 0.03f}, 9, 0.014f, 0.5f},
                                     FairyLights{{-0.25f, 1.4f, 0.03f}, {4, 2.9f, -7}, 12, 0.055f, 1},
                                     FairyLights{{-0.8f, 1.19f, 2.5f}, {0.7f, 1.21f, 2.2f}, 6, 0.024f, 1}})
        add_fairy_lights(scene, chain, wire);
    add_town(scene);

    ObjModel cat = read_obj(asset_path("cat.obj"));
    transform(cat, 0.95f, -70, {0.12f, 0, 0.03f});
    add_model(scene, cat, 40);
    return dusk_view;
}

} // namespace rt
