// Facts about light paths over several mirrors: oblique paths, matte objects in mirrors, shadows of mirrors.
#include "03_mirror/radiance.h"
#include "tests/03_mirror/scenes.h"

#include <vector>

using namespace rt;

namespace {

/// Builds mirror tiles at the inner points, each with its own tint, that guide a ray from the first point to
/// a glowing ball at the last. Each tile's normal bisects the incoming and outgoing directions.
Scene path_of(const std::vector<vec3>& points, const std::vector<vec3>& tints, vec3 glow) {
    Scene scene;
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const vec3 normal =
            normalize(normalize(points[i - 1] - points[i]) + normalize(points[i + 1] - points[i]));
        scene.quads.push_back(tile(points[i], normal, 0.2f, add(scene.materials, Mirror{tints[i - 1]})));
    }
    scene.spheres = {{points.back(), 0.15f, add(scene.materials, emissive(glow))}};
    return scene;
}

} // namespace

TEST_CASE("a path of three segments shows the ball at the end of its third segment") {
    const std::vector<vec3> points{{0, 0, 0}, {1, 0.5f, -4}, {-2.5f, 1.5f, -1.5f}, {-1, -2, -3.5f}};
    const Scene scene = path_of(points, {{0.9f, 0.5f, 0.8f}, {0.5f, 1, 0.7f}}, {2, 3, 4});
    const Ray eye{points[0], 0.8f * (points[1] - points[0])};
    const vec3 seen = radiance(scene, eye, 12);
    CHECK_MESSAGE(seen == approx(vec3(0.9f, 1.5f, 2.24f)),
                  hint(seen, {{vec3(0), "black: the recursion is too shallow, or a reflection went astray"},
                              {{2, 3, 4}, "the tints are missing"},
                              {{1, 3, 2.8f}, "the first mirror's tint is missing"},
                              {{1.8f, 1.5f, 3.2f}, "the second mirror's tint is missing"}}));
    CHECK_MESSAGE(radiance(scene, eye, 2) == approx(vec3(0.9f, 1.5f, 2.24f)), "two mirrors are on the path");
    CHECK_MESSAGE(radiance(scene, eye, 1) == vec3(0), "one mirror is not enough");
}

TEST_CASE("a path continues over five oblique mirrors") {
    const std::vector<vec3> points{{0, 0, 0},        {1, 0.5f, -4},    {-2.5f, 1.5f, -1.5f}, {-1, -2, -3.5f},
                                   {2.5f, -1.5f, 1}, {-1.5f, 3, 2.5f}, {3, 2.5f, 1}};
    const Scene scene = path_of(points, std::vector(5, vec3(0.5f, 0.9f, 1)), {64, 3, 4});
    const Ray eye{points[0], points[1] - points[0]};
    CHECK(radiance(scene, eye, 5) == approx(vec3(2, 3 * 0.59049f, 4)));
    CHECK(radiance(scene, eye, 4) == vec3(0));
}

TEST_CASE("a matte ball in a mirror is as bright as the ball itself") {
    Scene scene;
    const vec3 ball(-1, -2, -3.5f), on_mirror(1, 0.5f, -4), eye(0, 0, 0);
    const int silver = add(scene.materials, Mirror{vec3(1)});
    const vec3 normal = normalize(normalize(eye - on_mirror) + normalize(ball - on_mirror));
    scene.quads = {tile(on_mirror, normal, 0.3f, silver)};
    scene.spheres = {{ball, 0.5f, add(scene.materials, Diffuse{{0.8f, 0.4f, 0.6f}})}};
    scene.lights = {{{2, 3, -1}, {9, 8, 7}}};
    const vec3 directly = radiance(scene, Ray{on_mirror - 0.01f * (on_mirror - ball), ball - on_mirror}, 3);
    REQUIRE(directly.x > 0.01f);
    CHECK(radiance(scene, Ray{eye, 2.0f * (on_mirror - eye)}, 3) == approx(directly));
}

TEST_CASE("a mirror blocks the light behind it") {
    Scene scene;
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, add(scene.materials, Diffuse{vec3(0.5f)})}};
    scene.lights = {{{1, 2, -1}, vec3(pi)}};
    const Ray down{{1, 0.3f, -1}, {0, -2, 0}};
    CHECK(radiance(scene, down, 3) == approx(vec3(0.125f)));
    scene.quads = {tile({1, 1, -1}, tilted, 0.4f, add(scene.materials, Mirror{vec3(1)}))};
    CHECK_MESSAGE(radiance(scene, down, 3) == vec3(0), "quads cast shadows");
    scene.quads = {tile({1, 3, -1}, tilted, 0.4f, 1)};
    CHECK_MESSAGE(radiance(scene, down, 3) == approx(vec3(0.125f)), "the mirror is beyond the light");
}
