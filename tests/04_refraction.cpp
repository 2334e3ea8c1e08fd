// Facts about glass: where a refracted ray goes, how much light goes with it, how colour grows with depth.
// A ray that entered a ball from outside always gets out again, so total reflection is asked of air bubbles
// in glass and of direct calls.
#include "04_refraction/radiance.h"
#include "04_refraction/scene.h"
#include "tests/check.h"

#include <stdexcept>
#include <utility>

using namespace rt;

namespace {

const vec3 normal = vec3(2, -1, 2) / 3.0f;            // oblique, unit,
const vec3 tangent = vec3(1, 2, 0) / std::sqrt(5.0f); // and two more at right angles to it
const vec3 binormal = vec3(-4, 2, 5) / std::sqrt(45.0f);

float cosine(float degrees) {
    return std::cos(glm::radians(degrees));
}

/// A direction of length 2 that comes down on `normal` at this angle to it.
vec3 arriving(float degrees) {
    return 2.0f * (std::sin(glm::radians(degrees)) * tangent - cosine(degrees) * normal);
}

/// Which angle a direction that goes away below `normal` makes with -normal, degrees.
float angle_below(vec3 direction) {
    return glm::degrees(std::atan2(dot(direction, tangent), -dot(direction, normal)));
}

float angle_between(vec3 a, vec3 b) {
    return glm::degrees(std::atan2(length(cross(a, b)), dot(a, b)));
}

/// A scene that loses its patience: a ray that meets again and again the surface that it leaves would double
/// the work with each boundary, and a check should fail rather than hang.
struct Glassware : Scene {
    mutable int questions = 0;
};

std::optional<Hit> intersect(const Glassware& scene, const Ray& ray) {
    if (++scene.questions > 1000000)
        throw std::runtime_error("a million rays: do they start where they meet the same surface again?");
    return intersect(static_cast<const Scene&>(scene), ray);
}

bool occluded(const Glassware& scene, const Ray& ray) {
    return occluded(static_cast<const Scene&>(scene), ray);
}

Glassware white_furnace() {
    Glassware scene;
    scene.sky = {vec3(1), vec3(1)};
    return scene;
}

const vec3 center = {1, -2, 3};
constexpr float radius = 2;

/// One ball of radius 2 off the origin, in a world that shines white from everywhere.
Glassware ball_of(const Glass& glass) {
    Glassware scene = white_furnace();
    scene.spheres = {{center, radius, add(scene, glass)}};
    return scene;
}

/// A ray with |d| = 2 that flies along -normal past the centre, `offset` radii beside it. It starts 5 away.
Ray ray_beside(float offset) {
    return {center + 5.0f * normal + offset * radius * tangent, -2.0f * normal};
}

/// The ray that goes on through the first boundary that `ray` meets, if any does.
std::optional<Ray> passed(const Glassware& scene, const Ray& ray) {
    const auto hit = intersect(scene, ray);
    if (!hit) return std::nullopt;
    const Glass& glass = std::get<Glass>(scene.materials[std::size_t(hit->material)]);
    return refracted_ray(ray, *hit, boundary(glass, ray, *hit));
}

/// A slab of glass between two planes at right angles to `normal`, its upper side through the origin.
Glassware slab_of(const Medium& medium, float thickness) {
    Glassware scene;
    const int glass = add(scene, Glass{medium});
    scene.planes = {{vec3(0), normal, glass}, {-thickness * normal, -normal, glass}};
    return scene;
}

const Medium air{};
const Medium glass_15{1.5f};
const Glass ball{glass_15};
const Glass bubble{air, glass_15};

} // namespace

// ----------------------------------------------------------------------------------------- Snell's law

TEST_CASE("light that meets glass at 45 degrees goes on at 28.1255 degrees") {
    const auto direction = refract(arriving(45), normal, 1 / 1.5f);
    REQUIRE_MESSAGE(direction, "air to glass: light always gets in");
    CHECK_MESSAGE(
        angle_below(*direction) == approx(28.1255f),
        "45: not bent at all; none or 90: eta upside down, it is n_i / n_t; -28: the tangent part must "
        "not turn round; above 90: the normal part must keep its sign");
}

TEST_CASE("light that leaves glass at 28.1255 degrees goes on at 45 degrees") {
    const auto direction = refract(arriving(28.1255f), normal, 1.5f);
    REQUIRE(direction);
    CHECK_MESSAGE(angle_below(*direction) == approx(45), "18.3: eta upside down");
}

TEST_CASE("n sin(theta) is the same on both sides of a boundary, and no ray leaves the plane of incidence") {
    for (const float eta : {1 / 2.417f, 1 / 1.5f, 1 / 1.333f, 0.9f, 1.0f, 1.1f, 1.333f, 1.5f, 2.417f}) {
        for (float degrees = 0; degrees < 89.5f; degrees += 3.7f) {
            const float sin_t = eta * std::sin(glm::radians(degrees));
            if (sin_t > 0.9999f) continue; // total reflection, which others check
            INFO("eta = n_i / n_t = ", eta, ", angle of incidence ", degrees);
            const auto direction = refract(arriving(degrees), normal, eta);
            REQUIRE(direction);
            CHECK(dot(*direction, tangent) / 2 == approx(sin_t));
            CHECK_MESSAGE(length(*direction) == approx(2), "the length of the direction stays, 2 here");
            CHECK(dot(*direction, binormal) == approx(0));
            CHECK_MESSAGE(dot(*direction, normal) < 0, "it goes on to the far side");
        }
    }
}

TEST_CASE("refracted_cosine gives the cosine of the angle beyond the boundary") {
    const auto into = refracted_cosine(cosine(45), 1 / 1.5f);
    REQUIRE(into);
    CHECK_MESSAGE(*into == approx(cosine(28.1255f)), ".7778: that is its square; .4714: that is the sine");
    const auto out = refracted_cosine(cosine(28.1255f), 1.5f);
    REQUIRE(out);
    CHECK(*out == approx(cosine(45)));
}

TEST_CASE("a ray that is turned back takes the same way through the boundary") {
    for (float degrees = 0; degrees < 89; degrees += 4.3f) {
        INFO("angle of incidence ", degrees);
        const vec3 there = arriving(degrees);
        const auto inside = refract(there, normal, 1 / 1.5f);
        REQUIRE(inside);
        const auto back = refract(-*inside, -normal, 1.5f);
        REQUIRE(back);
        CHECK(*back == approx(-there, 1e-4f));
    }
}

TEST_CASE("light that meets a boundary head-on goes straight on, whatever the media") {
    for (const float eta : {1 / 2.417f, 1 / 1.5f, 1.0f, 1.5f, 2.417f}) {
        const auto direction = refract(-3.0f * normal, normal, eta);
        REQUIRE(direction);
        CHECK(*direction == approx(-3.0f * normal));
    }
}

TEST_CASE("between two equal media light goes straight on and nothing is reflected") {
    for (float degrees = 0; degrees < 89; degrees += 5) {
        INFO("angle of incidence ", degrees);
        const auto direction = refract(arriving(degrees), normal, 1);
        REQUIRE(direction);
        CHECK(*direction == approx(arriving(degrees), 1e-4f));
        CHECK(fresnel(cosine(degrees), 1) == approx(0));
    }
}

TEST_CASE("between two equal media even grazing light goes through") {
    for (const float cos_i : {1e-2f, 1e-4f, 1e-6f}) {
        INFO("cosine of incidence ", cos_i,
             ": 1 - cos^2 rounds to 1, so solve for cos^2 of the refracted ray");
        const auto cos_t = refracted_cosine(cos_i, 1);
        REQUIRE(cos_t);
        CHECK(*cos_t / cos_i == approx(1));
        CHECK(fresnel(cos_i, 1) == approx(0));
    }
}

// --------------------------------------------------------------------------- total internal reflection

TEST_CASE("total reflection begins at 41.8103 degrees in glass, 48.6066 in water, 24.4397 in diamond") {
    struct Known {
        float ior, degrees;
    };
    for (const Known& known : {Known{1.5f, 41.8103f}, {1.333f, 48.6066f}, {2.417f, 24.4397f}}) {
        const float ior = known.ior, critical = known.degrees;
        float passes = 0, reflects = 90; // the border between the two is found by halving
        for (int i = 0; i < 30; ++i) {
            const float middle = (passes + reflects) / 2;
            (refracted_cosine(cosine(middle), ior) ? passes : reflects) = middle;
        }
        INFO("from n = ", ior, " into air");
        CHECK_MESSAGE(passes == approx(critical, 1e-5f),
                      "90: there is no total reflection at all; 0: eta upside down");
        CHECK(refract(arriving(critical - 0.01f), normal, ior).has_value());
        CHECK_MESSAGE(
            !refract(arriving(critical + 0.01f), normal, ior),
            "beyond it no ray goes on: clamping the root to 0 or taking its absolute value invents one");
        CHECK(fresnel(cosine(critical - 0.01f), ior) < 1);
        CHECK_MESSAGE(fresnel(cosine(critical + 0.01f), ior) == 1, "all of the light is reflected");
    }
}

TEST_CASE("light that enters the denser medium is never totally reflected") {
    for (const float ior : {1.0003f, 1.333f, 1.5f, 2.417f, 4.0f}) {
        for (float degrees = 0; degrees < 90; degrees += 1.3f) {
            INFO("into n = ", ior, " at ", degrees, " degrees");
            CHECK(refracted_cosine(cosine(degrees), 1 / ior).has_value());
            CHECK(refract(arriving(degrees), normal, 1 / ior).has_value());
        }
    }
}

TEST_CASE("an air bubble reflects all light that passes further than R / n from its centre") {
    const Glassware scene = ball_of(bubble);
    for (float offset = 0; offset < 1; offset += 0.02f) {
        if (std::abs(offset - 1 / 1.5f) < 0.001f) continue;
        INFO("offset ", offset, " radii, total reflection begins at .6667");
        const Ray ray = ray_beside(offset);
        const auto hit = intersect(scene, ray);
        REQUIRE(hit);
        const Boundary side = boundary(bubble, ray, *hit);
        const bool total = offset > 1 / 1.5f;
        CHECK((side.reflectance == 1) == total);
        CHECK_MESSAGE(refracted_ray(ray, *hit, side).has_value() == !total,
                      "a bubble is {inside: air, outside: glass}: the ray comes from the glass");
    }
}

TEST_CASE("what is totally reflected at a bubble shows the sky as a mirror would") {
    Glassware scene = ball_of(bubble);
    scene.sky = {{1, 0, 0.2f}, {0, 0.5f, 0.9f}};
    const Ray ray = ray_beside(0.8f);
    const auto hit = intersect(scene, ray);
    REQUIRE(hit);
    CHECK_MESSAGE(radiance(scene, ray, 5) == approx(radiance(scene.sky, reflect(ray.direction, hit->normal))),
                  "black: the whole of the light goes with the reflected ray, nothing must be taken off it");
}

// --------------------------------------------------------------------------------------------- Fresnel

TEST_CASE("head-on, glass reflects .04, water .020373, diamond .171969, from either side") {
    struct Known {
        float ior, reflectance;
    };
    for (const Known& known : {Known{1.5f, 0.04f}, {1.333f, 0.020373f}, {2.417f, 0.171969f}}) {
        const float ior = known.ior, reflectance = known.reflectance;
        INFO("n = ", ior);
        const std::string hint =
            ".2 for glass: r0 has to be squared; 0: Fresnel is left out; 1 - that: R and T swapped";
        CHECK_MESSAGE(fresnel(1, 1 / ior) == approx(reflectance, 1e-6f), hint);
        CHECK_MESSAGE(fresnel(1, ior) == approx(reflectance, 1e-6f), hint);
    }
}

TEST_CASE("from air, glass reflects what Fresnel's equations say at each angle") {
    struct Known {
        float degrees, reflectance;
    };
    for (const Known& known : {Known{30, 0.0415226f},
                               {45, 0.0502399f},
                               {60, 0.0891867f},
                               {75, 0.2530606f},
                               {80, 0.3877044f},
                               {85, 0.6127996f}}) {
        const float degrees = known.degrees, reflectance = known.reflectance;
        INFO("at ", degrees, " degrees");
        CHECK_MESSAGE(
            fresnel(cosine(degrees), 1 / 1.5f) == approx(reflectance, 1e-6f),
            ".04 everywhere: no angle in it; .0700 at 60: that is Schlick's shortcut; 1 at 45: eta upside "
            "down; .0056 or .1728 at 60: one polarisation alone, take the mean of both");
    }
}

TEST_CASE("from inside, glass reflects what Fresnel's equations say at each angle") {
    struct Known {
        float degrees, reflectance;
    };
    for (const Known& known :
         {Known{20, 0.041729f}, {30, 0.055190f}, {40, 0.245291f}, {41, 0.379751f}, {60, 1.0f}}) {
        const float degrees = known.degrees, reflectance = known.reflectance;
        INFO("at ", degrees, " degrees");
        CHECK_MESSAGE(fresnel(cosine(degrees), 1.5f) == approx(reflectance, 5e-6f),
                      "less from 30 degrees on: the cosine of the wrong side, or eta upside down");
    }
}

TEST_CASE("at Brewster's angle one polarisation is gone, and the two rays part at a right angle") {
    const float brewster = glm::degrees(std::atan(1.5f));
    CHECK(brewster == approx(56.3099f));
    CHECK_MESSAGE(
        fresnel(cosine(brewster), 1 / 1.5f) == approx(0.0739645f, 1e-6f),
        ".147929: that is the sum of both polarisations (.147929 and 0), or the one alone: take the mean");
    const auto onward = refract(arriving(brewster), normal, 1 / 1.5f);
    REQUIRE(onward);
    CHECK(dot(*onward, reflect(arriving(brewster), normal)) == approx(0));
}

TEST_CASE("a boundary reflects the same share of the light that goes the same way in the other direction") {
    for (const float ior : {1.0003f, 1.333f, 1.5f, 2.417f, 4.0f}) {
        for (float degrees = 0; degrees <= 89; degrees += 1.7f) {
            INFO("n = ", ior, ", outer angle ", degrees);
            const auto cos_t = refracted_cosine(cosine(degrees), 1 / ior);
            REQUIRE(cos_t);
            CHECK_MESSAGE(fresnel(cosine(degrees), 1 / ior) == approx(fresnel(*cos_t, ior), 1e-4f),
                          "F(theta_i, 1 -> n) = F(theta_t, n -> 1)");
        }
    }
}

TEST_CASE("a boundary reflects between nothing and everything, and everything when light just grazes it") {
    for (float ior = 1; ior <= 4; ior += 0.0625f) {
        for (const float eta : {ior, 1 / ior}) {
            for (int i = 0; i <= 1000; ++i) {
                const float share = fresnel(float(i) / 1000, eta);
                if (!(share >= 0 && share <= 1))
                    FAIL_CHECK("fresnel(", float(i) / 1000, ", ", eta, ") = ", share);
            }
            if (ior > 1) CHECK(fresnel(0, eta) == approx(1));
            if (ior >= 1.0625f) CHECK(fresnel(1e-4f, eta) == approx(1, 5e-3f));
        }
    }
}

// ----------------------------------------------------------------------------- boundaries of two media

TEST_CASE("which medium a ray comes from is told by the side that it comes from") {
    const Medium oil{1.47f, {1, 2, 3}}, water{1.333f, {0.3f, 0.2f, 0.1f}};
    const Glass drop{oil, water};
    const Glassware scene = ball_of(drop);
    const Ray ray = ray_beside(0.5f);
    const auto hit = intersect(scene, ray);
    REQUIRE(hit);
    const Boundary in = boundary(drop, ray, *hit);
    CHECK_MESSAGE(in.here.ior == water.ior, "the ray comes from outside");
    CHECK(in.beyond.ior == oil.ior);
    CHECK(in.here.absorption == water.absorption);
    CHECK(in.beyond.absorption == oil.absorption);
    CHECK_MESSAGE(in.reflectance == approx(fresnel(std::sqrt(0.75f), 1.333f / 1.47f)),
                  "at offset R / 2 the angle is 30 degrees; the direction is 2 long here, its cosine is not");

    const Ray out_ray{center, -2.0f * tangent};
    const auto out_hit = intersect(scene, out_ray);
    REQUIRE(out_hit);
    const Boundary out = boundary(drop, out_ray, *out_hit);
    CHECK_MESSAGE(out.here.ior == oil.ior, "the ray comes from inside: not every ray is entering");
    CHECK(out.beyond.ior == water.ior);
    CHECK(out.beyond.absorption == water.absorption);
    CHECK(out.reflectance == approx(fresnel(1, 1.47f / 1.333f)));
}

TEST_CASE("a refracted ray starts just beyond the boundary") {
    const Glassware scene = ball_of(ball);
    for (float offset = 0; offset < 0.96f; offset += 0.05f) {
        INFO("offset ", offset);
        const auto inside = passed(scene, ray_beside(offset));
        REQUIRE(inside);
        CHECK_MESSAGE(distance(inside->origin, center) < radius,
                      "it starts outside and meets the same side again");
        CHECK(distance(inside->origin, center) == approx(radius, 1e-4f));
        const auto outside = passed(scene, *inside);
        REQUIRE(outside);
        CHECK_MESSAGE(distance(outside->origin, center) > radius,
                      "it starts inside and meets the far side again");
        CHECK_MESSAGE(!intersect(scene, *outside), "it is out, and meets the ball no more");
    }
}

TEST_CASE("a ray half a radius off the centre of a glass ball is turned by 21.0576 degrees") {
    const Glassware scene = ball_of(ball);
    const auto inside = passed(scene, ray_beside(0.5f));
    REQUIRE(inside);
    const auto outside = passed(scene, *inside);
    REQUIRE_MESSAGE(outside,
                    "what got in gets out: on the way out the indices are exchanged and the normal turned");
    CHECK_MESSAGE(angle_between(outside->direction, -normal) == approx(21.0576f, 1e-4f),
                  "10.53: bent only once; 0: not at all");
    CHECK_MESSAGE(dot(outside->direction, tangent) < 0, "a ball of glass bends light towards its axis");
    CHECK(length(outside->direction) == approx(2));
}

TEST_CASE("a ray half a radius off the centre of an air bubble in glass is turned away from its axis") {
    // in: asin(.5) = 30 -> asin(.75) = 48.5904, twice the difference
    const Glassware scene = ball_of(bubble);
    const auto inside = passed(scene, ray_beside(0.5f));
    REQUIRE(inside);
    const auto outside = passed(scene, *inside);
    REQUIRE(outside);
    CHECK(angle_between(outside->direction, -normal) == approx(37.1808f, 1e-4f));
    CHECK_MESSAGE(dot(outside->direction, tangent) > 0, "a bubble spreads light");
}

TEST_CASE("a glass ball brings rays near its axis together 1.5 radii from its centre") {
    const Glassware scene = ball_of(ball);
    for (const float offset : {0.02f, 0.01f, -0.01f}) {
        const auto inside = passed(scene, ray_beside(offset));
        REQUIRE(inside);
        const auto outside = passed(scene, *inside);
        REQUIRE(outside);
        const vec3 from_center = outside->origin - center;
        const float t = -dot(from_center, tangent) / dot(outside->direction, tangent);
        CHECK_MESSAGE(dot(from_center + t * outside->direction, -normal) == approx(1.5f * radius, 1e-3f),
                      "focal length n R / (2 (n - 1)), from the centre");
    }
}

TEST_CASE("a ray that entered a glass ball from outside can always leave it") {
    for (const float ior : {1.01f, 1.5f, 2.417f, 4.0f}) {
        const Glass glass{{ior}};
        const Glassware scene = ball_of(glass);
        for (float offset = 0; offset < 0.995f; offset += 0.03f) {
            INFO("n = ", ior, ", offset ", offset);
            const Ray ray = ray_beside(offset);
            const auto inside = passed(scene, ray);
            REQUIRE(inside);
            const auto hit = intersect(scene, *inside);
            REQUIRE(hit);
            const Boundary out = boundary(glass, *inside, *hit);
            CHECK(out.reflectance == approx(boundary(glass, ray, *intersect(scene, ray)).reflectance, 2e-3f));
            CHECK(refracted_ray(*inside, *hit, out).has_value());
        }
    }
}

TEST_CASE("a slab moves a ray aside and does not turn it") {
    const Glassware scene = slab_of(glass_15, 0.7f);
    const vec3 direction = arriving(60);
    const auto inside = passed(scene, Ray{-direction, direction});
    REQUIRE(inside);
    const auto outside = passed(scene, *inside);
    REQUIRE(outside);
    CHECK(outside->direction == approx(direction));
    // The depth times sin_i (1 - cos_i / (n cos_t)), to the side of the normal.
    const float sin_i = std::sin(glm::radians(60.0f)), cos_t = std::sqrt(1 - sin_i * sin_i / 2.25f);
    CHECK(length(cross(outside->origin, direction)) / 2 ==
          approx(0.7f * sin_i * (1 - 0.5f / (1.5f * cos_t)), 1e-4f));
}

// -------------------------------------------------------------------------- how light travels in glass

TEST_CASE("each boundary on the way costs one of the depth, and the light beyond the last is left out") {
    const Glassware scene = ball_of(ball);
    const Ray ray = ray_beside(0);
    CHECK_MESSAGE(radiance(scene, ray, 0) == approx(vec3(0)), "no boundary may be met");
    CHECK_MESSAGE(radiance(scene, ray, 1) == approx(vec3(0.04f)),
                  "only what the front reflects; .96: R and T swapped");
    CHECK_MESSAGE(radiance(scene, ray, 2) == approx(vec3(0.9616f)), ".04 + .96 .96; 2 or 1.96: no weights");
    CHECK(radiance(scene, ray, 3) == approx(vec3(0.998464f)));
}

TEST_CASE(
    "a slab of glass lets .923077 of the light through and reflects the rest, all inner bounces counted") {
    const Ray ray{1.3f * normal + 0.4f * tangent, -2.0f * normal};
    Glassware scene = slab_of(glass_15, 0.7f);
    scene.planes.push_back({-2.0f * normal, normal, add(scene, flat(vec3(1)))});
    CHECK_MESSAGE(radiance(scene, ray, 60) == approx(vec3(0.923077f)),
                  "(1 - F) / (1 + F); .9216: the inner bounces are missing; .96: only one side reflects");
    scene.planes.back().point = 2.0f * normal;
    CHECK_MESSAGE(radiance(scene, ray, 60) == approx(vec3(0.0769231f)), "the lamp stands behind the eye now");
}

TEST_CASE("a slab that is seen at 60 degrees lets (1 - F) / (1 + F) through") {
    Glassware scene = slab_of(glass_15, 0.7f);
    scene.planes.push_back({-2.0f * normal, normal, add(scene, flat(vec3(1)))});
    const float f = 0.0891867f;
    CHECK(radiance(scene, Ray{-arriving(60), arriving(60)}, 60) == approx(vec3((1 - f) / (1 + f))));
}

TEST_CASE("a clear ball is invisible in a white furnace") {
    // What depth d cuts off is less than F^(d - 2): at offset .99 F is .49, so nothing is left after 60.
    for (const float ior : {1.0f, 1.333f, 1.5f, 2.417f}) {
        const Glassware scene = ball_of(Glass{{ior}});
        for (float offset = 0; offset < 0.992f; offset += 0.03f) {
            INFO("n = ", ior, ", offset ", offset);
            CHECK_MESSAGE(
                radiance(scene, ray_beside(offset), 60) == approx(vec3(1), 1e-4f),
                "more: reflected and refracted light do not add up to what came, or L / n^2 is scaled; "
                "less: light is lost at a boundary");
        }
    }
}

TEST_CASE("an air bubble in glass is invisible in a white furnace") {
    for (float offset = 0; offset < 0.999f; offset += 0.03f) {
        INFO("offset ", offset, ", total reflection begins at .6667");
        CHECK_MESSAGE(radiance(ball_of(bubble), ray_beside(offset), 60) == approx(vec3(1), 1e-4f),
                      "black from .6667 on: what is totally reflected has to be seen");
    }
}

TEST_CASE("a single boundary is invisible in a white furnace, from the air and from the glass") {
    Glassware scene = white_furnace();
    scene.planes = {{vec3(0), normal, add(scene, ball)}};
    for (const float degrees : {0.0f, 30.0f, 41.0f, 60.0f, 85.0f}) {
        INFO("at ", degrees, " degrees");
        const std::string hint =
            "2.25 or .44 and so on: light is L / n^2 here, which a boundary leaves as it is";
        CHECK_MESSAGE(radiance(scene, Ray{-arriving(degrees), arriving(degrees)}, 2) == approx(vec3(1)),
                      hint);
        const vec3 upward = -arriving(degrees);
        CHECK_MESSAGE(radiance(scene, Ray{-upward, upward}, 2) == approx(vec3(1)), hint);
    }
}

TEST_CASE("a bubble inside a ball is invisible in a white furnace") {
    // Light that crosses the shell to and fro takes up the depth: with 20 boundaries less than 1e-3 is cut
    // off, but for rays that just graze the bubble or the ball. It is never more than 1.
    Glassware scene = ball_of(ball);
    scene.spheres.push_back({center + vec3(0.2f, 0, 0), 0.7f * radius, add(scene, bubble)});
    for (float offset = -0.95f; offset < 0.96f; offset += 0.1f) {
        INFO("offset ", offset);
        const vec3 light = radiance(scene, ray_beside(offset), 20);
        CHECK(light.x <= 1.0001f);
        CHECK(light.x >= 0.999f);
    }
}

TEST_CASE("a ray through a bubble in a ball passes air, glass, air, glass and air") {
    Glassware scene = ball_of(ball);
    scene.spheres.push_back({center, 0.6f * radius, add(scene, bubble)});
    const float indices[] = {1, 1.5f, 1, 1.5f, 1};
    Ray ray = ray_beside(0.3f);
    for (int i = 0; i < 4; ++i) {
        INFO("boundary ", i + 1);
        const auto hit = intersect(scene, ray);
        REQUIRE(hit);
        const Boundary side =
            boundary(std::get<Glass>(scene.materials[std::size_t(hit->material)]), ray, *hit);
        CHECK(side.here.ior == indices[i]);
        CHECK(side.beyond.ior == indices[i + 1]);
        const auto onward = refracted_ray(ray, *hit, side);
        REQUIRE(onward);
        ray = *onward;
        // Concentric spheres keep n b: the distance of the ray's line from the centre, times the index.
        const float b = length(cross(ray.origin - center, ray.direction)) / length(ray.direction);
        CHECK(indices[i + 1] * b == approx(0.3f * radius, 1e-4f));
    }
    CHECK_MESSAGE(!intersect(scene, ray), "after four boundaries it is out");
}

TEST_CASE("glass within glass of the same kind is invisible") {
    Glassware without = ball_of(ball);
    without.sky = {{1, 0.2f, 0}, {0, 0.7f, 1}};
    Glassware with = without;
    with.spheres.push_back({center, 0.7f * radius, add(with, Glass{glass_15, glass_15})});
    for (float offset = 0; offset < 0.95f; offset += 0.11f) {
        INFO("offset ", offset);
        CHECK(radiance(with, ray_beside(offset), 4) ==
              approx(radiance(without, ray_beside(offset), 2), 1e-4f));
    }
}

TEST_CASE("a ball of air in air is invisible") {
    Glassware scene = ball_of(Glass{air});
    scene.sky = {{1, 0.2f, 0}, {0, 0.7f, 1}};
    for (float offset = 0; offset < 0.999f; offset += 0.037f) {
        INFO("offset ", offset);
        CHECK_MESSAGE(radiance(scene, ray_beside(offset), 6) == approx(radiance(scene.sky, -normal), 1e-4f),
                      "eta = 1 goes straight on, through both sides");
    }
}

TEST_CASE("light never becomes more than it was and never not a number, at any angle and index") {
    for (const float ior : {1.0f, 1.00001f, 1.0003f, 1.1f, 1.333f, 1.5f, 2.417f, 4.0f}) {
        for (const Glass& glass : {Glass{{ior}}, Glass{air, {ior}}}) {
            const Glassware scene = ball_of(glass);
            for (int i = 0; i <= 400; ++i) {
                // Every offset, and ever nearer to the rim.
                const float offset = i <= 200 ? float(i) / 200 : 1 - std::exp2(-float(i - 200) / 8);
                const vec3 light = radiance(scene, ray_beside(offset), 12);
                if (!(light.x >= 0 && light.x <= 1.0001f))
                    FAIL_CHECK("n = ", ior, ", offset ", offset, ": got ", light, " in a white furnace");
            }
        }
    }
}

TEST_CASE("a ray that just grazes glass is finite and goes nowhere but along it") {
    for (const float eta : {1 / 4.0f, 1 / 1.5f, 1.0f, 1.5f, 4.0f}) {
        for (const float degrees : {89.9f, 89.99f, 89.999f, 90.0f}) {
            INFO("eta ", eta, " at ", degrees, " degrees");
            const auto direction = refract(arriving(degrees), normal, eta);
            if (!direction) continue;
            CHECK(std::isfinite(dot(*direction, *direction)));
            CHECK(length(*direction) == approx(2, 1e-4f));
            CHECK(dot(*direction, normal) <= 1e-4f);
        }
    }
}

// ---------------------------------------------------------------------------------------- Beer-Lambert

TEST_CASE("what is left of light after a way through a medium is exp(-absorption way), channel by channel") {
    CHECK_MESSAGE(transmittance({0.5f, 1.2f, 3}, 0.7f) == approx(vec3(0.704688f, 0.431711f, 0.122456f)),
                  "above 1: the minus is missing; 1 - a d: that is only its start");
    CHECK(transmittance({0.5f, 1.2f, 3}, 0) == approx(vec3(1)));
    CHECK(transmittance(vec3(0), 1000) == approx(vec3(1)));
    CHECK_MESSAGE(transmittance({0.5f, 1.2f, 3}, 2) * transmittance({0.5f, 1.2f, 3}, 3) ==
                      approx(transmittance({0.5f, 1.2f, 3}, 5), 1e-7f),
                  "two ways in a row multiply");
}

TEST_CASE("a tinted ball absorbs along the chord that a ray cuts out of it") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    const Glassware scene = ball_of(Glass{{1, absorption}}); // n = 1, so that the chord is straight
    for (const float offset : {0.0f, 0.3f, 0.6f, 0.9f}) {
        INFO("offset ", offset);
        const float chord = 2 * radius * std::sqrt(1 - offset * offset);
        CHECK_MESSAGE(
            radiance(scene, ray_beside(offset), 4) == approx(exp(-absorption * chord), 1e-4f),
            "exp(-a chord / 2): t counts lengths of the direction, which is 2 long here; 1: nothing is "
            "absorbed; less: absorbed outside as well");
    }
}

TEST_CASE("a refracted ray is absorbed along its refracted way") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    const Glassware scene = ball_of(Glass{{1.5f, absorption}});
    const float f = 0.0415226f;                                            // at 30 degrees
    const float chord = 2 * radius * std::sqrt(1 - 0.25f / (1.5f * 1.5f)); // sin_t = sin_i / n
    CHECK_MESSAGE(radiance(scene, ray_beside(0.5f), 2) ==
                      approx(vec3(f) + (1 - f) * (1 - f) * exp(-absorption * chord), 1e-5f),
                  "the part that is reflected at the outside is not tinted");
}

TEST_CASE("light that is reflected inside tinted glass goes on being absorbed") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    const Glassware scene = ball_of(Glass{{1.5f, absorption}});
    const vec3 once = exp(-absorption * 2.0f * radius);
    CHECK(radiance(scene, ray_beside(0), 3) ==
          approx(vec3(0.04f) + 0.96f * 0.96f * once + 0.96f * 0.96f * 0.04f * once * once));
}

TEST_CASE("tinted glass absorbs inside it and nowhere else") {
    const Glassware scene = ball_of(Glass{{1.5f, {0.1f, 0.35f, 0.8f}}});
    const vec3 near = radiance(scene, ray_beside(0.4f), 6);
    Ray far = ray_beside(0.4f);
    far.origin += 50.0f * normal;
    CHECK_MESSAGE(radiance(scene, far, 6) == approx(near, 2e-4f), "the way through the air must not count");
    CHECK_MESSAGE(radiance(scene, ray_beside(1.5f), 6) == approx(vec3(1)), "this ray passes beside the ball");
    CHECK(radiance(scene, ray_beside(0.4f), 1).x == approx(radiance(scene, ray_beside(0.4f), 1).z));
}

TEST_CASE("a thing inside tinted glass is seen through the glass before it alone") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    Glassware scene = ball_of(Glass{{1, absorption}});
    scene.spheres.push_back({center, 0.25f * radius, add(scene, flat({0.5f, 2, 1}))});
    CHECK(radiance(scene, ray_beside(0), 4) ==
          approx(vec3(0.5f, 2, 1) * exp(-absorption * 0.75f * radius), 1e-4f));
}

TEST_CASE("a bubble in tinted glass does not absorb, the glass around it does") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    const Medium tinted{1, absorption};
    Glassware scene = ball_of(Glass{tinted});
    scene.spheres.push_back({center, 0.6f * radius, add(scene, Glass{air, tinted})});
    CHECK_MESSAGE(radiance(scene, ray_beside(0), 5) == approx(exp(-absorption * 2.0f * 0.4f * radius), 1e-4f),
                  "each boundary names the medium beyond it: after the bubble it is glass again");
}

TEST_CASE("light to and from a mirror inside tinted glass is absorbed both ways") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    const vec3 expected = vec3(0.5f, 0.6f, 0.7f) * exp(-absorption * 2.0f * 0.75f * radius);
    Glassware scene = ball_of(Glass{{1, absorption}});
    scene.spheres.push_back({center, 0.25f * radius, add(scene, Mirror{{0.5f, 0.6f, 0.7f}})});
    CHECK(radiance(scene, ray_beside(0), 5) == approx(expected, 1e-4f));

    const int black = add(scene, Diffuse{vec3(0)});
    scene.spheres.back().material = add(scene, Reflective{1, black, {0.5f, 0.6f, 0.7f}});
    CHECK(radiance(scene, ray_beside(0), 5) == approx(expected, 1e-4f));
}

TEST_CASE("what glass under a coat reflects inside tinted glass is absorbed both ways too") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    const Medium tinted{1, absorption};
    Glassware scene = ball_of(Glass{tinted});
    const int inner = add(scene, Glass{glass_15, tinted});
    scene.spheres.push_back({center, 0.25f * radius, add(scene, Reflective{0, inner})});
    // Three boundaries: in, back from the inner ball, out. All other ways meet more.
    CHECK(radiance(scene, ray_beside(0), 3) ==
          approx(0.04f * exp(-absorption * 2.0f * 0.75f * radius), 1e-5f));
}

TEST_CASE("an eye inside a medium sees through it") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    Glassware scene = white_furnace();
    const Ray ray{{1, 2, 3}, -2.0f * normal};
    CHECK_MESSAGE(radiance(scene, ray, 4, absorption) == approx(vec3(0)),
                  "an absorbing medium without end is black");
    CHECK_MESSAGE(radiance(scene, ray, 4) == approx(vec3(1)), "a clear one is not");
    scene.spheres = {{vec3(1, 2, 3) - 4.0f * normal, 1.5f, add(scene, flat({0.5f, 2, 1}))}};
    CHECK(radiance(scene, ray, 4, absorption) == approx(vec3(0.5f, 2, 1) * exp(-absorption * 2.5f)));
}

// --------------------------------------------------------------------------------- the older materials

TEST_CASE("a coat of reflectivity r over glass shows r of the mirror and the rest of the glass") {
    Glassware scene; // a lake without a floor: one boundary is all that a ray meets
    scene.sky = {{1, 0.2f, 0}, {0, 0.7f, 1}};
    const int lake = add(scene, Glass{{1.333f}});
    const int mirror = add(scene, Mirror{{0.9f, 0.5f, 0.3f}});
    const int coated = add(scene, Reflective{0.3f, lake, {0.9f, 0.5f, 0.3f}});
    const auto seen = [&](int material) {
        scene.planes = {{vec3(0), normal, material}};
        return radiance(scene, Ray{-arriving(60), arriving(60)}, 4);
    };
    CHECK(seen(coated) == approx(0.7f * seen(lake) + 0.3f * seen(mirror)));
}

TEST_CASE("a matte floor is lit and seen through glass as it is without") {
    Scene scene;
    const int chalk = add(scene, Diffuse{{0.8f, 0.4f, 0.5f}});
    const int squares = add(scene, Checker{{0.8f, 0.4f, 0.5f}, {0.8f, 0.4f, 0.5f}, 0.3f});
    scene.sky = {vec3(0), vec3(1)};
    scene.lights = {{{0, 4, 0}, vec3(20)}};
    for (const int material : {chalk, squares}) {
        scene.planes = {{{0, 0, 0}, {0, 1, 0}, material}};
        scene.spheres = {};
        const Ray ray{{0.5f, 2, 1.5f}, {0.1f, -1, -0.3f}};
        const vec3 bare = radiance(scene, ray, 4);
        CHECK(bare.x > 0.1f);
        scene.spheres = {{{0.6f, 1.2f, 1.25f}, 0.4f, add(scene, Glass{air})}};
        REQUIRE(intersect(scene, ray)->material == scene.spheres[0].material);
        CHECK(radiance(scene, ray, 4) == approx(bare, 1e-4f));
    }
}

// --- scene.h ---

TEST_CASE("of balls, planes and quads a ray meets the nearest in a world with glass, too") {
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
        REQUIRE_MESSAGE(hit, "nothing is met: a kind of shape is not tried");
        CHECK_MESSAGE(hit->material == t,
                      "another shape is met first: one is not tried, or a hit does not shorten the ray");
        CHECK(hit->t == approx(float(t)));
    }
}

TEST_CASE("each kind of shape hides a light, glass as well as chalk") {
    const Ray between{vec3(0), -4.0f * normal, 0, 1}, before{vec3(0), -4.0f * normal, 0, 0.25f};
    const vec3 corner = -2.0f * normal - tangent - binormal;
    Scene round, level, upright;
    round.spheres = {{-2.0f * normal, 0.5f, 0}};
    level.planes = {{-2.0f * normal, normal, 0}};
    upright.quads = {{corner, 2.0f * tangent, 2.0f * binormal, 0}};
    for (Scene* scene : {&round, &level, &upright}) {
        add(*scene, Glass{Medium{1.5f}});
        CHECK_MESSAGE(occluded(*scene, between), "no shadow: a kind of shape is not asked");
        CHECK_MESSAGE(!occluded(*scene, before), "what stands beyond the light hides nothing");
    }
}
