// Facts about the radiance along a ray: that of the sky, or of a matte surface lit by it.
#include "tests/check.h"

#include "01_spheres/radiance.h"
#include "01_spheres/scene.h"

#include <vector>

#include "tests/01_spheres/ball.h"

using namespace rt;

TEST_CASE("a ray that hits nothing sees the sky") {
    const Scene scene{.sky = {{0.1f, 0.2f, 0.9f}, {0.7f, 0.4f, 0.1f}}};
    const vec3 direction = 3.0f * vec3(2, 3, -6) / 7.0f;
    CHECK(radiance(scene, Ray{{1, 2, 3}, direction}) == approx(radiance(scene.sky, direction)));
}

TEST_CASE("a white matte ball is invisible under a uniform sky") {
    Scene scene{.sky = {vec3(0.5f, 2, 0.25f), vec3(0.5f, 2, 0.25f)}};
    scene.spheres = {{{1, -2, 3}, 2, add(scene.materials, Diffuse{vec3(1)})}};
    CHECK_MESSAGE(radiance(scene, to_ball) == approx(vec3(0.5f, 2, 0.25f)),
                  "a white surface reflects all the light that arrives and no more");
    CHECK(radiance(scene, from_within) == approx(vec3(0.5f, 2, 0.25f)));
}

TEST_CASE("a matte ball shows albedo / pi of the sky's irradiance on the visible side") {
    Scene scene{.sky = {{0.1f, 0.2f, 0.9f}, {0.7f, 0.4f, 0.1f}}};
    const vec3 albedo(0.8f, 0.4f, 0.5f);
    scene.spheres = {{{1, -2, 3}, 2, add(scene.materials, Diffuse{albedo})}};
    const vec3 seen = radiance(scene, to_ball);
    CHECK(seen == approx(albedo * mix(scene.sky.nadir, scene.sky.zenith, 0.5f + outward.y / 3)));
    const vec3 within = radiance(scene, from_within);
    CHECK_MESSAGE(within == approx(albedo * mix(scene.sky.nadir, scene.sky.zenith, 0.5f - outward.y / 3)),
                  "seen from inside, the normal is flipped");
}

TEST_CASE("a checkerboard floor shows the colour of the square that the ray hits") {
    Scene scene{.sky = {vec3(1), vec3(1)}};
    scene.planes = {{{0, -1, 0},
                     {0, 1, 0},
                     add(scene.materials, Checkerboard{{0.8f, 0.2f, 0.1f}, {0.1f, 0.4f, 0.3f}, 0.5f})}};
    const auto seen = [&](float x, float z) { return radiance(scene, Ray{{x, 3, z}, {0, -2, 0}}); };
    CHECK(seen(0.2f, -0.3f) == approx(vec3(0.8f, 0.2f, 0.1f)));
    CHECK(seen(0.7f, -0.3f) == approx(vec3(0.1f, 0.4f, 0.3f)));
    CHECK(seen(-0.2f, -0.3f) == approx(vec3(0.1f, 0.4f, 0.3f)));
    CHECK(seen(-0.2f, 0.3f) == approx(vec3(0.8f, 0.2f, 0.1f)));
}

TEST_CASE("a ball hides what is behind it and shows its own material") {
    Scene scene;
    scene.spheres = {{{0, 0, -9}, 3, add(scene.materials, emissive({1, 0, 0}))},
                     {{0, 0, -3}, 1, add(scene.materials, emissive({0, 1, 0}))}};
    CHECK(radiance(scene, Ray{{0, 0, 0}, {0, 0, -2}}) == approx(vec3(0, 1, 0)));
    CHECK(radiance(scene, Ray{{0, 0, 0}, {0, 1.2f, -4.8f}}) == approx(vec3(0, 1, 0)));
    CHECK(radiance(scene, Ray{{0, 0, -5}, {0, 0, -2}}) == approx(vec3(1, 0, 0)));
}

namespace {
/// A scene of a different type: two walls and no list of shapes.
struct Corridor {
    Sky sky{vec3(1), vec3(1)};
    std::vector<Material> materials{Diffuse{vec3(0.25f)}};
};
std::optional<Hit> intersect(const Corridor&, Ray ray) {
    ray.t_max = (ray.direction.x > 0 ? 1 - ray.origin.x : -1 - ray.origin.x) / ray.direction.x;
    return make_hit(ray, {ray.direction.x > 0 ? -1.0f : 1.0f, 0, 0}, {0, 0}, 0);
}
} // namespace

TEST_CASE("light travels in any scene type that can find the closest hit of a ray") {
    CHECK(radiance(Corridor{}, Ray{{0, 0, 0}, {2, 1, 0}}) == approx(vec3(0.25f)));
}
