// The final scene of "Ray Tracing in One Weekend": hundreds of spheres on a large one.
// Shirley, Black and Hollasch, 2020. The spheres follow the book's rule, with our own random numbers, or come
// from a list. Glass reflects by Fresnel, not by Schlick.
#pragma once

#include "01_spheres/camera.h"
#include "07_antialias/thin_lens.h"
#include "08_indirect/scene.h"
#include "common/math/random.h"
#include "common/model/sphere_list.h"

namespace rt {

/// The book's lens: its diameter subtends 0.6 degrees from the plane in focus, 2 * 10 tan(0.3 degrees).
inline constexpr ThinLens weekend_lens{.aperture_diameter = 0.104720f, .focus_distance = 10};

/// Sets the sky of the scene and returns its camera.
inline LookAt weekend_camera(Scene& scene) {
    scene.sky = {.nadir = vec3(1), .zenith = {0.5f, 0.7f, 1}};
    return {.from = {13, 2, 3}, .at = {0, 0, 0}, .fov = 20};
}

/// Returns the material of a small sphere: matte with a probability of 80 %, metal 15 %, glass 5 %.
inline Material weekend_material(Random& random) {
    const auto three = [&] {
        const float x = random.get_1d(), y = random.get_1d(), z = random.get_1d();
        return vec3(x, y, z);
    };
    const float kind = random.get_1d();
    if (kind < 0.8f) {
        const vec3 albedo = three();
        return Diffuse{albedo * three()};
    }
    if (kind >= 0.95f) return Dielectric{{1.5f}};
    const vec3 reflectance = 0.5f + 0.5f * three();
    return Metal{reflectance, 0.5f * random.get_1d()};
}

/// Builds the book's scene, identical on every run.
inline LookAt weekend(Scene& scene) {
    const auto ball = [&](vec3 center, float radius, const Material& material) {
        scene.spheres.push_back({center, radius, add(scene.materials, material)});
    };
    ball({0, -1000, 0}, 1000, Diffuse{vec3(0.5f)});
    Random random(22);
    for (int a = -11; a < 11; ++a)
        for (int b = -11; b < 11; ++b) {
            const float x = float(a) + 0.9f * random.get_1d();
            const float z = float(b) + 0.9f * random.get_1d();
            const Material material = weekend_material(random);
            if (distance(vec3(x, 0.2f, z), vec3(4, 0.2f, 0)) > 0.9f) ball({x, 0.2f, z}, 0.2f, material);
        }
    ball({0, 1, 0}, 1, Dielectric{{1.5f}});
    ball({-4, 1, 0}, 1, Diffuse{{0.4f, 0.2f, 0.1f}});
    ball({4, 1, 0}, 1, Metal{{0.7f, 0.6f, 0.5f}});
    return weekend_camera(scene);
}

/// Builds the scene from a list of spheres.
inline LookAt weekend(Scene& scene, const std::vector<SphereRecord>& list) {
    for (const SphereRecord& ball : list) {
        const Material material = ball.kind == SphereRecord::Kind::metal
                                      ? Material(Metal{ball.albedo, ball.fuzz})
                                  : ball.kind == SphereRecord::Kind::glass ? Material(Dielectric{{ball.ior}})
                                                                           : Material(Diffuse{ball.albedo});
        scene.spheres.push_back({ball.center, ball.radius, add(scene.materials, material)});
    }
    return weekend_camera(scene);
}

} // namespace rt
