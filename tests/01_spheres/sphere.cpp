// Facts about ray-sphere intersection and the normals of spheres.
#include "tests/check.h"

#include "01_spheres/sphere.h"
#include "common/math/random.h"

#include <algorithm>
#include <string>

#include "tests/01_spheres/step.h"
#include "tests/01_spheres/ball.h"

using namespace rt;
using glm::dvec3;

TEST_CASE("a ball of radius 1, five metres ahead, is hit at t = 4") {
    const float t = t_of(intersect(Sphere{{0, 0, -5}, 1, 0}, Ray{{0, 0, 0}, {0, 0, -1}}));
    CHECK_MESSAGE(t == approx(4),
                  hint(t, {{6, "this is the far root"},
                           {-4, "this is behind the ray: O - C was used instead of C - O"},
                           {-6, "this is behind the ray: O - C was used instead of C - O"},
                           {8, "twice as far: q/a was not halved"},
                           {5, "this is the centre"},
                           {miss, "a miss: C - O has the wrong sign, or a root was rejected"}}));
}

TEST_CASE("behind the near side of a ball is its far side, at t = 6") {
    const float t = t_of(intersect(Sphere{{0, 0, -5}, 1, 0}, Ray{{0, 0, 0}, {0, 0, -1}, 5}));
    CHECK_MESSAGE(t == approx(6), hint(t, {{4, "this is the near root, which lies before t_min = 5"},
                                           {miss, "only the near root was tried"}}));
}

TEST_CASE("a ball of radius 2 is hit a metre earlier") {
    const float t = t_of(intersect(Sphere{{0, 0, -5}, 2, 0}, Ray{{0, 0, 0}, {0, 0, -1}}));
    CHECK_MESSAGE(t == approx(3), hint(t, {{3.585786f, "5 - sqrt(2): the radius was not squared"},
                                           {4, "the radius was left out"},
                                           {7, "this is the far root"}}));
    const float small = t_of(intersect(Sphere{{0, 0, -5}, 0.5f, 0}, Ray{{0, 0, 0}, {0, 0, -1}}));
    CHECK_MESSAGE(small == approx(4.5f), hint(small, {{4.292893f, "the radius was not squared"}}));
}

TEST_CASE("a direction twice as long halves t") {
    const float t = t_of(intersect(Sphere{{0, 0, -5}, 1, 0}, Ray{{0, 0, 0}, {0, 0, -2}}));
    CHECK_MESSAGE(t == approx(2),
                  hint(t, {{4, "this is in metres: t is measured in multiples of the direction"},
                           {8, "multiplied by a = d.d instead of divided"},
                           {miss, "a = d.d was assumed to be 1"}}));
    const float far = t_of(intersect(Sphere{{0, 0, -5}, 1, 0}, Ray{{0, 0, 0}, {0, 0, -2}, 2.5f}));
    CHECK_MESSAGE(far == approx(3),
                  hint(far, {{6, "this is in metres"}, {miss, "only the near root was tried"}}));
}

TEST_CASE("a ray that starts inside a sphere hits its far side") {
    const float centre = t_of(intersect(Sphere{{0, 0, -5}, 2, 0}, Ray{{0, 0, -5}, {0, 0, -1}}));
    CHECK_MESSAGE(centre == approx(2), hint(centre, {{-2, "this is the near root, behind the origin"},
                                                     {miss, "only the near root was tried"}}));
    const float oblique = t_of(intersect(ball, from_within));
    CHECK_MESSAGE(oblique == approx(2), hint(oblique, {{-6, "this is the near root, behind the origin"},
                                                       {6, "this is |t| of the root behind the origin"},
                                                       {miss, "only the near root was tried"}}));
}

TEST_CASE("a sphere behind the ray is missed") {
    const Sphere ahead{{0, 0, -5}, 1, 0};
    const float t = t_of(intersect(ahead, Ray{{0, 0, 0}, {0, 0, 1}}));
    CHECK_MESSAGE(std::isnan(t), hint(t, {{4, "this is |t|, or the ray was reversed"},
                                          {6, "this is |t|, or the ray was reversed"},
                                          {-4, "a negative t was accepted"},
                                          {-6, "a negative t was accepted"}}));
    CHECK_FALSE(intersect(ball, Ray{to_ball.origin, -to_ball.direction}));
}

TEST_CASE("a sphere beyond t_max is missed") {
    const Sphere ahead{{0, 0, -5}, 1, 0};
    CHECK_FALSE_MESSAGE(intersect(ahead, Ray{{0, 0, 0}, {0, 0, -1}, 0, 3}),
                        "t_max was ignored: balls beyond a light will cast shadows");
    CHECK(t_of(intersect(ahead, Ray{{0, 0, 0}, {0, 0, -1}, 0, 5})) == approx(4));
    CHECK_FALSE_MESSAGE(intersect(Sphere{{0, 0, -5}, 2, 0}, Ray{{0, 0, -5}, {0, 0, -1}, 0, 1.5f}),
                        "the far root must lie before t_max, too");
    CHECK_FALSE_MESSAGE(intersect(ahead, Ray{{0, 0, 0}, {0, 0, -1}, 4.5f, 5.5f}),
                        "a ball is hollow: nothing is hit between its two walls");
    CHECK_FALSE_MESSAGE(intersect(ahead, Ray{{0, 0, 0}, {0, 0, -1}, 7}), "t_min was ignored");
}

TEST_CASE("a ray that starts on a sphere does not hit it there") {
    const Sphere ahead{{0, 0, -5}, 1, 0};
    const float in = t_of(intersect(ahead, Ray{{0, 0, -4}, {0, 0, -1}}));
    CHECK_MESSAGE(in == approx(2), hint(in, {{0, "t = 0 is the ray's own origin; the interval is open"}}));
    CHECK_FALSE(intersect(ahead, Ray{{0, 0, -4}, {0, 0, 1}}));
    CHECK_FALSE(intersect(ahead, Ray{{0, 0, -4}, {0.5f, 0, 0}}));
}

TEST_CASE("a ray that passes just beside a sphere misses it") {
    // The ray passes the centre at 99 % and 101 % of the radius, for distant marbles and for large balls.
    Random random(1);
    for (const float radius : {0.01f, 0.3f, 2.0f, 50.0f})
        for (const float distance : {3.0f, 100.0f, 2000.0f}) {
            const vec3 center = any_point(random, 5);
            const vec3 direction = any_direction(random);
            const vec3 side = beside(direction);
            const Sphere sphere{center, radius, 0};
            INFO("radius " << radius << ", from " << distance << " radii away");
            const vec3 origin = center - distance * radius * direction;
            CHECK(intersect(sphere, Ray{origin + 0.99f * radius * side, 3.0f * direction}));
            CHECK_FALSE(intersect(sphere, Ray{origin + 1.01f * radius * side, 3.0f * direction}));
        }
}

TEST_CASE("any ray hits any sphere where the distance to its centre equals the radius") {
    // Compares with a different method: the point of the ray that is closest to the centre,
    // then Pythagoras along the ray.
    Random random(2);
    int wrong = 0, hits = 0, inside = 0;
    for (int i = 0; i < 20000; ++i) {
        const Sphere sphere{any_point(random, 2), 0.2f + 3 * random.get_1d(), 0};
        const Ray ray{any_point(random, 3), (0.2f + 3 * random.get_1d()) * any_direction(random)};
        const dvec3 o(ray.origin), c(sphere.center);
        const dvec3 d = normalize(dvec3(ray.direction));
        const double along = dot(c - o, d);
        const double off = length(o + along * d - c);
        const double r = double(sphere.radius);
        if (std::abs(off - r) < 1e-3 || std::abs(length(o - c) - r) < 1e-3) continue; // too close to decide
        const double half = off < r ? std::sqrt(r * r - off * off) : 0;
        const double metres = along - half > 0 ? along - half : along + half;
        const bool expected = off < r && metres > 0;
        const auto t = intersect(sphere, ray);
        hits += expected;
        inside += expected && length(o - c) < r;
        if (t.has_value() != expected)
            ++wrong;
        else if (t)
            wrong += !(std::abs(double(*t) * length(dvec3(ray.direction)) - metres) < 1e-4 * (1 + metres));
    }
    CHECK_MESSAGE(wrong == 0, wrong << " of 20000 rays are wrong; " << hits << " should hit, " << inside
                                    << " of them from inside");
    CHECK(hits > 4000); // enough cases to check
    CHECK(inside > 1000);
}

TEST_CASE("from two radii away a ball fills 6.7 percent of all directions") {
    // The expected value is (1 - cos 30 degrees) / 2. A correct result has |z| > 4 for one seed in 16,000.
    Random random(3);
    const Sphere sphere{{1, -2, 3}, 2, 0};
    const vec3 eye = sphere.center + 4.0f * outward;
    Mean share;
    for (int i = 0; i < 400000; ++i)
        share.add(intersect(sphere, Ray{eye, 0.7f * any_direction(random)}) ? 1 : 0);
    const double expected = 0.0669873;
    INFO(share.against(expected));
    CHECK_MESSAGE(std::abs(share.z(expected)) < 4,
                  hint(float(share.mean()),
                       {{0.1339746f, "twice the expected value: hits behind the ray count as well"}}));
}

TEST_CASE("a floor that is a ball of 10 km radius is as smooth as a plane") {
    const Sphere earth{{0, -1e4f, 0}, 1e4f, 0};
    const vec3 eye(0.3f, 1.7f, 5.5f);
    double worst_t = 0, worst_height = 0, worst_normal = 0;
    int steps_back = 0;
    float last = 0;
    for (int i = 1; i <= 4000; ++i) { // from the viewer's feet to the horizon
        const float slope = -2.0f * float(4001 - i) / 4000 - 0.02f;
        const Ray ray{eye, normalize(vec3(0.4f, slope, -1))};
        const auto t = intersect(earth, ray);
        REQUIRE(t);
        const dvec3 to_center = dvec3(earth.center) - dvec3(eye), d(ray.direction);
        const double h = dot(d, to_center), a = dot(d, d);
        const double c = (length(to_center) - 1e4) * (length(to_center) + 1e4);
        const double exact = c / (h + std::sqrt(h * h - a * c));
        worst_t = std::max(worst_t, std::abs(double(*t) - exact) / exact);

        const Hit hit = surface_hit(earth, Ray{eye, ray.direction, 0, *t});
        const double height = length(dvec3(hit.position) - dvec3(earth.center)) - 1e4;
        worst_height = std::max(worst_height, std::abs(height) / exact);
        const dvec3 up = normalize(dvec3(eye) + exact * d - dvec3(earth.center));
        worst_normal = std::max(worst_normal, double(length(dvec3(hit.shading_normal) - up)));
        steps_back += *t <= last;
        last = *t;
    }
    const std::string cause = "c = |C - O|^2 - r^2 subtracts 1e8 from 1e8: a float has no digits left, and "
                              "the floor shows rings. Compute it in double, with the roots q/a and c/q";
    CHECK_MESSAGE(worst_t < 1e-5, cause);
    CHECK_MESSAGE(worst_height < 1e-5, cause);
    CHECK_MESSAGE(worst_normal < 1e-5, cause);
    CHECK_MESSAGE(steps_back == 0,
                  "each row of the picture must see farther than the row below it; " << cause);
}

TEST_CASE("a marble of 1 cm radius is round from a kilometre away") {
    const vec3 direction = vec3(2, 3, 6) / 7.0f;
    const vec3 side = beside(direction);
    const vec3 up = cross(side, direction);
    int wrong = 0;
    for (int i = 0; i < 360; ++i) {
        const float angle = float(i) * degrees;
        const vec3 off = 0.01f * (std::cos(angle) * side + std::sin(angle) * up);
        const Sphere marble{1000.0f * direction, 0.01f, 0};
        wrong += !intersect(marble, Ray{0.95f * off, direction});
        wrong += intersect(marble, Ray{1.05f * off, direction}).has_value();
    }
    CHECK_MESSAGE(wrong == 0, "wrong for " << wrong << " of 720 rays: h^2 - a c cancels in float");
}

TEST_CASE("the normal of a ball points from its centre to the hit") {
    const auto t = intersect(ball, to_ball);
    REQUIRE(t_of(t) == approx(2));
    const Hit hit = surface_hit(ball, Ray{to_ball.origin, to_ball.direction, 0, *t});
    std::string cause;
    if (hit.shading_normal == approx(-outward))
        cause = "it points inward: use hit - centre, not centre - hit";
    if (hit.shading_normal == approx(2.0f * outward))
        cause = "it has length 2, the radius: it was not normalised";
    if (hit.shading_normal == approx(4.0f * outward)) cause = "it was multiplied by the radius";
    if (hit.shading_normal == approx(normalize(on_ball)))
        cause = "this is normalize(hit), which is correct only for a ball at the origin";
    CHECK_MESSAGE(hit.shading_normal == approx(outward), cause);
    CHECK(hit.geometric_normal == approx(outward));
    CHECK(hit.position == approx(on_ball));
    CHECK_FALSE(hit.back_face);
    CHECK(hit.material == 7);
}

TEST_CASE("seen from inside, the normal of a ball points to its centre") {
    const Hit hit = surface_hit(ball, Ray{from_within.origin, from_within.direction, 0, 2});
    CHECK_MESSAGE(hit.shading_normal == approx(-outward),
                  "the normal must be on the side from which the ray comes");
    CHECK(hit.geometric_normal == approx(-outward));
    CHECK_MESSAGE(hit.back_face, "the ray comes from inside the ball");
    CHECK_MESSAGE(hit.uv == approx(sphere_uv(outward)), "the uv coordinates are the same from both sides");
}
