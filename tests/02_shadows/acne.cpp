// Facts about shadow acne: no point that faces the light is shadowed by its own surface.
#include "tests/check.h"

#include "02_shadows/point_light.h"
#include "02_shadows/scene.h"
#include "common/math/random.h"

#include "tests/02_shadows/step.h"
#include "tests/02_shadows/scenes.h"

using namespace rt;

namespace {

/// Returns how many of 1000 points of the ball, the only object in the scene, do not
/// get all the light they face.
int shadowed_by_itself(const Sphere& ball, float lamp_distance, float eye_distance, std::uint64_t seed) {
    Random random(seed);
    int wrong = 0, facing = 0;
    for (int i = 0; facing < 1000 && i < 20000; ++i) {
        const vec3 eye = ball.center + eye_distance * ball.radius * any_direction(random);
        const vec3 aim = ball.center + 0.99f * ball.radius * any_direction(random);
        const PointLight light{ball.center + lamp_distance * ball.radius * any_direction(random),
                               vec3(ball.radius * ball.radius)};
        const Scene scene = lit_balls({light}, {ball});
        const auto hit = intersect(scene, Ray{eye, 2.0f * (aim - eye)});
        if (!hit) {
            ++wrong;
            continue;
        }
        const vec3 free = irradiance(light, hit->position, hit->shading_normal);
        if (free == vec3(0)) continue;
        ++facing;
        wrong += !(direct_irradiance(scene, *hit) == approx(free));
    }
    return facing < 1000 ? 20000 : wrong;
}

} // namespace

TEST_CASE("no point of a ball that faces the light is shadowed by the ball, whatever its size and position") {
    for (const float radius : {0.01f, 0.5f, 7.0f, 1000.0f})
        for (const vec3 center : {vec3(0), vec3(1, -2, 3), vec3(-300, 40, 77)}) {
            INFO("radius " << radius << " around " << to_text(center));
            CHECK_MESSAGE(shadowed_by_itself({center, radius, 0}, 5, 8, 1) == 0,
                          "shadow acne: the shadow ray hits the surface that it starts from");
            CHECK_MESSAGE(shadowed_by_itself({center, radius, 0}, 1.3f, 1.2f, 2) == 0,
                          "shadow acne under a close light");
        }
}

TEST_CASE("no point of a ball near the origin is shadowed by the ball when it is seen from afar") {
    for (const float away : {100.0f, 1000.0f, 20000.0f}) {
        INFO("seen from " << away << " metres");
        CHECK_MESSAGE(shadowed_by_itself({{0.1f, -0.2f, 0.3f}, 1, 0}, 5, away, 5) == 0,
                      "rounding of a position depends on the ray's origin as well: the larger coordinates "
                      "set the offset");
    }
}

TEST_CASE("no point of the inner side of a ball is shadowed by the ball") {
    for (const float radius : {0.01f, 0.5f, 7.0f, 1000.0f})
        for (const vec3 center : {vec3(0), vec3(1, -2, 3), vec3(-300, 40, 77)}) {
            if (radius < 1e-4f * length(center)) continue; // a float's grid is too coarse there
            INFO("radius " << radius << " around " << to_text(center));
            CHECK_MESSAGE(shadowed_by_itself({center, radius, 0}, 0.6f, 0.7f, 3) == 0,
                          "shadow acne: seen from inside, the offset must point inward");
        }
}

TEST_CASE("no point of a floor from the viewer's feet to the horizon is shadowed by the floor") {
    Random random(4);
    int wrong = 0;
    for (int i = 0; i < 10000; ++i) {
        const vec3 normal = any_direction(random);
        const vec3 a = beside(normal), b = cross(normal, a);
        const vec3 point = any_point(random, 20);
        Scene scene;
        scene.planes = {{point, normal, add(scene.materials, Diffuse{vec3(0.5f)})}};
        const vec3 eye = point + 1.7f * normal;
        const float away = std::pow(10.0f, -2 + 5 * random.get_1d()); // a centimetre to a kilometre
        const float angle = 2 * pi * random.get_1d();
        const vec3 target = point + away * (std::cos(angle) * a + std::sin(angle) * b);
        const PointLight light{point + 4.0f * normal + 3.0f * a, vec3(20)};
        scene.lights = {light};
        const auto hit = intersect(scene, Ray{eye, 0.3f * (target - eye)});
        if (!hit || !(direct_irradiance(scene, *hit) ==
                      approx(irradiance(light, hit->position, hit->shading_normal))))
            ++wrong;
    }
    CHECK_MESSAGE(wrong == 0, "shadow acne on " << wrong << " of 10000 points");
}

TEST_CASE("a floor that is a ball of 10 km radius does not shadow itself") {
    Scene scene = lit_balls({{{2, 30, -5}, vec3(900)}}, {{{0, -1e4f, 0}, 1e4f, 0}});
    int wrong = 0;
    for (int i = 0; i < 5000; ++i) {
        const float slope = -0.05f - 0.0004f * float(i);
        const auto hit = intersect(scene, Ray{{0.3f, 1.7f, 5.5f}, {0.4f, slope, -1}});
        wrong += !hit || !(direct_irradiance(scene, *hit) ==
                           approx(irradiance(scene.lights[0], hit->position, hit->shading_normal)));
    }
    CHECK_MESSAGE(wrong == 0, "shadow acne on " << wrong << " of 5000 points");
}
