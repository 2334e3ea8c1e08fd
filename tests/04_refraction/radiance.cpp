// Facts about light that splits at glass: energy is conserved, and each boundary costs depth.
#include "04_refraction/radiance.h"
#include "tests/04_refraction/scenes.h"

using namespace rt;

TEST_CASE("total reflection at a bubble shows the sky as a mirror would") {
    Glassware scene = ball_of(bubble);
    scene.sky = {{1, 0, 0.2f}, {0, 0.5f, 0.9f}};
    const Ray ray = ray_beside(0.8f);
    const auto hit = intersect(scene, ray);
    REQUIRE(hit);
    CHECK_MESSAGE(radiance(scene, ray, 5) ==
                      approx(radiance(scene.sky, reflect(ray.direction, hit->shading_normal))),
                  "black: the reflected ray carries all of the light, so nothing may be subtracted from it");
}

TEST_CASE("each boundary costs one level of depth, and light beyond the last is ignored") {
    const Glassware scene = ball_of(ball);
    const Ray ray = ray_beside(0);
    CHECK_MESSAGE(radiance(scene, ray, 0) == approx(vec3(0)), "the ray may not cross any boundary");
    CHECK_MESSAGE(radiance(scene, ray, 1) == approx(vec3(0.04f)),
                  "only the reflection at the front; .96: R and T are swapped");
    CHECK_MESSAGE(radiance(scene, ray, 2) == approx(vec3(0.9616f)),
                  ".04 + .96 .96; 2 or 1.96: the weights are missing");
    CHECK(radiance(scene, ray, 3) == approx(vec3(0.998464f)));
}

TEST_CASE(
    "a slab of glass transmits .923077 of the light and reflects the rest including all inner bounces") {
    const Ray ray{1.3f * normal + 0.4f * tangent, -2.0f * normal};
    Glassware scene = slab_of(glass_15, 0.7f);
    scene.planes.push_back({-2.0f * normal, normal, add(scene.materials, emissive(vec3(1)))});
    CHECK_MESSAGE(radiance(scene, ray, 60) == approx(vec3(0.923077f)),
                  "(1 - F) / (1 + F); .9216: the inner bounces are missing; .96: only one side reflects");
    scene.planes.back().point = 2.0f * normal;
    CHECK_MESSAGE(radiance(scene, ray, 60) == approx(vec3(0.0769231f)), "the lamp is behind the camera now");
}

TEST_CASE("a slab seen at 60 degrees transmits (1 - F) / (1 + F)") {
    Glassware scene = slab_of(glass_15, 0.7f);
    scene.planes.push_back({-2.0f * normal, normal, add(scene.materials, emissive(vec3(1)))});
    const float f = 0.0891867f;
    CHECK(radiance(scene, Ray{-arriving(60), arriving(60)}, 60) == approx(vec3((1 - f) / (1 + f))));
}

TEST_CASE("a clear ball is invisible in a white furnace") {
    // Depth d cuts off less than F^(d - 2): at offset .99, F is .49, so the rest is negligible after 60.
    for (const float ior : {1.0f, 1.333f, 1.5f, 2.417f}) {
        const Glassware scene = ball_of(Dielectric{{ior}});
        for (float offset = 0; offset < 0.992f; offset += 0.03f) {
            INFO("n = ", ior, ", offset ", offset);
            CHECK_MESSAGE(radiance(scene, ray_beside(offset), 60) == approx(vec3(1), 1e-4f),
                          "more: reflected and refracted light exceed the incoming light, or L / n^2 is "
                          "scaled; less: light is lost at a boundary");
        }
    }
}

TEST_CASE("an air bubble in glass is invisible in a white furnace") {
    for (float offset = 0; offset < 0.999f; offset += 0.03f) {
        INFO("offset ", offset, ", total reflection begins at .6667");
        CHECK_MESSAGE(radiance(ball_of(bubble), ray_beside(offset), 60) == approx(vec3(1), 1e-4f),
                      "black from .6667 on: total reflection must be visible");
    }
}

TEST_CASE("a single boundary is invisible in a white furnace from air and from glass") {
    Glassware scene = white_furnace();
    scene.planes = {{vec3(0), normal, add(scene.materials, ball)}};
    for (const float degrees : {0.0f, 30.0f, 41.0f, 60.0f, 85.0f}) {
        INFO("at ", degrees, " degrees");
        const std::string hint =
            "2.25 or .44 or similar: the unit of light is L / n^2 here, which no boundary changes";
        CHECK_MESSAGE(radiance(scene, Ray{-arriving(degrees), arriving(degrees)}, 2) == approx(vec3(1)),
                      hint);
        const vec3 upward = -arriving(degrees);
        CHECK_MESSAGE(radiance(scene, Ray{-upward, upward}, 2) == approx(vec3(1)), hint);
    }
}

TEST_CASE("a bubble inside a ball is invisible in a white furnace") {
    // Light that crosses the shell back and forth uses up the depth: 20 boundaries cut off less than 1e-3,
    // except for rays that just graze the bubble or the ball. The value never exceeds 1.
    Glassware scene = ball_of(ball);
    scene.spheres.push_back({center + vec3(0.2f, 0, 0), 0.7f * radius, add(scene.materials, bubble)});
    for (float offset = -0.95f; offset < 0.96f; offset += 0.1f) {
        INFO("offset ", offset);
        const vec3 light = radiance(scene, ray_beside(offset), 20);
        CHECK(light.x <= 1.0001f);
        CHECK(light.x >= 0.999f);
    }
}

TEST_CASE("glass within glass of the same kind is invisible") {
    Glassware without = ball_of(ball);
    without.sky = {{1, 0.2f, 0}, {0, 0.7f, 1}};
    Glassware with = without;
    with.spheres.push_back({center, 0.7f * radius, add(with.materials, Dielectric{glass_15, glass_15})});
    for (float offset = 0; offset < 0.95f; offset += 0.11f) {
        INFO("offset ", offset);
        CHECK(radiance(with, ray_beside(offset), 4) ==
              approx(radiance(without, ray_beside(offset), 2), 1e-4f));
    }
}

TEST_CASE("a ball of air in air is invisible") {
    Glassware scene = ball_of(Dielectric{air});
    scene.sky = {{1, 0.2f, 0}, {0, 0.7f, 1}};
    for (float offset = 0; offset < 0.999f; offset += 0.037f) {
        INFO("offset ", offset);
        CHECK_MESSAGE(radiance(scene, ray_beside(offset), 6) == approx(radiance(scene.sky, -normal), 1e-4f),
                      "at eta = 1 the ray continues straight through both sides");
    }
}

TEST_CASE("light never increases and is never NaN at any angle and index") {
    for (const float ior : {1.0f, 1.00001f, 1.0003f, 1.1f, 1.333f, 1.5f, 2.417f, 4.0f}) {
        for (const Dielectric& glass : {Dielectric{{ior}}, Dielectric{air, {ior}}}) {
            const Glassware scene = ball_of(glass);
            for (int i = 0; i <= 400; ++i) {
                // All offsets, then ever closer to the rim.
                const float offset = i <= 200 ? float(i) / 200 : 1 - std::exp2(-float(i - 200) / 8);
                const vec3 light = radiance(scene, ray_beside(offset), 12);
                if (!(light.x >= 0 && light.x <= 1.0001f))
                    FAIL_CHECK("n = ", ior, ", offset ", offset, ": got ", light, " in a white furnace");
            }
        }
    }
}
