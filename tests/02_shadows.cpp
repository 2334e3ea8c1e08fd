// Facts about the second step: what a point light sheds, what stands in its way, how a ray leaves a surface.
#include "tests/check.h"

#include "02_shadows/light.h"
#include "02_shadows/offset.h"
#include "02_shadows/radiance.h"
#include "02_shadows/scene.h"
#include "common/random.h"

#include <algorithm>
#include <utility>
#include <vector>

using namespace rt;

namespace {

/// What a wrong value usually means: the first of `causes` whose value came.
std::string hint(float got, const std::vector<std::pair<float, std::string>>& causes) {
    for (const auto& [value, cause] : causes)
        if (got == approx(value, 1e-3f) || (std::isnan(got) && std::isnan(value)))
            return "got " + to_text(got) + ": " + cause;
    return "got " + to_text(got);
}

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

/// The hit on a surface at `point` with this normal, for a ray that comes from above it, a little aslant.
Hit hit_at(vec3 point, vec3 normal) {
    const vec3 direction = -2.0f * normal + 0.3f * beside(normal);
    return make_hit(Ray{point - direction, direction, 0, 1}, normal, {0, 0}, 0);
}

/// Oblique: no vector of it lies along an axis.
const vec3 tilted = vec3(2, 3, 6) / 7.0f;
const vec3 somewhere(1, -2, 3);

/// A scene of nothing but `lights` and `balls` of matte grey.
Scene lit_balls(std::vector<PointLight> lights, std::vector<Sphere> balls) {
    Scene scene;
    add(scene, Diffuse{vec3(0.5f)});
    scene.lights = std::move(lights);
    scene.spheres = std::move(balls);
    return scene;
}

} // namespace

// --- light.h ---

TEST_CASE("straight below a light of pi W/sr, at 2 metres, the irradiance is pi / 4") {
    const PointLight light{somewhere + 2.0f * tilted, vec3(pi)};
    const float e = irradiance(light, somewhere, tilted).x;
    CHECK_MESSAGE(
        e == approx(pi / 4),
        hint(e, {{pi, "no falloff: I cos / r^2 was asked for"},
                 {pi / 2, "divided by r, not by r^2, or the cosine is not one: the vector to the light "
                          "was not normalised"},
                 {pi / 8, "divided by r^3"},
                 {pi / 16, "divided by r^4"},
                 {0.0625f, "divided by 4 pi r^2: intensity is W/sr, not W"},
                 {0, "the cosine with the direction from the light, or with -n"}}));
}

TEST_CASE("where the light comes in at 45 degrees, on the same floor, it is pi / 8 times the cosine") {
    const PointLight light{somewhere + 2.0f * tilted, vec3(pi)};
    const float e = irradiance(light, somewhere + 2.0f * beside(tilted), tilted).x;
    CHECK_MESSAGE(e == approx(pi / 8 * 0.70710678f),
                  hint(e, {{pi / 8, "the cosine is missing"},
                           {pi / 4, "the vector to the light was not normalised, or no falloff"},
                           {pi / 4 * 0.70710678f, "the height was squared, not the distance"},
                           {pi / 16, "the cosine is squared"},
                           {pi * 0.70710678f, "no falloff"}}));
}

TEST_CASE("twice as far from a light there is a quarter of it") {
    const PointLight light{somewhere, {3, 2, 1}};
    const vec3 way = vec3(6, -2, 3) / 7.0f;
    const vec3 near = irradiance(light, somewhere - 1.5f * way, tilted);
    const vec3 far = irradiance(light, somewhere - 3.0f * way, tilted);
    const float ratio = near.x / far.x;
    CHECK_MESSAGE(ratio == approx(4),
                  hint(ratio, {{1, "no falloff, or the vector to the light was not normalised"},
                               {2, "divided by r, not by r^2"},
                               {8, "divided by r^3"},
                               {16, "divided by r^4"}}));
}

TEST_CASE("each colour of a light has its own intensity") {
    const PointLight light{somewhere + 2.0f * tilted, {4, 0.8f, 20}};
    CHECK(irradiance(light, somewhere, tilted) == approx(vec3(1, 0.2f, 5)));
}

TEST_CASE("a light behind a surface sheds nothing on it") {
    const PointLight light{somewhere + 2.0f * tilted, vec3(pi)};
    const vec3 e = irradiance(light, somewhere, -tilted);
    CHECK_MESSAGE(e == vec3(0), hint(e.x, {{-pi / 4, "a cosine below 0 takes light away: use max(cosine, 0)"},
                                           {pi / 4, "the cosine was made positive: its absolute value"}}));
    CHECK(irradiance(light, somewhere + 5.0f * beside(tilted), -tilted) == vec3(0));
}

TEST_CASE("a light on a cone around the normal sheds the same from every side") {
    for (int i = 0; i < 12; ++i) {
        const float angle = float(i) * pi / 6;
        const vec3 a = beside(tilted), b = cross(tilted, a);
        const vec3 way = 0.6f * tilted + 0.8f * (std::cos(angle) * a + std::sin(angle) * b);
        CHECK(irradiance(PointLight{somewhere + 2.5f * way, vec3(5)}, somewhere, tilted) ==
              approx(vec3(0.48f)));
    }
}

TEST_CASE("a floor of albedo .5 under that light shows a radiance of .125") {
    Scene scene;
    scene.planes = {{somewhere, tilted, add(scene, Diffuse{vec3(0.5f, 0.8f, 0.4f)})}};
    scene.lights = {{somewhere + 2.0f * tilted, vec3(pi)}};
    const vec3 aslant = -2.0f * tilted + 1.5f * beside(tilted);
    const vec3 seen = radiance(scene, Ray{somewhere - 0.7f * aslant, aslant});
    CHECK_MESSAGE(seen == approx(vec3(0.125f, 0.2f, 0.1f)),
                  hint(seen.x, {{0.125f * pi, "the 1/pi of Lambert's law is missing"},
                                {0.5f, "no falloff"},
                                {0.25f, "divided by r, or the vector to the light was not normalised"},
                                {0, "black: the floor shadows itself, or the shadow test is inverted"}}));
}

TEST_CASE("matte surfaces look equally bright from everywhere") {
    Scene scene;
    scene.planes = {{somewhere, tilted, add(scene, Diffuse{vec3(0.5f)})}};
    scene.lights = {{somewhere + 2.0f * tilted + 1.0f * beside(tilted), vec3(7)}};
    const vec3 straight = radiance(scene, Ray{somewhere + tilted, -tilted});
    const vec3 grazing = 0.1f * tilted + 3.0f * beside(tilted);
    CHECK(radiance(scene, Ray{somewhere + grazing, -2.0f * grazing}) == approx(straight));
}

TEST_CASE("a floor that is seen from below is lit by the lights below it alone") {
    Scene scene;
    scene.planes = {{somewhere, tilted, add(scene, Diffuse{vec3(0.5f)})}};
    const PointLight above{somewhere + 2.0f * tilted, vec3(pi)},
        below{somewhere - 2.0f * tilted, vec3(3 * pi)};
    const Ray from_above{somewhere + tilted, -0.5f * tilted}, from_below{somewhere - tilted, 0.5f * tilted};
    scene.lights = {above, below};
    CHECK(radiance(scene, from_above) == approx(vec3(0.125f)));
    CHECK(radiance(scene, from_below) == approx(vec3(0.375f)));
}

// --- offset.h ---

TEST_CASE("a new ray starts beside the surface, on the side that it goes to") {
    const Hit hit = hit_at(somewhere, tilted);
    const vec3 out = 3.0f * tilted + 2.0f * beside(tilted);
    const vec3 outside = offset_position(hit, out) - hit.position;
    const vec3 inside = offset_position(hit, -out) - hit.position;
    CHECK_MESSAGE(dot(outside, tilted) > 0,
                  "the wrong side, or no offset at all: shadow acne, salt and pepper");
    CHECK_MESSAGE(dot(inside, tilted) < 0, "a ray that goes through the surface must start behind it");
    CHECK_MESSAGE(length(outside) < 1e-3f, "so far off the surface that shadows detach from what casts them");
    CHECK_MESSAGE(length(outside) >= 0.9f * hit.error, "less than the error that the position may have");
    CHECK_MESSAGE(length(cross(outside, tilted)) < 1e-6f, "along the normal, not along the ray");
}

TEST_CASE("the offset is along the true surface's normal, not along the interpolated one") {
    const vec3 smooth = normalize(tilted + 0.8f * beside(tilted));
    const vec3 down = -2.0f * tilted;
    const Hit hit = make_hit(Ray{somewhere - down, down, 0, 1}, tilted, smooth, {0, 0}, 0);
    const vec3 step = offset_position(hit, tilted - 2.0f * beside(tilted)) - hit.position;
    CHECK_MESSAGE(dot(step, tilted) > 0, "the direction leaves the true surface, though not the smooth one");
    CHECK(length(cross(step, tilted)) < 0.1f * length(step));
}

TEST_CASE("the offset grows with the coordinates, as their rounding does") {
    const float near = length(offset_position(hit_at({1, 0, 0}, tilted), tilted) - vec3(1, 0, 0));
    const float far = length(offset_position(hit_at({1000, 0, 0}, tilted), tilted) - vec3(1000, 0, 0));
    CHECK_MESSAGE(far > 100 * near, "near the origin " << near << ", at 1000 metres " << far);
    CHECK_MESSAGE(far > 1000 * 0x1p-23f, "less than the rounding of the position");
    CHECK_MESSAGE(far < 0.1f, "it can be seen");
}

TEST_CASE("a ray from a hit goes on for ever in its direction") {
    const Hit hit = hit_at(somewhere, tilted);
    const Ray ray = ray_from(hit, {3, -1, 2});
    CHECK(ray.direction == vec3(3, -1, 2));
    CHECK(ray.t_max == infinity);
    CHECK(distance(ray.origin, somewhere) < 1e-3f);
}

TEST_CASE("a segment ends at its target") {
    const Hit hit = hit_at(somewhere, tilted);
    const vec3 target = somewhere + 5.0f * tilted + 2.0f * beside(tilted);
    const Ray segment = segment_to(hit, target);
    CHECK_MESSAGE(at(segment, segment.t_max) == approx(target),
                  "t_max = 1 belongs to a direction that is the whole way, t_max = r to one of unit length");
    CHECK_MESSAGE(distance(at(segment, segment.t_min), somewhere) < 1e-3f, "it starts at the hit");
}

// --- shadows: what hides what ---

TEST_CASE("a ball between a point and a light hides all of it") {
    const vec3 way = normalize(tilted + 0.5f * beside(tilted));
    const Hit hit = hit_at(somewhere, tilted);
    const PointLight light{somewhere + 5.0f * way, vec3(10)};
    const vec3 free = irradiance(light, somewhere, tilted);
    CHECK_MESSAGE(direct_light(lit_balls({light}, {}), hit) == approx(free), "nothing stands in the way");
    for (const float where : {0.7f, 2.0f, 4.4f}) { // metres from the point, on the way to the light
        const Scene scene = lit_balls({light}, {{somewhere + where * way, 0.5f, 0}});
        INFO("the ball is " << where << " metres away, the light 5");
        CHECK_MESSAGE(
            direct_light(scene, hit) == vec3(0),
            "lit: the shadow ray is missing, reversed, or ends too soon (t_max = 1 with a unit direction)");
    }
}

TEST_CASE("a ball beyond the light casts no shadow") {
    const vec3 way = normalize(tilted + 0.5f * beside(tilted));
    const Hit hit = hit_at(somewhere, tilted);
    const PointLight light{somewhere + 5.0f * way, vec3(10)};
    for (const float where : {5.6f, 8.0f, 25.0f}) {
        const Scene scene = lit_balls({light}, {{somewhere + where * way, 0.5f, 0}});
        INFO("the ball is " << where << " metres away, the light 5");
        CHECK_MESSAGE(direct_light(scene, hit) == approx(irradiance(light, somewhere, tilted)),
                      "a shadow ray is a segment: it ends at the light");
    }
}

TEST_CASE("a light within a metre is no further than it is") {
    // With the direction as the whole way t_max is 1: t_max = r would be r times too far or too short.
    const Hit hit = hit_at(somewhere, tilted);
    const PointLight light{somewhere + 0.4f * tilted, vec3(1)};
    CHECK(direct_light(lit_balls({light}, {{somewhere + 0.2f * tilted, 0.05f, 0}}), hit) == vec3(0));
    CHECK(direct_light(lit_balls({light}, {{somewhere + 0.6f * tilted, 0.05f, 0}}), hit) ==
          approx(irradiance(light, somewhere, tilted)));
}

TEST_CASE("a ball on the other side of the point casts no shadow on it") {
    const Hit hit = hit_at(somewhere, tilted);
    const PointLight light{somewhere + 3.0f * tilted, vec3(10)};
    const Scene behind = lit_balls({light}, {{somewhere - 1.5f * tilted, 1, 0}});
    CHECK_MESSAGE(direct_light(behind, hit) == approx(irradiance(light, somewhere, tilted)),
                  "the shadow ray goes the wrong way");
    const Scene aside = lit_balls({light}, {{somewhere + 1.5f * tilted + 1.1f * beside(tilted), 1, 0}});
    CHECK(direct_light(aside, hit) == approx(irradiance(light, somewhere, tilted)));
}

TEST_CASE("a lamp within a ball lights its inner side and nothing outside") {
    Scene scene = lit_balls({{somewhere + 0.5f * tilted, vec3(4)}}, {{somewhere, 2, 0}});
    const vec3 within =
        radiance(scene, Ray{somewhere, 0.5f * tilted}); // the wall at 1.5 metres from the lamp
    CHECK_MESSAGE(within == approx(vec3(0.5f / pi * 4 / 2.25f)), "the normal is turned to the ray's side");
    CHECK(radiance(scene, Ray{somewhere + 5.0f * tilted, -tilted}) == vec3(0));
}

TEST_CASE("a wall hides the light behind it") {
    Scene scene = lit_balls({{somewhere + 3.0f * tilted, vec3(10)}}, {});
    scene.planes = {{somewhere + 2.0f * tilted, normalize(tilted + 0.4f * beside(tilted)), 0}};
    const Hit hit = make_hit(Ray{somewhere + tilted, -tilted, 0, 1}, tilted, {0, 0}, 0);
    CHECK(direct_light(scene, hit) == vec3(0));
    scene.planes[0].point = somewhere + 4.5f * tilted;
    CHECK_MESSAGE(direct_light(scene, hit) == approx(vec3(10.0f / 9)), "the wall stands beyond the light");
}

TEST_CASE("each light has its own shadow") {
    const Hit hit = hit_at(somewhere, tilted);
    const vec3 left = normalize(tilted - beside(tilted)), right = normalize(tilted + beside(tilted));
    const PointLight red{somewhere + 4.0f * left, {8, 0, 0}}, blue{somewhere + 4.0f * right, {0, 0, 8}};
    const float share = 0.5f * 0.70710678f; // 8 / 16, at 45 degrees
    CHECK(direct_light(lit_balls({red, blue}, {}), hit) == approx(vec3(share, 0, share)));
    CHECK(direct_light(lit_balls({red, blue}, {{somewhere + 2.0f * left, 0.5f, 0}}), hit) ==
          approx(vec3(0, 0, share)));
    CHECK(direct_light(lit_balls({red, blue}, {{somewhere + 2.0f * right, 0.5f, 0}}), hit) ==
          approx(vec3(share, 0, 0)));
}

TEST_CASE("the umbra under a ball has the radius H tan(asin(a / (H - h)))") {
    const float a = 0.5f, h = 1.2f, H = 3.4f; // radius of the ball, height of its centre, height of the light
    Scene scene;
    const vec3 foot(2, -1, -3); // on the floor, below both
    scene.planes = {{foot, {0, 1, 0}, add(scene, Diffuse{vec3(0.5f)})}};
    scene.spheres = {{foot + vec3(0, h, 0), a, 0}};
    scene.lights = {{foot + vec3(0, H, 0), vec3(10)}};
    const float expected = H * std::tan(std::asin(a / (H - h)));
    for (const float azimuth : {0.3f, 2.0f, 4.5f}) {
        float dark = 0, bright = 3;
        while (bright - dark > 1e-5f) {
            const float r = (dark + bright) / 2;
            const vec3 point = foot + r * vec3(std::cos(azimuth), 0, std::sin(azimuth));
            const bool lit = radiance(scene, Ray{point + vec3(0, 0.2f, 0), {0, -3, 0}}).x > 0;
            (lit ? bright : dark) = r;
        }
        CHECK_MESSAGE(
            bright == approx(expected, 2e-4f),
            hint(bright, {{a, "that is the ball's own radius: the shadow of a light that is infinitely far"},
                          {H * a / (H - h), "H a / (H - h): the light does not graze at the equator"},
                          {0, "no shadow at all"},
                          {3, "no light at all"}}));
    }
}

TEST_CASE("a ball of half a millimetre has its shadow where it should be") {
    // The light stands at 45 degrees: with an epsilon of a millimetre the shadow ray starts past the ball.
    Scene scene;
    const vec3 foot(0.3f, 0, -0.4f), way = normalize(vec3(0.6f, 1, 0.8f));
    const float radius = 5e-4f;
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, add(scene, Diffuse{vec3(0.5f)})}};
    scene.spheres = {{foot + vec3(0, radius, 0), radius, 0}};
    scene.lights = {{foot + 3.0f * way, vec3(10)}};
    const auto seen = [&](vec3 point) {
        const vec3 view(0.3f, -1, 0.2f);
        return radiance(scene, Ray{point - 0.5f * view, view}).x;
    };
    const vec3 middle =
        scene.spheres[0].center - radius / way.y * way; // where the ray through the centre ends
    CHECK_MESSAGE(seen(middle) == 0, "the shadow has come off the ball: epsilon is too large");
    CHECK(seen(middle + vec3(0.9f * radius, 0, -0.675f * radius)) > 0); // beside it
}

TEST_CASE("a floor is dark up to the very place where a ball touches it") {
    Scene scene;
    const vec3 touch(1, 0, -2);
    scene.planes = {{touch, {0, 1, 0}, add(scene, Diffuse{vec3(0.5f)})}};
    scene.spheres = {{touch + vec3(0, 0.5f, 0), 0.5f, 0}};
    scene.lights = {{touch + vec3(0, 4, 0), vec3(10)}};
    int lit = 0;
    for (int i = 0; i < 100; ++i) {
        const vec3 point = touch + vec3(0.004f * float(i + 1), 0, 0); // to .4 metres from it
        const vec3 view = normalize(vec3(-1, -0.05f, 0.3f));
        lit += direct_light(scene, make_hit(Ray{point - view, view, 0, 1}, {0, 1, 0}, {0, 0}, 0)) != vec3(0);
    }
    CHECK_MESSAGE(lit == 0, lit << " of 100 points under the ball are lit");
}

// --- shadow acne ---

namespace {

/// How many of many points of this ball, which is all there is, do not get all the light that faces them.
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
        const vec3 free = irradiance(light, hit->position, hit->normal);
        if (free == vec3(0)) continue;
        ++facing;
        wrong += !(direct_light(scene, *hit) == approx(free));
    }
    return facing < 1000 ? 20000 : wrong;
}

} // namespace

TEST_CASE("no point of a ball that faces the light is shadowed by the ball, of whatever size and wherever") {
    for (const float radius : {0.01f, 0.5f, 7.0f, 1000.0f})
        for (const vec3 center : {vec3(0), vec3(1, -2, 3), vec3(-300, 40, 77)}) {
            INFO("radius " << radius << " around " << to_text(center));
            CHECK_MESSAGE(shadowed_by_itself({center, radius, 0}, 5, 8, 1) == 0,
                          "shadow acne: the shadow ray meets the surface that it starts from");
            CHECK_MESSAGE(shadowed_by_itself({center, radius, 0}, 1.3f, 1.2f, 2) == 0,
                          "acne under a close light");
        }
}

TEST_CASE("no point of a ball near the origin is shadowed by the ball when it is seen from afar") {
    for (const float away : {100.0f, 1000.0f, 20000.0f}) {
        INFO("seen from " << away << " metres");
        CHECK_MESSAGE(shadowed_by_itself({{0.1f, -0.2f, 0.3f}, 1, 0}, 5, away, 5) == 0,
                      "a position is rounded like its ray's origin: the larger of the two sets the offset");
    }
}

TEST_CASE("no point of the inner side of a ball is shadowed by the ball") {
    for (const float radius : {0.01f, 0.5f, 7.0f, 1000.0f})
        for (const vec3 center : {vec3(0), vec3(1, -2, 3), vec3(-300, 40, 77)}) {
            if (radius < 1e-4f * length(center)) continue; // a float's grid is too coarse there
            INFO("radius " << radius << " around " << to_text(center));
            CHECK_MESSAGE(shadowed_by_itself({center, radius, 0}, 0.6f, 0.7f, 3) == 0,
                          "shadow acne: seen from inside the offset must go inward");
        }
}

TEST_CASE("no point of a floor is shadowed by the floor, from one's feet to the horizon") {
    Random random(4);
    int wrong = 0;
    for (int i = 0; i < 10000; ++i) {
        const vec3 normal = any_direction(random);
        const vec3 a = beside(normal), b = cross(normal, a);
        const vec3 point = any_point(random, 20);
        Scene scene;
        scene.planes = {{point, normal, add(scene, Diffuse{vec3(0.5f)})}};
        const vec3 eye = point + 1.7f * normal;
        const float away = std::pow(10.0f, -2 + 5 * random.uniform()); // a centimetre to a kilometre
        const float angle = 2 * pi * random.uniform();
        const vec3 target = point + away * (std::cos(angle) * a + std::sin(angle) * b);
        const PointLight light{point + 4.0f * normal + 3.0f * a, vec3(20)};
        scene.lights = {light};
        const auto hit = intersect(scene, Ray{eye, 0.3f * (target - eye)});
        if (!hit || !(direct_light(scene, *hit) == approx(irradiance(light, hit->position, hit->normal))))
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
        wrong += !hit || !(direct_light(scene, *hit) ==
                           approx(irradiance(scene.lights[0], hit->position, hit->normal)));
    }
    CHECK_MESSAGE(wrong == 0, "shadow acne on " << wrong << " of 5000 points");
}

// --- radiance.h and scene.h ---

namespace {

/// Balls over a checker floor in a half-dark sky, with no light yet.
Scene room() {
    Scene scene;
    const int chalk = add(scene, Diffuse{{0.8f, 0.4f, 0.6f}});
    const int lamp = add(scene, Diffuse{{0.3f, 0.3f, 0.3f}, {0.5f, 0.2f, 0}});
    const int floor = add(scene, Checker{{0.7f, 0.6f, 0.5f}, {0.2f, 0.3f, 0.4f}, 0.5f});
    scene.spheres = {
        {{0, 0.9f, 0}, 0.9f, chalk}, {{1.5f, 0.6f, 0.7f}, 0.4f, chalk}, {{-1.5f, 0.5f, 0.6f}, 0.5f, lamp}};
    scene.planes = {{{0, 0, 0}, {0.1f, 0.99f, -0.0994987f}, floor}};
    return scene;
}

/// A small picture of the scene, row by row.
std::vector<vec3> picture(const Scene& scene) {
    std::vector<vec3> pixels;
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 80; ++x)
            pixels.push_back(radiance(
                scene, Ray{{0.2f, 2.4f, 6.2f}, {0.01f * float(x - 40), -0.01f * float(y - 10), -1.3f}}));
    return pixels;
}

} // namespace

TEST_CASE("the picture by two lights is the sum of the pictures by each") {
    const PointLight warm{{-2.2f, 3, 2}, {9, 6.5f, 4}}, cool{{3.2f, 2.2f, 1.2f}, {2, 3, 5}};
    Scene a = room(), b = room(), both = room();
    for (Scene* scene : {&a, &b, &both}) scene->materials[1] = Diffuse{vec3(0.3f)}; // nothing glows by itself
    a.lights = {warm};
    b.lights = {cool};
    both.lights = {warm, cool};
    const auto by_a = picture(a), by_b = picture(b), by_both = picture(both);
    float worst = 0;
    int lit = 0, shadowed = 0;
    for (std::size_t i = 0; i < by_both.size(); ++i) {
        const vec3 error = abs(by_a[i] + by_b[i] - by_both[i]);
        worst = std::max({worst, error.x, error.y, error.z});
        lit += by_a[i] != vec3(0) && by_b[i] != vec3(0);
        shadowed += (by_a[i] != vec3(0)) != (by_b[i] != vec3(0));
    }
    CHECK_MESSAGE(worst <= 1e-6f, "light adds up; off by "
                                      << worst << ". An ambient constant is counted once for each light?");
    CHECK(lit > 500); // that there is something to check
    CHECK(shadowed > 200);
}

TEST_CASE("the light of the sky is added once, however many lights there are") {
    Scene dark = room(), day = room(), sum = room();
    for (Scene* scene : {&dark, &day, &sum}) scene->materials[1] = Diffuse{vec3(0.3f)};
    dark.lights = sum.lights = {{{-2.2f, 3, 2}, {9, 6.5f, 4}}, {{3.2f, 2.2f, 1.2f}, {2, 3, 5}}};
    day.sky = sum.sky = {{0.1f, 0.2f, 0.3f}, {0.6f, 0.5f, 0.4f}};
    const auto by_lights = picture(dark), by_sky = picture(day), by_both = picture(sum);
    float worst = 0;
    for (std::size_t i = 0; i < by_both.size(); ++i) {
        const vec3 error = abs(by_lights[i] + by_sky[i] - by_both[i]);
        worst = std::max({worst, error.x, error.y, error.z});
    }
    CHECK_MESSAGE(worst <= 1e-6f, "off by " << worst);
}

TEST_CASE("with no lights a white matte ball vanishes in an even sky") {
    Scene scene{.sky = {{0.5f, 2, 0.25f}, {0.5f, 2, 0.25f}}};
    scene.spheres = {{somewhere, 2, add(scene, Diffuse{vec3(1)})}};
    const vec3 seen = radiance(scene, Ray{somewhere + vec3(4, 3, 5), {-0.7f, -0.5f, -1}});
    CHECK_MESSAGE(seen == approx(vec3(0.5f, 2, 0.25f)),
                  hint(seen.x, {{0, "the light of the sky was left out"},
                                {1, "the light of the sky was added twice"}}));
}

TEST_CASE("twice the intensity makes twice the light, and no light makes black") {
    Scene scene = room();
    scene.materials[1] = Diffuse{vec3(0.3f)};
    for (const vec3 pixel : picture(scene)) REQUIRE(pixel == vec3(0));
    scene.lights = {{{-2.2f, 3, 2}, {9, 6.5f, 4}}};
    const auto once = picture(scene);
    scene.lights[0].intensity *= 2.0f;
    const auto twice = picture(scene);
    bool same = true, negative = false;
    for (std::size_t i = 0; i < once.size(); ++i) {
        same = same && twice[i] == approx(2.0f * once[i], 1e-6f);
        negative = negative || once[i].x < 0 || once[i].y < 0 || once[i].z < 0;
    }
    CHECK(same);
    CHECK_MESSAGE(!negative, "light was taken away: a cosine below 0");
}

TEST_CASE("a surface in shadow still shows what it sends out by itself") {
    Scene scene;
    scene.spheres = {{{0, 0, -5}, 1, add(scene, Diffuse{vec3(0.5f), {3, 2, 1}})}};
    scene.lights = {{{0, 0, -9}, vec3(100)}}; // behind the ball
    CHECK(radiance(scene, Ray{{0, 0, 0}, {0, 0, -2}}) == approx(vec3(3, 2, 1)));
}

TEST_CASE("each shape has its own material, and the nearest one shows") {
    Scene scene;
    const int red = add(scene, flat({1, 0, 0})), green = add(scene, flat({0, 1, 0}));
    scene.spheres = {{{0, 0, -9}, 3, red}, {{0, 0, -3}, 1, green}};
    CHECK(radiance(scene, Ray{{0, 0, 0}, {0, 0, -2}}) == approx(vec3(0, 1, 0)));
    CHECK(radiance(scene, Ray{{0, 0, -5}, {0, 0, -2}}) == approx(vec3(1, 0, 0)));
}

TEST_CASE("a checker floor in the light shows the colour of its squares") {
    Scene scene;
    scene.planes = {
        {{0, 0, 0}, {0, 1, 0}, add(scene, Checker{{0.8f, 0.2f, 0.1f}, {0.1f, 0.4f, 0.3f}, 0.5f})}};
    scene.lights = {{{0.7f, 2, -0.3f}, vec3(pi)}};
    CHECK(radiance(scene, Ray{{0.7f, 1, -0.3f}, {0, -0.5f, 0}}) == approx(vec3(0.1f, 0.4f, 0.3f) / 4.0f));
    scene.lights = {{{-0.2f, 2, 0.3f}, vec3(pi)}};
    CHECK(radiance(scene, Ray{{-0.2f, 1, 0.3f}, {0, -0.5f, 0}}) == approx(vec3(0.8f, 0.2f, 0.1f) / 4.0f));
}

TEST_CASE("a ray that meets nothing sees the sky, not the lights") {
    Scene scene{.sky = {{0.1f, 0.2f, 0.9f}, {0.7f, 0.4f, 0.1f}}};
    scene.lights = {{{0, 0, -2}, vec3(100)}};
    CHECK(radiance(scene, Ray{{0, 0, 0}, {0, 0, -3}}) == approx(vec3(0.4f, 0.3f, 0.5f)));
}

TEST_CASE("a segment is occluded exactly if it meets something") {
    Random random(5);
    Scene scene;
    for (int i = 0; i < 30; ++i)
        scene.spheres.push_back({any_point(random, 3), 0.1f + 0.5f * random.uniform(), i});
    scene.planes = {{{0, -2, 0}, normalize(vec3(1, 9, 2)), 30},
                    {{0, 0, -2.5f}, normalize(vec3(1, 2, 9)), 31}};
    int wrong = 0, hidden = 0;
    for (int i = 0; i < 10000; ++i) {
        const vec3 from = any_point(random, 3);
        const Ray ray{from, any_point(random, 3) - from, 0.2f * random.uniform(), 0.2f + random.uniform()};
        const bool meets = intersect(scene, ray).has_value();
        hidden += meets;
        wrong += occluded(scene, ray) != meets;
    }
    CHECK_MESSAGE(wrong == 0, wrong << " of 10000 segments");
    CHECK(hidden > 2000); // that there is something to check
    CHECK(hidden < 8000);
}

TEST_CASE("what hides a light may stand anywhere in the list") {
    const Sphere left{{-9, 0, 0}, 1, 0}, hiding{{0, 2, 0}, 0.5f, 0}, right{{9, 0, 0}, 1, 0};
    const Ray up{{0, 0, 0}, {0, 4, 0}, 0, 1};
    for (const auto& spheres :
         {std::vector{hiding, left, right}, {left, hiding, right}, {left, right, hiding}}) {
        CHECK(occluded(lit_balls({}, spheres), up));
        CHECK_FALSE(occluded(lit_balls({}, spheres), Ray{up.origin, up.direction, 0, 0.3f}));
    }
    CHECK_FALSE(occluded(lit_balls({}, {left, right}), up));
    CHECK_FALSE(occluded(Scene{}, up));
    Scene walls;
    walls.planes = {{{0, -3, 0}, {0, 1, 0}, 0}, {{0, 3, 0}, {0, 1, 0}, 0}};
    CHECK(occluded(walls, up));
    CHECK_FALSE(occluded(walls, Ray{up.origin, up.direction, 0, 0.7f}));
}

TEST_CASE("of many shapes a ray meets the nearest, in whatever order they stand") {
    const vec3 origin(3, 1, -2), direction = 2.0f * vec3(2, -3, 6) / 7.0f;
    const auto ball = [&](int t) { return Sphere{origin + (float(t) + 0.25f) * direction, 0.5f, t}; };
    std::vector<int> order{2, 4, 5, 6};
    do {
        Scene scene;
        for (const int t : order) scene.spheres.push_back(ball(t));
        scene.planes = {{origin + 3.0f * direction, normalize(vec3(1, -1, 3)), 3}};
        for (const auto& [t_min, material] :
             {std::pair(0.0f, 2), {2.6f, 3}, {3.1f, 4}, {4.6f, 5}, {5.6f, 6}}) {
            const auto hit = intersect(scene, Ray{origin, direction, t_min});
            REQUIRE(hit);
            CHECK_MESSAGE(hit->material == material, "materials count the shapes along the ray");
            CHECK(hit->t == approx(float(material)));
        }
        CHECK_FALSE(intersect(scene, Ray{origin, direction, 0, 1.9f}));
    } while (std::next_permutation(order.begin(), order.end()));
}

namespace {
/// A scene of another make: an endless floor, and nothing that could cast a shadow but a roof from x = 0 on.
struct Porch {
    Sky sky;
    std::vector<PointLight> lights{{{0.5f, 4, 0}, vec3(16 * pi)}};
    std::vector<Material> materials{Diffuse{vec3(0.25f)}};
};
std::optional<Hit> intersect(const Porch&, Ray ray) {
    if (ray.direction.y >= 0) return std::nullopt;
    ray.t_max = -ray.origin.y / ray.direction.y;
    return make_hit(ray, {0, 1, 0}, {0, 0}, 0);
}
bool occluded(const Porch&, const Ray& ray) {
    const vec3 end = at(ray, ray.t_max);
    return ray.origin.y < 2 && end.y > 2 && ray.origin.x > 0;
}
} // namespace

TEST_CASE("light travels in any scene that can say what a ray meets and whether anything hides a light") {
    CHECK(radiance(Porch{}, Ray{{0.5f, 1, 0}, {0, -2, 0}}) == vec3(0));
    const float cosine = 4 / std::sqrt(17.0f);
    CHECK(radiance(Porch{}, Ray{{-0.5f, 1, 0}, {0, -2, 0}}) == approx(vec3(4 * cosine / 17)));
}
