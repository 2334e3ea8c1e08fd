// Facts about ray-plane intersection, and about uv coordinates in metres.
#include "tests/check.h"

#include "01_spheres/plane.h"
#include "common/math/random.h"

#include "tests/01_spheres/step.h"

using namespace rt;

TEST_CASE("a ray hits an oblique plane where it crosses it") {
    const vec3 normal = vec3(2, 3, 6) / 7.0f;
    const Plane plane{{1, 1, 1}, normal, 3};
    // 7 metres above the plane, descending 2 metres per unit of t
    const Ray ray{plane.point + 7.0f * normal + 4.0f * beside(normal),
                  -2.0f * normal + 1.5f * beside(normal)};
    const float t = t_of(intersect(plane, ray));
    CHECK_MESSAGE(t == approx(3.5f), hint(t, {{-3.5f, "O - P has the wrong sign"},
                                              {7, "this is the distance: divide by d.n"},
                                              {14, "multiplied by d.n instead of divided"},
                                              {miss, "a miss: O - P has the wrong sign"}}));
    CHECK_FALSE_MESSAGE(intersect(plane, Ray{ray.origin, -ray.direction}), "the plane is behind the ray");
    CHECK_FALSE_MESSAGE(intersect(plane, Ray{ray.origin, ray.direction, 0, 3}), "the plane is beyond t_max");
    CHECK_FALSE_MESSAGE(intersect(plane, Ray{ray.origin, ray.direction, 4}), "the plane is before t_min");
}

TEST_CASE("a ray parallel to a plane misses it") {
    const Plane floor{{0, 1, 0}, {0, 1, 0}, 0};
    CHECK_FALSE(intersect(floor, Ray{{0, 2, 0}, {3, 0, 1}}));
    CHECK_FALSE(intersect(floor, Ray{{0, 0, 0}, {3, 0, 1}}));
    CHECK_FALSE_MESSAGE(intersect(floor, Ray{{0, 1, 0}, {3, 0, 1}}),
                        "0/0 is NaN, which no interval contains");
}

TEST_CASE("a plane has two sides") {
    const Plane plane{{1, 1, 1}, vec3(2, 3, 6) / 7.0f, 3};
    const Hit above = surface_hit(plane, Ray{plane.point + 3.0f * plane.normal, -plane.normal, 0, 3});
    CHECK(above.shading_normal == approx(plane.normal));
    CHECK_FALSE(above.back_face);
    CHECK(above.material == 3);
    const Ray upward{plane.point - 3.0f * plane.normal, plane.normal};
    CHECK(t_of(intersect(plane, upward)) == approx(3));
    const Hit below = surface_hit(plane, Ray{upward.origin, upward.direction, 0, 3});
    CHECK(below.shading_normal == approx(-plane.normal));
    CHECK(below.back_face);
}

TEST_CASE("on a floor u runs along +x and v along -z, in metres") {
    const Plane floor{{2, -1, 3}, {0, 1, 0}, 0};
    const Hit hit = surface_hit(floor, Ray{{4.5f, 1, 4}, {0, -0.5f, 0}, 0, 4}); // hits (4.5, -1, 4)
    CHECK_MESSAGE(hit.uv == approx(vec2(2.5f, -1)), "uv is measured from plane.point");
}

TEST_CASE("on any plane the uv of two points are as far apart as the points") {
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        const Plane plane{any_point(random, 3), any_direction(random), 0};
        const vec3 a = beside(plane.normal), b = cross(plane.normal, a);
        const auto uv = [&](float x, float y) {
            const vec3 point = plane.point + x * a + y * b;
            return surface_hit(plane, Ray{point + 2.0f * plane.normal, -plane.normal, 0, 2}).uv;
        };
        INFO("normal " << to_text(plane.normal));
        CHECK(distance(uv(1, 2), uv(-2, 6)) == approx(5, 1e-4f));
        CHECK(distance(uv(0, 0), uv(3, 0)) == approx(3, 1e-4f));
    }
}
