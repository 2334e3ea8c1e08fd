// Facts about mirrors: the direction of a reflected ray, and where the ray starts.
#include "01_spheres/sphere.h"
#include "03_mirror/mirror.h"
#include "tests/03_mirror/step.h"

using namespace rt;

TEST_CASE("a reflected direction leaves at the angle at which it came") {
    const vec3 r = reflect(slanting, tilted);
    CHECK_MESSAGE(dot(r, tilted) == approx(-dot(slanting, tilted)), "r.n = -d.n");
    const float d_n = dot(slanting, tilted);
    const vec3 expected = slanting - 2 * d_n * tilted;
    CHECK_MESSAGE(
        r == approx(expected),
        hint(r, {{slanting + 2 * d_n * tilted, "d + 2 (d.n) n: the reflection is upside down"},
                 {slanting - 2.0f * (slanting * tilted) * tilted,
                  "the element-wise product instead of the dot product: zebra rings on curved mirrors"},
                 {-expected, "the result is negated: it points into the mirror"},
                 {slanting - d_n * tilted, "d - (d.n) n slides along the surface: subtract it twice"},
                 {slanting, "the direction was not reflected at all"},
                 {-slanting, "straight back to where it came from, whatever the normal"}}));
}

TEST_CASE("a reflected direction keeps its length") {
    Random random(1);
    for (int i = 0; i < 200; ++i) {
        const vec3 d = (0.1f + 5 * random.get_1d()) * any_direction(random), n = any_direction(random);
        CHECK_MESSAGE(length(reflect(d, n)) == approx(length(d)), "|r| = |d| for a d of any length");
    }
}

TEST_CASE("a mirror keeps the tangential part of a direction") {
    Random random(2);
    for (int i = 0; i < 200; ++i) {
        const vec3 d = 3.0f * any_direction(random), n = any_direction(random);
        const vec3 along = d - dot(d, n) * n;
        const vec3 r = reflect(d, n);
        CHECK_MESSAGE(r - dot(r, n) * n == approx(along),
                      "the tangential part stays, the normal part is reversed");
        CHECK_MESSAGE(dot(r, n) == approx(-dot(d, n)),
                      "the tangential part stays, the normal part is reversed");
    }
}

TEST_CASE("reflecting twice restores the direction") {
    Random random(3);
    for (int i = 0; i < 200; ++i) {
        const vec3 d = 3.0f * any_direction(random), n = any_direction(random);
        CHECK(reflect(reflect(d, n), n) == approx(d));
    }
}

TEST_CASE("a reflection does not depend on the sign of the normal") {
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        const vec3 d = 3.0f * any_direction(random), n = any_direction(random);
        CHECK(reflect(d, -n) == approx(reflect(d, n)));
    }
}

TEST_CASE("a corner of three mirrors sends a ray back to where it came from") {
    const vec3 a = tilted, b = beside(tilted), c_ = cross(a, b);
    CHECK(reflect(reflect(reflect(slanting, a), b), c_) == approx(-slanting));
}

TEST_CASE("a reflected ray starts beside the surface, on the side from which the ray came") {
    const Hit hit = make_hit(Ray{somewhere - slanting, slanting, 0, 1}, tilted, {0, 0}, 0);
    const Ray reflected = reflected_ray({somewhere - slanting, slanting}, hit);
    CHECK(reflected.direction == approx(slanting - 2 * dot(slanting, tilted) * tilted));
    CHECK_MESSAGE(dot(reflected.origin - somewhere, tilted) > 0,
                  "no offset, or an inward one: black pepper on the mirror");
    CHECK_MESSAGE(distance(reflected.origin, somewhere) < 1e-3f, "the offset is visible");
    CHECK_MESSAGE(reflected.t_max == infinity, "a reflected ray must be unbounded");

    const Hit back = make_hit(Ray{somewhere + slanting, -slanting, 0, 1}, tilted, {0, 0}, 0);
    const Ray behind = reflected_ray({somewhere + slanting, -slanting}, back);
    CHECK_MESSAGE(dot(behind.origin - somewhere, tilted) < 0,
                  "a mirror seen from behind reflects to that side");
    CHECK(dot(behind.direction, tilted) < 0);
}

TEST_CASE("a mirror reflects around the shading normal and offsets rays along the geometric normal") {
    const vec3 smooth = normalize(tilted + 0.4f * beside(tilted));
    const Hit hit = make_hit(Ray{somewhere - slanting, slanting, 0, 1}, tilted, smooth, {0, 0}, 0);
    const Ray reflected = reflected_ray({somewhere - slanting, slanting}, hit);
    CHECK_MESSAGE(reflected.direction == approx(slanting - 2 * dot(slanting, smooth) * smooth),
                  "if hit.geometric_normal is used, meshes that should look smooth reflect in facets");
    CHECK_MESSAGE(dot(reflected.direction, tilted) > 0,
                  "a mirror sends light back to the side that it came from");
    CHECK_MESSAGE(
        dot(reflected.origin - somewhere, beside(tilted)) == approx(0, 1e-6f),
        "the offset must be along hit.geometric_normal: the shading normal may point into the surface");
}

TEST_CASE("a reflected ray does not hit the ball that it leaves, whatever the ball's size and position") {
    Random random(5);
    for (const float radius : {0.01f, 0.5f, 7.0f, 1000.0f})
        for (const vec3 center : {vec3(0), vec3(1, -2, 3), vec3(-300, 40, 77)}) {
            const Sphere ball{center, radius, 0};
            int again = 0, hits = 0;
            for (int i = 0; i < 3000; ++i) {
                const vec3 eye = center + 4 * radius * any_direction(random);
                Ray ray{eye, 0.5f * (center + 0.98f * radius * any_direction(random) - eye)};
                const auto t = intersect(ball, ray);
                if (!t) continue;
                ++hits;
                ray.t_max = *t;
                again += intersect(ball, reflected_ray(ray, surface_hit(ball, ray))).has_value();
            }
            INFO("radius " << radius << " around " << to_text(center));
            CHECK_MESSAGE(again == 0,
                          again << " of " << hits << " reflected rays: black pepper on the mirror");
            CHECK(hits > 2900);
        }
}
