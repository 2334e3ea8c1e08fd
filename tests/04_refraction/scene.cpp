// Facts about a scene with glass: what a ray hits first, and what blocks a light.
#include "04_refraction/scene.h"
#include "tests/04_refraction/step.h"

#include <utility>

using namespace rt;

TEST_CASE("of balls, planes and quads a ray hits the closest in a scene with glass too") {
    const auto facing = [](float distance, int material) {
        const vec3 middle = -distance * normal;
        return Quad{middle - tangent - binormal, 2.0f * tangent, 2.0f * binormal, material};
    };
    Scene scene;
    scene.quads = {facing(5, 5), facing(1, 1)};
    scene.spheres = {{-6.5f * normal, 0.5f, 6}, {-2.5f * normal, 0.5f, 2}};
    scene.planes = {{-4.0f * normal, normal, 4}};
    for (const auto& [t_min, t] : {std::pair(0.0f, 1), {1.5f, 2}, {3.5f, 4}, {4.5f, 5}, {5.5f, 6}}) {
        const auto hit = intersect(scene, Ray{vec3(0), -normal, t_min});
        REQUIRE_MESSAGE(hit, "nothing is hit: one type of shape is not tested");
        CHECK_MESSAGE(
            hit->material == t,
            "another shape is hit first: one type is not tested, or a hit does not shorten the ray");
        CHECK(hit->t == approx(float(t)));
    }
}

TEST_CASE("each type of shape blocks a light whether it is glass or matte") {
    const Ray between{vec3(0), -4.0f * normal, 0, 1}, before{vec3(0), -4.0f * normal, 0, 0.25f};
    const vec3 corner = -2.0f * normal - tangent - binormal;
    Scene round, level, upright;
    round.spheres = {{-2.0f * normal, 0.5f, 0}};
    level.planes = {{-2.0f * normal, normal, 0}};
    upright.quads = {{corner, 2.0f * tangent, 2.0f * binormal, 0}};
    for (Scene* scene : {&round, &level, &upright}) {
        add(scene->materials, Dielectric{Medium{1.5f}});
        CHECK_MESSAGE(occluded(*scene, between), "no shadow: one type of shape is not tested");
        CHECK_MESSAGE(!occluded(*scene, before), "a shape beyond the light must not block it");
    }
}
