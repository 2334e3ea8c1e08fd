// Facts about a point light: the irradiance that it causes, and what occludes it.
#include "tests/check.h"

#include "02_shadows/point_light.h"
#include "02_shadows/scene.h"

#include "tests/02_shadows/step.h"
#include "tests/02_shadows/scenes.h"

using namespace rt;

TEST_CASE("straight below a light of pi W/sr, at 2 metres, the irradiance is pi / 4") {
    const PointLight light{somewhere + 2.0f * tilted, vec3(pi)};
    const float e = irradiance(light, somewhere, tilted).x;
    CHECK_MESSAGE(
        e == approx(pi / 4),
        hint(
            e,
            {{pi, "no falloff: it must be I cos / r^2"},
             {pi / 2,
              "divided by r, not by r^2, or the cosine is not 1: the vector to the light was not normalised"},
             {pi / 8, "divided by r^3"},
             {pi / 16, "divided by r^4"},
             {0.0625f, "divided by 4 pi r^2: intensity is W/sr, not W"},
             {0, "the cosine was taken with the direction from the light, or with -n"}}));
}

TEST_CASE(
    "where the light arrives at 45 degrees, on the same floor, the irradiance is pi / 8 times the cosine") {
    const PointLight light{somewhere + 2.0f * tilted, vec3(pi)};
    const float e = irradiance(light, somewhere + 2.0f * beside(tilted), tilted).x;
    CHECK_MESSAGE(e == approx(pi / 8 * 0.70710678f),
                  hint(e, {{pi / 8, "the cosine is missing"},
                           {pi / 4, "the vector to the light was not normalised, or there is no falloff"},
                           {pi / 4 * 0.70710678f, "the height was squared, not the distance"},
                           {pi / 16, "the cosine is squared"},
                           {pi * 0.70710678f, "no falloff"}}));
}

TEST_CASE("twice as far from a light, the irradiance is a quarter") {
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

TEST_CASE("a light behind a surface adds nothing to its irradiance") {
    const PointLight light{somewhere + 2.0f * tilted, vec3(pi)};
    const vec3 e = irradiance(light, somewhere, -tilted);
    CHECK_MESSAGE(e == vec3(0), hint(e.x, {{-pi / 4, "a negative cosine subtracts light: use max(cosine, 0)"},
                                           {pi / 4, "the absolute value of the cosine was used"}}));
    CHECK(irradiance(light, somewhere + 5.0f * beside(tilted), -tilted) == vec3(0));
}

TEST_CASE("lights on a cone around the normal cause the same irradiance from every side") {
    for (int i = 0; i < 12; ++i) {
        const float angle = float(i) * pi / 6;
        const vec3 a = beside(tilted), b = cross(tilted, a);
        const vec3 way = 0.6f * tilted + 0.8f * (std::cos(angle) * a + std::sin(angle) * b);
        CHECK(irradiance(PointLight{somewhere + 2.5f * way, vec3(5)}, somewhere, tilted) ==
              approx(vec3(0.48f)));
    }
}

TEST_CASE("a ball between a point and a light blocks all of the light") {
    const vec3 way = normalize(tilted + 0.5f * beside(tilted));
    const Hit hit = hit_at(somewhere, tilted);
    const PointLight light{somewhere + 5.0f * way, vec3(10)};
    const vec3 free = irradiance(light, somewhere, tilted);
    CHECK_MESSAGE(direct_irradiance(lit_balls({light}, {}), hit) == approx(free),
                  "nothing is between the point and the light");
    for (const float where : {0.7f, 2.0f, 4.4f}) { // metres from the point, towards the light
        const Scene scene = lit_balls({light}, {{somewhere + where * way, 0.5f, 0}});
        INFO("the ball is " << where << " metres away, the light is 5 metres away");
        CHECK_MESSAGE(
            direct_irradiance(scene, hit) == vec3(0),
            "lit: the shadow ray is missing, reversed, or too short (t_max = 1 with a unit direction)");
    }
}

TEST_CASE("a ball beyond the light casts no shadow") {
    const vec3 way = normalize(tilted + 0.5f * beside(tilted));
    const Hit hit = hit_at(somewhere, tilted);
    const PointLight light{somewhere + 5.0f * way, vec3(10)};
    for (const float where : {5.6f, 8.0f, 25.0f}) {
        const Scene scene = lit_balls({light}, {{somewhere + where * way, 0.5f, 0}});
        INFO("the ball is " << where << " metres away, the light is 5 metres away");
        CHECK_MESSAGE(direct_irradiance(scene, hit) == approx(irradiance(light, somewhere, tilted)),
                      "a shadow ray is a segment that ends at the light");
    }
}

TEST_CASE("a light closer than a metre is occluded only by what is between") {
    // If the direction is the whole vector to the light, t_max is 1; t_max = r
    // would be wrong by the factor r.
    const Hit hit = hit_at(somewhere, tilted);
    const PointLight light{somewhere + 0.4f * tilted, vec3(1)};
    CHECK(direct_irradiance(lit_balls({light}, {{somewhere + 0.2f * tilted, 0.05f, 0}}), hit) == vec3(0));
    CHECK(direct_irradiance(lit_balls({light}, {{somewhere + 0.6f * tilted, 0.05f, 0}}), hit) ==
          approx(irradiance(light, somewhere, tilted)));
}

TEST_CASE("a ball on the other side of the point casts no shadow on it") {
    const Hit hit = hit_at(somewhere, tilted);
    const PointLight light{somewhere + 3.0f * tilted, vec3(10)};
    const Scene behind = lit_balls({light}, {{somewhere - 1.5f * tilted, 1, 0}});
    CHECK_MESSAGE(direct_irradiance(behind, hit) == approx(irradiance(light, somewhere, tilted)),
                  "the shadow ray points the wrong way");
    const Scene aside = lit_balls({light}, {{somewhere + 1.5f * tilted + 1.1f * beside(tilted), 1, 0}});
    CHECK(direct_irradiance(aside, hit) == approx(irradiance(light, somewhere, tilted)));
}

TEST_CASE("a wall blocks the light behind it") {
    Scene scene = lit_balls({{somewhere + 3.0f * tilted, vec3(10)}}, {});
    scene.planes = {{somewhere + 2.0f * tilted, normalize(tilted + 0.4f * beside(tilted)), 0}};
    const Hit hit = make_hit(Ray{somewhere + tilted, -tilted, 0, 1}, tilted, {0, 0}, 0);
    CHECK(direct_irradiance(scene, hit) == vec3(0));
    scene.planes[0].point = somewhere + 4.5f * tilted;
    CHECK_MESSAGE(direct_irradiance(scene, hit) == approx(vec3(10.0f / 9)), "the wall is beyond the light");
}

TEST_CASE("each light has its own shadow") {
    const Hit hit = hit_at(somewhere, tilted);
    const vec3 left = normalize(tilted - beside(tilted)), right = normalize(tilted + beside(tilted));
    const PointLight red{somewhere + 4.0f * left, {8, 0, 0}}, blue{somewhere + 4.0f * right, {0, 0, 8}};
    const float share = 0.5f * 0.70710678f; // 8 / 16, at 45 degrees
    CHECK(direct_irradiance(lit_balls({red, blue}, {}), hit) == approx(vec3(share, 0, share)));
    CHECK(direct_irradiance(lit_balls({blue, red}, {}), hit) == approx(vec3(share, 0, share)));
    CHECK(direct_irradiance(lit_balls({red, blue}, {{somewhere + 2.0f * left, 0.5f, 0}}), hit) ==
          approx(vec3(0, 0, share)));
    CHECK(direct_irradiance(lit_balls({red, blue}, {{somewhere + 2.0f * right, 0.5f, 0}}), hit) ==
          approx(vec3(share, 0, 0)));
}
