// Facts about the first step: rays, the camera that sends them, the shapes they meet, and what comes back.
#include "tests/check.h"

#include "01_spheres/background.h"
#include "01_spheres/camera.h"
#include "01_spheres/diffuse.h"
#include "01_spheres/hit.h"
#include "01_spheres/plane.h"
#include "01_spheres/radiance.h"
#include "01_spheres/ray.h"
#include "01_spheres/scene.h"
#include "01_spheres/sphere.h"
#include "01_spheres/view.h"
#include "common/random.h"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

using namespace rt;
using glm::dvec3;

namespace {

/// The t of a hit; NaN, which equals nothing, for a miss.
float t_of(const std::optional<float>& t) {
    return t.value_or(std::numeric_limits<float>::quiet_NaN());
}

/// What a wrong value usually means: the first of `causes` whose value came.
std::string hint(float got, const std::vector<std::pair<float, std::string>>& causes) {
    for (const auto& [value, cause] : causes)
        if (got == approx(value, 1e-3f) || (std::isnan(got) && std::isnan(value)))
            return "got " + to_text(got) + ": " + cause;
    return "got " + to_text(got);
}
const float miss = std::numeric_limits<float>::quiet_NaN();

/// A direction of length 1, each as likely as any other.
vec3 any_direction(Random& random) {
    const float y = 1 - 2 * random.uniform();
    const float angle = 2 * pi * random.uniform();
    const float r = std::sqrt(std::max(0.0f, 1 - y * y));
    return {r * std::cos(angle), y, r * std::sin(angle)};
}

/// A point of the cube [-size, size]^3.
vec3 any_point(Random& random, float size) {
    const float x = random.uniform(), y = random.uniform(), z = random.uniform();
    return size * (2.0f * vec3(x, y, z) - 1.0f);
}

/// Any vector at a right angle to `direction`, of length 1.
vec3 beside(vec3 direction) {
    const vec3 other = std::abs(direction.x) < 0.6f ? vec3(1, 0, 0) : vec3(0, 1, 0);
    return normalize(cross(direction, other));
}

const float degrees = pi / 180;

/// Oblique on purpose: neither the normal nor the direction lies along an axis, the radius is not 1 and the
/// direction is not of unit length.
const Sphere ball{{1, -2, 3}, 2, 7};
const vec3 outward = vec3(2, -1, 2) / 3.0f;
const vec3 on_ball = ball.center + 2.0f * outward;
const vec3 slanting = -2.5f * normalize(outward + 0.4f * normalize(cross(outward, vec3(0, 1, 0))));
const Ray to_ball{on_ball - 2.0f * slanting, slanting};       // meets on_ball at t = 2
const Ray from_within{ball.center + outward, 0.5f * outward}; // starts inside, meets on_ball at t = 2

} // namespace

// --- ray.h ---

TEST_CASE("t counts in lengths of the ray's direction") {
    const Ray ray{{1, 2, 3}, {0, -2, 0.5f}};
    CHECK_MESSAGE(at(ray, 3) == approx(vec3(1, -4, 4.5f)),
                  "origin + t direction, with the direction as it is");
    CHECK(at(ray, 0) == approx(vec3(1, 2, 3)));
}

TEST_CASE("a ray contains the t between its ends") {
    const Ray ray{{0, 0, 0}, {0, 0, -1}, 1, 4};
    CHECK(contains(ray, 1.5f));
    CHECK(contains(ray, 3.9f));
    CHECK_FALSE_MESSAGE(contains(ray, 0.5f), "before t_min");
    CHECK_FALSE_MESSAGE(contains(ray, 4.5f), "beyond t_max");
    CHECK_FALSE_MESSAGE(contains(ray, 4), "a hit shortens the ray to its own t, and must not be found again");
    CHECK_FALSE_MESSAGE(contains(ray, miss), "a t that is not a number lies in no interval");
    CHECK_FALSE_MESSAGE(contains(Ray{{0, 0, 0}, {0, 0, -1}}, -1),
                        "what lies behind the origin does not count");
    CHECK(contains(Ray{{0, 0, 0}, {0, 0, -1}}, 1e30f));
}

// --- sphere.h ---

TEST_CASE("a ball of radius 1, five metres ahead, is met at t = 4") {
    const float t = t_of(intersect(Sphere{{0, 0, -5}, 1, 0}, Ray{{0, 0, 0}, {0, 0, -1}}));
    CHECK_MESSAGE(t == approx(4), hint(t, {{6, "that is the far root"},
                                           {-4, "that lies behind: O - C was taken for C - O"},
                                           {-6, "that lies behind: O - C was taken for C - O"},
                                           {8, "that is twice as far: q/a was not halved"},
                                           {5, "that is the centre"},
                                           {miss, "a miss: C - O with the wrong sign, or a root rejected"}}));
}

TEST_CASE("behind the near side of a ball comes its far side, at t = 6") {
    const float t = t_of(intersect(Sphere{{0, 0, -5}, 1, 0}, Ray{{0, 0, 0}, {0, 0, -1}, 5}));
    CHECK_MESSAGE(t == approx(6), hint(t, {{4, "that is the near root, which lies before t_min = 5"},
                                           {miss, "only the near root was tried"}}));
}

TEST_CASE("a ball of radius 2 is met a metre sooner") {
    const float t = t_of(intersect(Sphere{{0, 0, -5}, 2, 0}, Ray{{0, 0, 0}, {0, 0, -1}}));
    CHECK_MESSAGE(t == approx(3), hint(t, {{3.585786f, "5 - sqrt(2): the radius was not squared"},
                                           {4, "the radius was left out"},
                                           {7, "that is the far root"}}));
    const float small = t_of(intersect(Sphere{{0, 0, -5}, 0.5f, 0}, Ray{{0, 0, 0}, {0, 0, -1}}));
    CHECK_MESSAGE(small == approx(4.5f), hint(small, {{4.292893f, "the radius was not squared"}}));
}

TEST_CASE("a direction twice as long halves t") {
    const float t = t_of(intersect(Sphere{{0, 0, -5}, 1, 0}, Ray{{0, 0, 0}, {0, 0, -2}}));
    CHECK_MESSAGE(t == approx(2), hint(t, {{4, "that is metres: t counts in lengths of the direction"},
                                           {8, "multiplied by a = d.d where it should be divided"},
                                           {miss, "a = d.d was taken for 1"}}));
    const float far = t_of(intersect(Sphere{{0, 0, -5}, 1, 0}, Ray{{0, 0, 0}, {0, 0, -2}, 2.5f}));
    CHECK_MESSAGE(far == approx(3),
                  hint(far, {{6, "that is metres"}, {miss, "only the near root was tried"}}));
}

TEST_CASE("a ray that starts inside a sphere meets its far side") {
    const float centre = t_of(intersect(Sphere{{0, 0, -5}, 2, 0}, Ray{{0, 0, -5}, {0, 0, -1}}));
    CHECK_MESSAGE(centre == approx(2), hint(centre, {{-2, "that is the near root, behind the origin"},
                                                     {miss, "only the near root was tried"}}));
    const float oblique = t_of(intersect(ball, from_within));
    CHECK_MESSAGE(oblique == approx(2), hint(oblique, {{-6, "that is the near root, behind the origin"},
                                                       {6, "that is |t| of what lies behind"},
                                                       {miss, "only the near root was tried"}}));
}

TEST_CASE("a sphere behind the ray is missed") {
    const Sphere ahead{{0, 0, -5}, 1, 0};
    const float t = t_of(intersect(ahead, Ray{{0, 0, 0}, {0, 0, 1}}));
    CHECK_MESSAGE(std::isnan(t), hint(t, {{4, "that is |t|, or the ray was turned round"},
                                          {6, "that is |t|, or the ray was turned round"},
                                          {-4, "a negative t was accepted"},
                                          {-6, "a negative t was accepted"}}));
    CHECK_FALSE(intersect(ball, Ray{to_ball.origin, -to_ball.direction}));
}

TEST_CASE("a sphere beyond t_max is missed") {
    const Sphere ahead{{0, 0, -5}, 1, 0};
    CHECK_FALSE_MESSAGE(intersect(ahead, Ray{{0, 0, 0}, {0, 0, -1}, 0, 3}),
                        "the upper end of the interval was ignored: balls beyond a light will cast shadows");
    CHECK(t_of(intersect(ahead, Ray{{0, 0, 0}, {0, 0, -1}, 0, 5})) == approx(4));
    CHECK_FALSE_MESSAGE(intersect(Sphere{{0, 0, -5}, 2, 0}, Ray{{0, 0, -5}, {0, 0, -1}, 0, 1.5f}),
                        "the far root, too, must lie before t_max");
    CHECK_FALSE_MESSAGE(intersect(ahead, Ray{{0, 0, 0}, {0, 0, -1}, 4.5f, 5.5f}),
                        "between its two walls a ball is empty");
    CHECK_FALSE_MESSAGE(intersect(ahead, Ray{{0, 0, 0}, {0, 0, -1}, 7}), "the lower end was ignored");
}

TEST_CASE("a ray that starts on a sphere does not meet it there") {
    const Sphere ahead{{0, 0, -5}, 1, 0};
    const float in = t_of(intersect(ahead, Ray{{0, 0, -4}, {0, 0, -1}}));
    CHECK_MESSAGE(in == approx(2), hint(in, {{0, "t = 0 is the ray's own origin; the interval is open"}}));
    CHECK_FALSE(intersect(ahead, Ray{{0, 0, -4}, {0, 0, 1}}));
    CHECK_FALSE(intersect(ahead, Ray{{0, 0, -4}, {0.5f, 0, 0}}));
}

TEST_CASE("a ray that passes just beside a sphere misses it") {
    // Aimed past the centre at 99 % and 101 % of the radius, for marbles far away and for great balls.
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

TEST_CASE("any ray meets any sphere where the distance to its centre is the radius") {
    // Against another way to reckon it: the point of the ray that is nearest to the centre, and from there
    // along the ray by Pythagoras.
    Random random(2);
    int wrong = 0, hits = 0, inside = 0;
    for (int i = 0; i < 20000; ++i) {
        const Sphere sphere{any_point(random, 2), 0.2f + 3 * random.uniform(), 0};
        const Ray ray{any_point(random, 3), (0.2f + 3 * random.uniform()) * any_direction(random)};
        const dvec3 o(ray.origin), c(sphere.center);
        const dvec3 d = normalize(dvec3(ray.direction));
        const double along = dot(c - o, d);
        const double off = length(o + along * d - c);
        const double r = double(sphere.radius);
        if (std::abs(off - r) < 1e-3 || std::abs(length(o - c) - r) < 1e-3) continue; // too close to call
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
    CHECK_MESSAGE(wrong == 0, wrong << " of 20000 rays went wrong; " << hits << " should hit, " << inside
                                    << " of them from inside");
    CHECK(hits > 4000); // that there is something to check
    CHECK(inside > 1000);
}

TEST_CASE("from two radii away a ball fills 6.7 percent of all directions") {
    // (1 - cos 30 degrees) / 2. Beyond z = 4 by chance: one time in 16,000 for another seed.
    Random random(3);
    const Sphere sphere{{1, -2, 3}, 2, 0};
    const vec3 eye = sphere.center + 4.0f * outward;
    Mean share;
    for (int i = 0; i < 400000; ++i)
        share.add(intersect(sphere, Ray{eye, 0.7f * any_direction(random)}) ? 1 : 0);
    const double expected = 0.0669873;
    INFO(share.against(expected));
    CHECK_MESSAGE(std::abs(share.z(expected)) < 4,
                  hint(float(share.mean()), {{0.1339746f, "twice that: what lies behind counts as well"}}));
}

TEST_CASE("a floor that is a ball of 10 km radius is as smooth as a plane") {
    const Sphere earth{{0, -1e4f, 0}, 1e4f, 0};
    const vec3 eye(0.3f, 1.7f, 5.5f);
    double worst_t = 0, worst_height = 0, worst_normal = 0;
    int steps_back = 0;
    float last = 0;
    for (int i = 1; i <= 4000; ++i) { // from one's feet to the horizon
        const float slope = -2.0f * float(4001 - i) / 4000 - 0.02f;
        const Ray ray{eye, normalize(vec3(0.4f, slope, -1))};
        const auto t = intersect(earth, ray);
        REQUIRE(t);
        const dvec3 to_center = dvec3(earth.center) - dvec3(eye), d(ray.direction);
        const double h = dot(d, to_center), a = dot(d, d);
        const double c = (length(to_center) - 1e4) * (length(to_center) + 1e4);
        const double exact = c / (h + std::sqrt(h * h - a * c));
        worst_t = std::max(worst_t, std::abs(double(*t) - exact) / exact);

        const Hit hit = surface(earth, Ray{eye, ray.direction, 0, *t});
        const double height = length(dvec3(hit.position) - dvec3(earth.center)) - 1e4;
        worst_height = std::max(worst_height, std::abs(height) / exact);
        const dvec3 up = normalize(dvec3(eye) + exact * d - dvec3(earth.center));
        worst_normal = std::max(worst_normal, double(length(dvec3(hit.normal) - up)));
        steps_back += *t <= last;
        last = *t;
    }
    const std::string cause =
        "c = |C - O|^2 - r^2 takes 1e8 from 1e8: a float has no digits left, and the floor "
        "shows rings. Reckon it in double, with the roots q/a and c/q";
    CHECK_MESSAGE(worst_t < 1e-5, cause);
    CHECK_MESSAGE(worst_height < 1e-5, cause);
    CHECK_MESSAGE(worst_normal < 1e-5, cause);
    CHECK_MESSAGE(steps_back == 0, "each row of the picture sees further than the row below it; " << cause);
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
    const Hit hit = surface(ball, Ray{to_ball.origin, to_ball.direction, 0, *t});
    std::string cause;
    if (hit.normal == approx(-outward)) cause = "it points inward: hit - centre, not centre - hit";
    if (hit.normal == approx(2.0f * outward)) cause = "it has length 2, the radius: it was not normalised";
    if (hit.normal == approx(4.0f * outward)) cause = "it was multiplied by the radius";
    if (hit.normal == approx(normalize(on_ball))) cause = "that is normalize(hit): right only at the origin";
    CHECK_MESSAGE(hit.normal == approx(outward), cause);
    CHECK(hit.geometric_normal == approx(outward));
    CHECK(hit.position == approx(on_ball));
    CHECK_FALSE(hit.inside);
    CHECK(hit.material == 7);
}

TEST_CASE("seen from inside, the normal of a ball points to its centre") {
    const Hit hit = surface(ball, Ray{from_within.origin, from_within.direction, 0, 2});
    CHECK_MESSAGE(hit.normal == approx(-outward), "it must lie on the side that the ray comes from");
    CHECK(hit.geometric_normal == approx(-outward));
    CHECK_MESSAGE(hit.inside, "the ray came from within the ball");
    CHECK_MESSAGE(hit.uv == approx(sphere_uv(outward)), "the place on the map is the same from both sides");
}

TEST_CASE("the map of a ball has the south pole at v = 0 and the north pole at v = 1") {
    CHECK(sphere_uv({0, 1, 0}).y == approx(1));
    CHECK_MESSAGE(sphere_uv({0, -1, 0}).y == approx(0), "v flipped: the map hangs upside down");
    for (const float angle : {0.0f, 40.0f, 170.0f, 200.0f, 301.0f})
        CHECK(sphere_uv({std::cos(angle * degrees), 0, std::sin(angle * degrees)}).y == approx(0.5f));
    const vec3 north_30 = normalize(vec3(1, 1, std::sqrt(2.0f))); // 30 degrees north
    const float v = sphere_uv(north_30).y;
    CHECK_MESSAGE(v == approx(2.0f / 3),
                  hint(v, {{0.75f, "that grows with the height, not with the latitude"},
                           {1.0f / 3, "v is upside down"}}));
}

TEST_CASE("on the map of a ball u grows eastward, evenly") {
    for (const float latitude : {0.0f, -50.0f, 70.0f})
        for (int i = 0; i < 36; ++i) {
            const auto point = [&](float longitude) {
                const vec3 east(1, 0, 0), south_of_view(0, 0, -1);
                return std::cos(latitude * degrees) * (std::cos(longitude * degrees) * east +
                                                       std::sin(longitude * degrees) * south_of_view) +
                       vec3(0, std::sin(latitude * degrees), 0);
            };
            const float u = sphere_uv(point(10.0f * float(i))).x;
            const float step = sphere_uv(point(10.0f * float(i + 1))).x - u;
            INFO("latitude " << latitude << ", ten degrees east of " << 10 * i << ", u = " << u);
            CHECK(u >= 0);
            CHECK(u <= 1);
            CHECK_MESSAGE(step - std::floor(step) == approx(1.0f / 36),
                          hint(step, {{-1.0f / 36, "u grows westward: the writing on the globe is mirrored"},
                                      {1.0f / 72, "u covers half of [0, 1]"}}));
        }
}

TEST_CASE("east on the map of a ball is to the right of whoever looks at it with north up") {
    const Sphere globe{{2, 1, -4}, 1.5f, 0};
    const Camera camera = make_camera({.from = {6, 2, 3}, .at = globe.center, .fov = 20}, 100, 100);
    const auto uv = [&](vec2 pixel) {
        Ray ray = camera_ray(camera, pixel);
        const auto t = intersect(globe, ray);
        REQUIRE(t);
        ray.t_max = *t;
        return surface(globe, ray).uv;
    };
    CHECK_MESSAGE(uv({52, 50}).x > uv({48, 50}).x, "u grows to the left: the writing would be mirrored");
    CHECK_MESSAGE(uv({50, 48}).y > uv({50, 52}).y, "v grows downward: the map would hang upside down");
}

TEST_CASE("a pole that rounding has lifted above the ball still has a place on the map") {
    for (const vec3 p :
         {vec3(0, 1.0000001f, 0), vec3(0, -1.0000001f, 0), vec3(-1, 0, 0), vec3(-1, 0, -0.0f)}) {
        const vec2 uv = sphere_uv(p);
        INFO("at " << to_text(p) << " uv = " << to_text(uv));
        CHECK(uv.x >= 0);
        CHECK(uv.x <= 1);
        CHECK(uv.y >= 0);
        CHECK(uv.y <= 1);
    }
}

// --- hit.h ---

TEST_CASE("a hit turns both of its normals to the side that the ray comes from") {
    const vec3 true_normal = normalize(vec3(1, 2, -2));
    const vec3 smooth = normalize(vec3(1.5f, 2, -2));
    const Ray toward{{5, 5, 5}, {-1, -3, 0.5f}, 0, 2}; // against the normal
    const Hit front = make_hit(toward, true_normal, smooth, {0.3f, 0.6f}, 4);
    CHECK(front.normal == approx(smooth));
    CHECK(front.geometric_normal == approx(true_normal));
    CHECK_FALSE(front.inside);

    const Ray along{{5, 5, 5}, {1, 3, -0.5f}, 0, 2}; // with the normal: it comes from behind
    const Hit back = make_hit(along, true_normal, smooth, {0.3f, 0.6f}, 4);
    CHECK_MESSAGE(back.normal == approx(-smooth), "not turned: surfaces seen from behind will be black");
    CHECK_MESSAGE(back.geometric_normal == approx(-true_normal), "not turned: offsets will go the wrong way");
    CHECK_MESSAGE(back.inside, "d.n > 0 means that the ray leaves");
    for (const Hit& hit : {front, back}) {
        CHECK(hit.uv == approx(vec2(0.3f, 0.6f)));
        CHECK(hit.material == 4);
    }
}

TEST_CASE("the true surface says on which side a ray is, not the smooth normal") {
    const Hit hit =
        make_hit(Ray{{0, 0, 0}, {1, -0.1f, 0}, 0, 2}, {0, 1, 0}, normalize(vec3(0.4f, 1, 0)), {0, 0}, 0);
    CHECK_FALSE_MESSAGE(hit.inside, "at a grazing angle an interpolated normal may lean away from the ray");
    CHECK(hit.geometric_normal == approx(vec3(0, 1, 0)));
}

TEST_CASE("a hit lies at the end of its ray") {
    const Hit hit = make_hit(Ray{{1, 2, 3}, {-2, 0.5f, 4}, 0.5f, 3}, {0, 1, 0}, {0, 0}, 0);
    CHECK(hit.t == 3);
    CHECK(hit.position == approx(vec3(-5, 3.5f, 15)));
}

TEST_CASE("a hit knows how far its position may be off, near and far from the origin") {
    Random random(4);
    double worst = 0;
    for (int i = 0; i < 10000; ++i) {
        const float scale = std::pow(10.0f, -2 + 6 * random.uniform()); // 1 cm to 10 km
        const Sphere sphere{any_point(random, scale), scale * (0.1f + random.uniform()), 0};
        Ray ray{any_point(random, 3 * scale), any_direction(random)};
        const auto t = intersect(sphere, ray);
        if (!t) continue;
        ray.t_max = *t;
        const Hit hit = surface(sphere, ray);
        const double off =
            std::abs(length(dvec3(hit.position) - dvec3(sphere.center)) - double(sphere.radius));
        worst = std::max(worst, off / double(hit.error));
        if (!(hit.error > 0 && hit.error < 1e-4f * 3 * scale)) worst = infinity;
    }
    CHECK_MESSAGE(worst < 1, "as a share of hit.error (infinity: an error of 0, or one that can be seen)");
}

// --- plane.h ---

TEST_CASE("a ray meets an oblique plane where it crosses it") {
    const vec3 normal = vec3(2, 3, 6) / 7.0f;
    const Plane plane{{1, 1, 1}, normal, 3};
    // 7 metres above the plane, sinking 2 metres for each unit of t
    const Ray ray{plane.point + 7.0f * normal + 4.0f * beside(normal),
                  -2.0f * normal + 1.5f * beside(normal)};
    const float t = t_of(intersect(plane, ray));
    CHECK_MESSAGE(t == approx(3.5f), hint(t, {{-3.5f, "the sign of O - P"},
                                              {7, "that is the distance: divide by d.n"},
                                              {14, "multiplied by d.n where it should be divided"},
                                              {miss, "a miss: the sign of O - P"}}));
    CHECK_FALSE_MESSAGE(intersect(plane, Ray{ray.origin, -ray.direction}), "the plane lies behind");
    CHECK_FALSE_MESSAGE(intersect(plane, Ray{ray.origin, ray.direction, 0, 3}),
                        "the plane lies beyond t_max");
    CHECK_FALSE_MESSAGE(intersect(plane, Ray{ray.origin, ray.direction, 4}), "the plane lies before t_min");
}

TEST_CASE("a ray along a plane misses it") {
    const Plane floor{{0, 1, 0}, {0, 1, 0}, 0};
    CHECK_FALSE(intersect(floor, Ray{{0, 2, 0}, {3, 0, 1}}));
    CHECK_FALSE(intersect(floor, Ray{{0, 0, 0}, {3, 0, 1}}));
    CHECK_FALSE_MESSAGE(intersect(floor, Ray{{0, 1, 0}, {3, 0, 1}}),
                        "0/0 is NaN, which no interval contains");
}

TEST_CASE("a plane has two sides") {
    const Plane plane{{1, 1, 1}, vec3(2, 3, 6) / 7.0f, 3};
    const Hit above = surface(plane, Ray{plane.point + 3.0f * plane.normal, -plane.normal, 0, 3});
    CHECK(above.normal == approx(plane.normal));
    CHECK_FALSE(above.inside);
    CHECK(above.material == 3);
    const Ray upward{plane.point - 3.0f * plane.normal, plane.normal};
    CHECK(t_of(intersect(plane, upward)) == approx(3));
    const Hit below = surface(plane, Ray{upward.origin, upward.direction, 0, 3});
    CHECK(below.normal == approx(-plane.normal));
    CHECK(below.inside);
}

TEST_CASE("on a floor u runs along +x and v along -z, in metres") {
    const Plane floor{{2, -1, 3}, {0, 1, 0}, 0};
    const Hit hit = surface(floor, Ray{{4.5f, 1, 4}, {0, -0.5f, 0}, 0, 4}); // meets (4.5, -1, 4)
    CHECK_MESSAGE(hit.uv == approx(vec2(2.5f, -1)), "uv counts from plane.point");
}

TEST_CASE("on any plane the uv of two points are as far apart as the points") {
    Random random(5);
    for (int i = 0; i < 200; ++i) {
        const Plane plane{any_point(random, 3), any_direction(random), 0};
        const vec3 a = beside(plane.normal), b = cross(plane.normal, a);
        const auto uv = [&](float x, float y) {
            const vec3 point = plane.point + x * a + y * b;
            return surface(plane, Ray{point + 2.0f * plane.normal, -plane.normal, 0, 2}).uv;
        };
        INFO("normal " << to_text(plane.normal));
        CHECK(distance(uv(1, 2), uv(-2, 6)) == approx(5, 1e-4f));
        CHECK(distance(uv(0, 0), uv(3, 0)) == approx(3, 1e-4f));
    }
}

// --- diffuse.h ---

TEST_CASE("a matte surface sends back albedo / pi of what arrives") {
    const vec3 out = reflected(Diffuse{{0.8f, 0.4f, 0.5f}}, vec3(2, 3, pi));
    CHECK_MESSAGE(out == approx(vec3(1.6f / pi, 1.2f / pi, 0.5f)),
                  hint(out.z, {{0.5f * pi, "the 1/pi is missing: everything is three times too bright"},
                               {0.25f, "1/(2 pi) in place of 1/pi"},
                               {0, "nothing comes back"}}));
}

TEST_CASE("a flat surface has its own radiance, whatever light there is") {
    CHECK(reflected(flat({0.2f, 3, 0.7f}), vec3(0)) == approx(vec3(0.2f, 3, 0.7f)));
    CHECK(reflected(flat({0.2f, 3, 0.7f}), vec3(9)) == approx(vec3(0.2f, 3, 0.7f)));
    CHECK_MESSAGE(reflected(Diffuse{{0.8f, 0.4f, 0.5f}, {1, 2, 3}}, vec3(pi)) ==
                      approx(vec3(1.8f, 2.4f, 3.5f)),
                  "what a surface sends out by itself is added to what it reflects");
}

TEST_CASE("the squares of a checker alternate on both sides of zero") {
    const Checker checker{{0.8f, 0, 0}, {0, 0.3f, 0}, 0.5f};
    for (int row = -4; row < 4; ++row)
        for (int column = -4; column < 4; ++column) {
            const bool even = (row + column) % 2 == 0;
            for (const float inset : {0.02f, 0.25f, 0.48f}) {
                const vec2 uv = 0.5f * vec2(column, row) + vec2(inset, 0.5f - inset);
                INFO("square (" << column << ", " << row << ") at uv = " << to_text(uv));
                CHECK_MESSAGE(at(checker, uv).albedo == approx(even ? checker.even : checker.odd),
                              "a cast to int makes the two squares beside zero one: take floor");
            }
        }
}

// --- background.h ---

TEST_CASE("the sky changes evenly from nadir to zenith") {
    const Sky sky{{0.1f, 0.2f, 0.9f}, {0.7f, 0.4f, 0.1f}};
    CHECK(radiance(sky, {0, 3, 0}) == approx(sky.zenith));
    CHECK(radiance(sky, {0, -0.2f, 0}) == approx(sky.nadir));
    CHECK(radiance(sky, {5, 0, -2}) == approx(0.5f * (sky.nadir + sky.zenith)));
    const vec3 got = radiance(sky, {3, 3, std::sqrt(18.0f)}); // 30 degrees above the horizon, length 6
    CHECK_MESSAGE(got == approx(0.25f * sky.nadir + 0.75f * sky.zenith),
                  "halfway up by height: 1/4 nadir + 3/4 zenith, for a direction of any length");
}

TEST_CASE("what the whole sky sheds on a surface is the integral of its radiance times the cosine") {
    const Sky sky{{0.1f, 0.2f, 0.9f}, {0.7f, 1.4f, 0.1f}};
    for (const vec3 normal : {vec3(2, 3, 6) / 7.0f, vec3(6, -3, 2) / 7.0f, vec3(-2, -6, 3) / 7.0f,
                              vec3(0, 1, 0), vec3(0, -1, 0), vec3(1, 0, 0)}) {
        const vec3 a = beside(normal), b = cross(normal, a);
        dvec3 sum(0);
        const int rings = 200, sectors = 16;
        for (int i = 0; i < rings; ++i)
            for (int j = 0; j < sectors; ++j) {
                const float theta = (float(i) + 0.5f) / rings * pi / 2;
                const float phi = (float(j) + 0.5f) / sectors * 2 * pi;
                const vec3 w =
                    std::cos(theta) * normal + std::sin(theta) * (std::cos(phi) * a + std::sin(phi) * b);
                sum += dvec3(radiance(sky, w) * std::cos(theta) * std::sin(theta));
            }
        const vec3 expected = vec3(sum) * (pi / 2 / rings) * (2 * pi / sectors);
        INFO("normal " << to_text(normal));
        CHECK(irradiance(sky, normal) == approx(expected, 1e-4f));
    }
}

TEST_CASE("an even sky sheds pi times its radiance on every surface") {
    const Sky sky{{0.5f, 2, 0.25f}, {0.5f, 2, 0.25f}};
    for (const vec3 normal : {vec3(2, 3, 6) / 7.0f, vec3(-2, -6, 3) / 7.0f})
        CHECK(irradiance(sky, normal) == approx(pi * vec3(0.5f, 2, 0.25f)));
}

// --- scene.h ---

TEST_CASE("add answers the number of the material") {
    Scene scene;
    CHECK(add(scene, Diffuse{vec3(0.1f)}) == 0);
    CHECK(add(scene, Checker{vec3(0.1f), vec3(0.2f)}) == 1);
    CHECK(add(scene, flat(vec3(1))) == 2);
    REQUIRE(scene.materials.size() == 3);
    CHECK(std::holds_alternative<Checker>(scene.materials[1]));
}

TEST_CASE("in an empty scene a ray meets nothing") {
    CHECK_FALSE(intersect(Scene{}, Ray{{0, 0, 0}, {0, 0, -1}}));
}

TEST_CASE("of many shapes a ray meets the nearest, in whatever order they stand") {
    // Along the ray: a ball at t = 2, a plane at 3, balls at 4, 5 and 6. Each has its number for a material.
    const vec3 origin(3, 1, -2);
    const vec3 direction = 2.0f * vec3(2, -3, 6) / 7.0f;
    const auto place = [&](float t) { return origin + (t + 0.25f) * direction; }; // of a ball of radius .5
    std::vector<Sphere> balls{
        {place(2), 0.5f, 2}, {place(4), 0.5f, 4}, {place(5), 0.5f, 5}, {place(6), 0.5f, 6}};
    const Plane plane{origin + 3.0f * direction, normalize(vec3(1, -1, 3)), 3};
    std::vector<int> order{0, 1, 2, 3};
    do {
        Scene scene;
        for (const int i : order) scene.spheres.push_back(balls[std::size_t(i)]);
        scene.planes = {plane};
        const auto expect = [&](float t_min, float t_max, int material, float t) {
            const auto hit = intersect(scene, Ray{origin, direction, t_min, t_max});
            INFO("t in (" << t_min << ", " << t_max
                          << "), first ball in the list: " << scene.spheres[0].material);
            REQUIRE(hit);
            CHECK_MESSAGE(hit->material == material, "materials count the shapes along the ray");
            CHECK(hit->t == approx(t));
            CHECK(hit->position == approx(origin + t * direction));
        };
        expect(0, infinity, 2, 2);
        expect(2.1f, infinity, 2, 2.5f); // its far side
        expect(2.6f, infinity, 3, 3);
        expect(3.1f, infinity, 4, 4);
        expect(3.1f, 4.9f, 4, 4);
        expect(5.9f, 8, 6, 6);
        CHECK_FALSE(intersect(scene, Ray{origin, direction, 0, 1.9f}));
        CHECK_FALSE(intersect(scene, Ray{origin, direction, 6.6f}));
        CHECK_FALSE(intersect(scene, Ray{origin, direction, 2.6f, 2.9f}));
        CHECK_FALSE_MESSAGE(intersect(scene, Ray{origin, -direction}), "all of them lie behind");
    } while (std::next_permutation(order.begin(), order.end()));
}

TEST_CASE("a plane before and a ball behind it are told apart, and the other way round") {
    Scene scene;
    scene.planes = {{{0, 0, -6}, {0, 0, 1}, 1}, {{0, 0, -9}, {0, 0, 1}, 2}};
    scene.spheres = {{{0, 0, -5}, 0.5f, 3}, {{2, 0, -7.5f}, 0.5f, 4}};
    CHECK(intersect(scene, Ray{{0, 0, 0}, {0, 0, -3}})->material == 3);
    CHECK(intersect(scene, Ray{{2, 0, 0}, {0, 0, -3}})->material == 1);
    CHECK(intersect(scene, Ray{{2, 0, -6.5f}, {0, 0, -3}})->material == 4);
    CHECK(intersect(scene, Ray{{2, 0, -8.5f}, {0, 0, -3}})->material == 2);
    CHECK(intersect(scene, Ray{{2, 0, -8.5f}, {0, 0, 3}})->material == 4);
}

TEST_CASE("the nearest of a hundred balls is the one with the smallest t") {
    Random random(6);
    Scene scene;
    for (int i = 0; i < 100; ++i)
        scene.spheres.push_back({any_point(random, 3), 0.1f + 0.6f * random.uniform(), i});
    int wrong = 0, hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const Ray ray{any_point(random, 3), (0.3f + 2 * random.uniform()) * any_direction(random)};
        float smallest = infinity;
        int nearest = -1;
        for (const Sphere& sphere : scene.spheres)
            if (const auto t = intersect(sphere, ray); t && *t < smallest) {
                smallest = *t;
                nearest = sphere.material;
            }
        const auto hit = intersect(scene, ray);
        hits += nearest >= 0;
        wrong += (hit ? hit->material : -1) != nearest;
    }
    CHECK_MESSAGE(wrong == 0, wrong << " of 3000 rays met another ball, of " << hits << " that meet any");
    CHECK(hits > 1000);
}

// --- radiance.h ---

TEST_CASE("a ray that meets nothing sees the sky") {
    const Scene scene{.sky = {{0.1f, 0.2f, 0.9f}, {0.7f, 0.4f, 0.1f}}};
    const vec3 direction = 3.0f * vec3(2, 3, -6) / 7.0f;
    CHECK(radiance(scene, Ray{{1, 2, 3}, direction}) == approx(radiance(scene.sky, direction)));
}

TEST_CASE("a white matte ball vanishes in an even sky") {
    Scene scene{.sky = {vec3(0.5f, 2, 0.25f), vec3(0.5f, 2, 0.25f)}};
    scene.spheres = {{{1, -2, 3}, 2, add(scene, Diffuse{vec3(1)})}};
    CHECK_MESSAGE(radiance(scene, to_ball) == approx(vec3(0.5f, 2, 0.25f)),
                  "what comes in goes out, not more");
    CHECK(radiance(scene, from_within) == approx(vec3(0.5f, 2, 0.25f)));
}

TEST_CASE("a matte ball shows albedo / pi of what the sky sheds on the side that is seen") {
    Scene scene{.sky = {{0.1f, 0.2f, 0.9f}, {0.7f, 0.4f, 0.1f}}};
    const vec3 albedo(0.8f, 0.4f, 0.5f);
    scene.spheres = {{{1, -2, 3}, 2, add(scene, Diffuse{albedo})}};
    const vec3 seen = radiance(scene, to_ball);
    CHECK(seen == approx(albedo * mix(scene.sky.nadir, scene.sky.zenith, 0.5f + outward.y / 3)));
    const vec3 within = radiance(scene, from_within);
    CHECK_MESSAGE(within == approx(albedo * mix(scene.sky.nadir, scene.sky.zenith, 0.5f - outward.y / 3)),
                  "from inside, the normal is turned round");
}

TEST_CASE("a checker floor shows the colour of the square that is met") {
    Scene scene{.sky = {vec3(1), vec3(1)}};
    scene.planes = {
        {{0, -1, 0}, {0, 1, 0}, add(scene, Checker{{0.8f, 0.2f, 0.1f}, {0.1f, 0.4f, 0.3f}, 0.5f})}};
    const auto seen = [&](float x, float z) { return radiance(scene, Ray{{x, 3, z}, {0, -2, 0}}); };
    CHECK(seen(0.2f, -0.3f) == approx(vec3(0.8f, 0.2f, 0.1f)));
    CHECK(seen(0.7f, -0.3f) == approx(vec3(0.1f, 0.4f, 0.3f)));
    CHECK(seen(-0.2f, -0.3f) == approx(vec3(0.1f, 0.4f, 0.3f)));
    CHECK(seen(-0.2f, 0.3f) == approx(vec3(0.8f, 0.2f, 0.1f)));
}

TEST_CASE("a ball hides what is behind it and takes its own material") {
    Scene scene;
    scene.spheres = {{{0, 0, -9}, 3, add(scene, flat({1, 0, 0}))},
                     {{0, 0, -3}, 1, add(scene, flat({0, 1, 0}))}};
    CHECK(radiance(scene, Ray{{0, 0, 0}, {0, 0, -2}}) == approx(vec3(0, 1, 0)));
    CHECK(radiance(scene, Ray{{0, 0, 0}, {0, 1.2f, -4.8f}}) == approx(vec3(0, 1, 0)));
    CHECK(radiance(scene, Ray{{0, 0, -5}, {0, 0, -2}}) == approx(vec3(1, 0, 0)));
}

namespace {
/// A scene of another make: two walls and no list of shapes.
struct Corridor {
    Sky sky{vec3(1), vec3(1)};
    std::vector<Material> materials{Diffuse{vec3(0.25f)}};
};
std::optional<Hit> intersect(const Corridor&, Ray ray) {
    ray.t_max = (ray.direction.x > 0 ? 1 - ray.origin.x : -1 - ray.origin.x) / ray.direction.x;
    return make_hit(ray, {ray.direction.x > 0 ? -1.0f : 1.0f, 0, 0}, {0, 0}, 0);
}
} // namespace

TEST_CASE("light travels in any scene that can say what a ray meets first") {
    CHECK(radiance(Corridor{}, Ray{{0, 0, 0}, {2, 1, 0}}) == approx(vec3(0.25f)));
}

// --- camera.h ---

TEST_CASE("the centre ray of an even picture goes exactly along -z") {
    const Camera camera = make_camera({}, 200, 100);
    const Ray ray = camera_ray(camera, {100, 50});
    CHECK_MESSAGE(ray.direction == vec3(0, 0, -1),
                  "(0, 0, 1): +z was taken as forward. A little off: the picture "
                  "reaches from pixel 0 to pixel 200, its middle is 100");
    CHECK(ray.origin == vec3(0, 0, 0));
    CHECK(ray.t_min == 0);
    CHECK(ray.t_max == infinity);
}

TEST_CASE("at a field of view of 90 degrees the top ray leaves at 45 degrees") {
    const vec3 top = camera_ray(make_camera({.fov = 90}, 200, 100), {100, 0}).direction;
    const float slope = top.y / -top.z;
    CHECK_MESSAGE(
        slope == approx(1),
        hint(slope, {{-1, "the picture is upside down"},
                     {1.6197752f, "tan(45): the angle in degrees was taken for radians"},
                     {-1.9952004f, "tan(90): the angle in degrees was taken for radians, and not halved"},
                     {0.5f, "the field of view is vertical: the aspect belongs to the width"},
                     {2, "the field of view is vertical: the aspect belongs to the width"}}));
    CHECK(camera_ray(make_camera({.fov = 90}, 200, 100), {100, 100}).direction.y / -top.z == approx(-1));
}

TEST_CASE("the edge of a picture twice as wide as high has twice the slope") {
    const vec3 right = camera_ray(make_camera({.fov = 90}, 200, 100), {200, 50}).direction;
    const float slope = right.x / -right.z;
    CHECK_MESSAGE(slope == approx(2), hint(slope, {{1, "the aspect was ignored: balls become ellipses"},
                                                   {0.5f, "the aspect is inverted: height / width"},
                                                   {-2, "the picture is mirrored"}}));
    const vec3 narrow = camera_ray(make_camera({.fov = 90}, 100, 200), {100, 100}).direction;
    CHECK_MESSAGE(narrow.x / -narrow.z == approx(0.5f),
                  "in a tall picture, too, the field of view is vertical");
}

TEST_CASE("the field of view is the angle from the lower to the upper edge") {
    for (const float fov : {10.0f, 40.0f, 120.0f, 170.0f}) {
        const Camera camera = make_camera({.fov = fov}, 300, 200);
        const vec3 top = camera_ray(camera, {150, 0}).direction;
        const vec3 bottom = camera_ray(camera, {150, 200}).direction;
        INFO("fov " << fov);
        CHECK(std::acos(dot(top, bottom)) / degrees == approx(fov, 1e-4f));
        const vec3 right = camera_ray(camera, {300, 100}).direction;
        CHECK_MESSAGE(right.x / -right.z == approx(1.5f * std::tan(fov / 2 * degrees)), "pixels are square");
    }
}

TEST_CASE("pixel (0, 0) is the top left corner of the picture") {
    const Camera camera = make_camera({}, 40, 30);
    const vec3 first = camera_ray(camera, {0.5f, 0.5f}).direction;
    CHECK_MESSAGE(first.x < 0, "the picture is mirrored");
    CHECK_MESSAGE(first.y > 0, "the picture is upside down");
    const vec3 last = camera_ray(camera, {39.5f, 29.5f}).direction;
    CHECK_MESSAGE(last == approx(vec3(-first.x, -first.y, first.z)),
                  "the picture is symmetric about its middle");
}

TEST_CASE("the points of a picture lie evenly on a flat screen") {
    const Camera camera = make_camera({.fov = 100}, 40, 30);
    const auto on_screen = [&](float x, float y) {
        const vec3 d = camera_ray(camera, {x, y}).direction;
        return vec2(d.x, d.y) / -d.z;
    };
    const vec2 step = on_screen(21, 16) - on_screen(20, 15);
    CHECK_MESSAGE(on_screen(37, 3) == approx(vec2(17, -12) * step, 1e-4f),
                  "equal angles are not equal pixels");
    CHECK(step.x == approx(-step.y));
}

TEST_CASE("every ray of the camera has unit length and starts at the camera") {
    const Camera camera = make_camera({{4, 3, 2}, {1, 1, -1}, {0.4f, 3, 0.1f}, 75}, 64, 48);
    for (const vec2 pixel : {vec2(0, 0), vec2(64, 48), vec2(10.3f, 40), vec2(32, 24)}) {
        const Ray ray = camera_ray(camera, pixel);
        CHECK_MESSAGE(length(ray.direction) == approx(1), "the direction was not normalised");
        CHECK(ray.origin == vec3(4, 3, 2));
    }
}

TEST_CASE("an oblique camera looks at its point, with what is up in the upper half") {
    const Pose pose{{4, 3, 2}, {1, 1, -1}, {0.4f, 1, 0.1f}, 50};
    const Camera camera = make_camera(pose, 60, 40);
    const vec3 forward = normalize(pose.at - pose.from);
    const vec3 centre = camera_ray(camera, {30, 20}).direction;
    const vec3 top = camera_ray(camera, {30, 0}).direction;
    const vec3 bottom = camera_ray(camera, {30, 40}).direction;
    const vec3 left = camera_ray(camera, {0, 20}).direction;
    const vec3 right = camera_ray(camera, {60, 20}).direction;
    CHECK_MESSAGE(centre == approx(forward), "the middle of the picture shows pose.at");
    const vec3 side = cross(forward, pose.up);
    CHECK_MESSAGE(dot(top, side) == approx(0), "the middle column lies in the plane of `forward` and `up`");
    CHECK_MESSAGE(dot(bottom, side) == approx(0),
                  "the middle column lies in the plane of `forward` and `up`");
    CHECK_MESSAGE(dot(top, pose.up) > dot(centre, pose.up), "the picture is upside down");
    CHECK_MESSAGE(dot(right, side) > 0, "the picture is mirrored");
    CHECK(dot(left, side) == approx(-dot(right, side)));
    CHECK_MESSAGE(dot(top - bottom, right - left) == approx(0), "rows and columns are at right angles");
    CHECK_MESSAGE(dot(top, bottom) == approx(std::cos(50 * degrees)), "the field of view is 50 degrees");
    CHECK_MESSAGE(dot(right, forward) == approx(std::cos(std::atan(1.5f * std::tan(25 * degrees)))),
                  "`right` must have unit length even where `up` is oblique or long");
}

TEST_CASE("neither the distance to the point nor the length of up changes the picture") {
    const Camera one = make_camera({{4, 3, 2}, {1, 1, -1}, {0.4f, 1, 0.1f}, 50}, 60, 40);
    const Camera other = make_camera({{4, 3, 2}, {-2, -1, -4}, {2, 5, 0.5f}, 50}, 60, 40);
    for (const vec2 pixel : {vec2(0, 0), vec2(60, 0), vec2(13, 37)})
        CHECK(camera_ray(one, pixel).direction == approx(camera_ray(other, pixel).direction));
}

TEST_CASE("the first sample of a pixel is its middle, and the others spread evenly over it") {
    CHECK(in_pixel(0) == vec2(0.5f));
    int count[4][4] = {};
    bool within = true;
    std::set<std::pair<float, float>> different;
    for (int i = 0; i < 1600; ++i) {
        const vec2 p = in_pixel(i);
        within = within && p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1;
        if (!within) break;
        ++count[int(4 * p.x)][int(4 * p.y)];
        different.insert({p.x, p.y});
    }
    REQUIRE_MESSAGE(within, "a sample lies outside of its pixel");
    CHECK(different.size() == 1600);
    for (const auto& row : count)
        for (const int samples : row)
            CHECK_MESSAGE(std::abs(samples - 100) <= 20,
                          "of 1600 samples each sixteenth of a pixel gets about 100");
}

namespace {
/// The pose that these words of a command line ask for.
Pose typed(std::vector<const char*> words, const Pose& initial, const Pose* other = nullptr) {
    Options options("01_test", "Where does the camera stand?", {});
    const CameraKnobs knobs(options, initial);
    words.insert(words.begin(), "01_test");
    options.parse(int(words.size()), words.data());
    return other ? knobs.pose(*other) : knobs.pose();
}
} // namespace

TEST_CASE("the knobs move the camera, and what is not typed stays") {
    const Pose initial{{1, 2, 3}, {0, 1, 0}, {0, 1, 0.5f}, 30};
    const Pose plain = typed({}, initial);
    CHECK(plain.from == initial.from);
    CHECK(plain.at == initial.at);
    CHECK(plain.up == initial.up);
    CHECK(plain.fov == 30);
    const Pose moved = typed({"--from", "4,5,-6", "--fov", "70"}, initial);
    CHECK(moved.from == vec3(4, 5, -6));
    CHECK(moved.at == initial.at);
    CHECK(moved.up == initial.up);
    CHECK(moved.fov == 70);
    const Pose turned = typed({"--at", "7,8,9", "--up", "1,0,0"}, initial);
    CHECK(turned.from == initial.from);
    CHECK(turned.at == vec3(7, 8, 9));
    CHECK(turned.up == vec3(1, 0, 0));
}

TEST_CASE("a pose that a scene proposes gives way to what is typed") {
    const Pose initial{{1, 2, 3}, {0, 1, 0}, {0, 1, 0}, 30}, scene{{9, 9, 9}, {8, 7, 6}, {1, 0, 0}, 55};
    const Pose pose = typed({"--at", "0,0,1", "--fov", "30"}, initial, &scene);
    CHECK(pose.from == scene.from);
    CHECK(pose.at == vec3(0, 0, 1));
    CHECK(pose.up == scene.up);
    CHECK_MESSAGE(pose.fov == 30, "it was typed, though it is the default");
}

TEST_CASE("a camera that cannot stand like that is refused") {
    const Pose initial{{1, 2, 3}, {0, 1, 0}, {0, 1, 0}, 30};
    CHECK_THROWS_AS(typed({"--from", "0,1,0"}, initial), Error); // from = at
    CHECK_THROWS_AS(typed({"--up", "0,0,0"}, initial), Error);   // no up
    CHECK_THROWS_AS(typed({"--up", "2,2,6"}, initial), Error);   // along the line of sight
    CHECK_THROWS_AS(typed({"--from", "0,9,0"}, initial), Error); // straight above
    CHECK_THROWS_AS(typed({"--up", "0,0,0"}, initial, &initial), Error);
    CHECK_NOTHROW(typed({"--up", "0,0.001,0"}, initial)); // short, but no less a direction
    std::string message;
    try {
        typed({"--from", "0,1,0"}, initial);
    } catch (const Error& error) {
        message = error.what();
    }
    CHECK_MESSAGE(message.find("--up") == std::string::npos,
                  "up is not to blame where --from is --at: ", message);
}

// --- view.h ---

namespace {
/// Balls one behind the other: `ball`, and a smaller one beyond it.
Scene two_balls() {
    Scene scene;
    scene.spheres = {{{1, -2, 3}, 2, 7}, {vec3(1, -2, 3) - 5.0f * outward, 1, 8}};
    return scene;
}
const Ray through_both{ball.center + 6.0f * outward, -2.0f * outward}; // meets `ball` after 4 metres
} // namespace

TEST_CASE("the normal view shows the normal as a colour") {
    CHECK(what_is_hit(two_balls(), through_both, View::normal, 1) == approx(0.5f + 0.5f * outward));
}

TEST_CASE("the depth view grows with the distance in metres, mid grey at the stated distance") {
    CHECK_MESSAGE(what_is_hit(two_balls(), through_both, View::depth, 4) == approx(vec3(0.5f)),
                  "the direction has length 2: t = 2 are 4 metres");
    CHECK(what_is_hit(two_balls(), through_both, View::depth, 12) == approx(vec3(0.25f)));
}

TEST_CASE("the uv view shows the place on the surface") {
    const vec2 uv = sphere_uv(outward);
    CHECK(what_is_hit(two_balls(), through_both, View::uv, 1) == approx(vec3(uv, 0)));
    Scene floor;
    floor.planes = {{{0, 0, 0}, {0, 1, 0}, 0}};
    CHECK_MESSAGE(what_is_hit(floor, Ray{{3.25f, 2, 4.5f}, {0, -1, 0}}, View::uv, 1) ==
                      approx(vec3(0.25f, 0.5f, 0)),
                  "it repeats every metre, on the negative side too");
}

TEST_CASE("the material view gives every material a colour of its own") {
    const vec3 near = what_is_hit(two_balls(), through_both, View::material, 1);
    CHECK(near == colour_of(7));
    std::vector<vec3> colours;
    for (int i = 0; i < 12; ++i) {
        const vec3 colour = colour_of(i);
        for (const float part : {colour.x, colour.y, colour.z}) CHECK((part >= 0 && part <= 1));
        for (const vec3 other : colours) CHECK(distance(colour, other) > 0.05f);
        colours.push_back(colour);
    }
}

TEST_CASE("the hits view counts the surfaces along the ray") {
    const auto hits = [](const Scene& scene, const Ray& ray) {
        return 8.0f * what_is_hit(scene, ray, View::hits, 1);
    };
    CHECK_MESSAGE(hits(two_balls(), through_both) == approx(vec3(4)), "in and out of two balls");
    CHECK(hits(two_balls(), Ray{ball.center, -0.3f * outward}) == approx(vec3(3)));
    CHECK(hits(two_balls(), Ray{ball.center, outward}) == approx(vec3(1)));
    CHECK(hits(two_balls(), Ray{through_both.origin, -through_both.direction}) == approx(vec3(0)));
    Scene row;
    for (int i = 0; i < 9; ++i) row.spheres.push_back({{0, 0, -3.0f * float(i + 1)}, 1, 0});
    CHECK_MESSAGE(hits(row, Ray{{0, 0, 0}, {0, 0, -1}}) == approx(vec3(8)), "it counts up to eight");
    CHECK(surfaces_crossed(row, Ray{{0, 0, 0}, {0, 0, -1}}, 100) == 18);
    CHECK(surfaces_crossed(row, Ray{{0, 0, 0}, {0, 0, -1}, 0, 6.5f}, 100) == 3);
}

TEST_CASE("a view is black where a ray meets nothing") {
    for (const View view : {View::normal, View::depth, View::uv, View::material, View::hits})
        CHECK(what_is_hit(Scene{}, Ray{{0, 0, 0}, {0, 0, -1}}, view, 1) == vec3(0));
}

TEST_CASE("--view names what is shown, and light is the default") {
    const auto chosen = [](std::vector<const char*> words) {
        Options options("01_test", "What does a ray see first?", {});
        const auto view = view_knob(options);
        words.insert(words.begin(), "01_test");
        options.parse(int(words.size()), words.data());
        return View(view);
    };
    CHECK(chosen({}) == View::light);
    CHECK(chosen({"--view", "normal"}) == View::normal);
    CHECK(chosen({"--view", "depth"}) == View::depth);
    CHECK(chosen({"--view", "uv"}) == View::uv);
    CHECK(chosen({"--view", "material"}) == View::material);
    CHECK(chosen({"--view", "hits"}) == View::hits);
}
