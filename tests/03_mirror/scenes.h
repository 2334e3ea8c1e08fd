// Scenes for the checks of step 03: a tile, and a hall of two facing mirrors.
#pragma once

#include "03_mirror/scene.h"
#include "tests/03_mirror/step.h"

namespace rt {

/// Builds a square of this material around `middle` that faces along `normal`, 2 * half wide.
inline Quad tile(vec3 middle, vec3 normal, float half, int material) {
    const vec3 u = beside(normal), v = cross(normal, u);
    return {middle - half * u - half * v, 2 * half * u, 2 * half * v, material};
}

inline const vec3 c(0.6f, 2, 0.9f); // the radiance of a uniform sky

/// Builds a scene of one oblique tile of material 0 under a uniform sky, to be hit by `to_tile`.
inline Scene one_tile() {
    Scene scene{.sky = {c, c}};
    scene.quads = {tile(somewhere, tilted, 1, 0)};
    return scene;
}
inline const Ray to_tile{somewhere - 1.5f * slanting, slanting};

/// Two facing mirrors of tint s, oblique to all axes, and a ray that hits them `bounces` times before it
/// leaves between them into the sky.
struct Hall {
    Scene scene{.sky = {c, c}};
    Ray ray;

    Hall(int bounces, vec3 s) {
        const vec3 up = beside(tilted), along = cross(tilted, up);
        const float height = 0.1f * float(2 * bounces); // the ray rises .2 between the mirrors
        for (const float side : {-1.0f, 1.0f})
            scene.quads.push_back({somewhere + side * tilted - 3.0f * along - up, 6.0f * along,
                                   (height + 1) * up, add(scene.materials, Mirror{s})});
        ray = {somewhere, 1.7f * (tilted + 0.1f * up + 0.05f * along)};
    }
};

} // namespace rt
