// Facts about absorption: how much light tinted glass absorbs, along which path, and where it does not.
#include "04_refraction/radiance.h"
#include "tests/04_refraction/scenes.h"

using namespace rt;

TEST_CASE("a tinted ball absorbs along the chord of a ray") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    const Glassware scene = ball_of(Dielectric{{1, absorption}}); // n = 1, so the chord is straight
    for (const float offset : {0.0f, 0.3f, 0.6f, 0.9f}) {
        INFO("offset ", offset);
        const float chord = 2 * radius * std::sqrt(1 - offset * offset);
        CHECK_MESSAGE(radiance(scene, ray_beside(offset), 4) == approx(exp(-absorption * chord), 1e-4f),
                      "exp(-a chord / 2): t is in multiples of the direction, whose length is 2 here; 1: "
                      "nothing is absorbed; less: light is absorbed outside as well");
    }
}

TEST_CASE("a refracted ray is absorbed along its refracted path") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    const Glassware scene = ball_of(Dielectric{{1.5f, absorption}});
    const float f = 0.0415226f;                                            // at 30 degrees
    const float chord = 2 * radius * std::sqrt(1 - 0.25f / (1.5f * 1.5f)); // sin_t = sin_i / n
    CHECK_MESSAGE(radiance(scene, ray_beside(0.5f), 2) ==
                      approx(vec3(f) + (1 - f) * (1 - f) * exp(-absorption * chord), 1e-5f),
                  "the part reflected at the outside is not tinted");
}

TEST_CASE("light that is reflected inside tinted glass is absorbed further") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    const Glassware scene = ball_of(Dielectric{{1.5f, absorption}});
    const vec3 once = exp(-absorption * 2.0f * radius);
    CHECK(radiance(scene, ray_beside(0), 3) ==
          approx(vec3(0.04f) + 0.96f * 0.96f * once + 0.96f * 0.96f * 0.04f * once * once));
}

TEST_CASE("tinted glass absorbs inside and nowhere else") {
    const Glassware scene = ball_of(Dielectric{{1.5f, {0.1f, 0.35f, 0.8f}}});
    const vec3 near = radiance(scene, ray_beside(0.4f), 6);
    Ray far = ray_beside(0.4f);
    far.origin += 50.0f * normal;
    CHECK_MESSAGE(radiance(scene, far, 6) == approx(near, 2e-4f), "the path through the air must not count");
    CHECK_MESSAGE(radiance(scene, ray_beside(1.5f), 6) == approx(vec3(1)), "this ray passes beside the ball");
    CHECK(radiance(scene, ray_beside(0.4f), 1).x == approx(radiance(scene, ray_beside(0.4f), 1).z));
}

TEST_CASE("an object inside tinted glass is seen only through the glass in front of it") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    Glassware scene = ball_of(Dielectric{{1, absorption}});
    scene.spheres.push_back({center, 0.25f * radius, add(scene.materials, emissive({0.5f, 2, 1}))});
    CHECK(radiance(scene, ray_beside(0), 4) ==
          approx(vec3(0.5f, 2, 1) * exp(-absorption * 0.75f * radius), 1e-4f));
}

TEST_CASE("a bubble in tinted glass does not absorb, but the glass around it does") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    const Medium tinted{1, absorption};
    Glassware scene = ball_of(Dielectric{tinted});
    scene.spheres.push_back({center, 0.6f * radius, add(scene.materials, Dielectric{air, tinted})});
    CHECK_MESSAGE(radiance(scene, ray_beside(0), 5) == approx(exp(-absorption * 2.0f * 0.4f * radius), 1e-4f),
                  "each boundary states the medium beyond it: after the bubble the ray is in glass again");
}

TEST_CASE("light to and from a mirror inside tinted glass is absorbed both ways") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    const vec3 expected = vec3(0.5f, 0.6f, 0.7f) * exp(-absorption * 2.0f * 0.75f * radius);
    Glassware scene = ball_of(Dielectric{{1, absorption}});
    scene.spheres.push_back({center, 0.25f * radius, add(scene.materials, Mirror{{0.5f, 0.6f, 0.7f}})});
    CHECK(radiance(scene, ray_beside(0), 5) == approx(expected, 1e-4f));

    const int black = add(scene.materials, Diffuse{vec3(0)});
    scene.spheres.back().material = add(scene.materials, Coated{1, black, {0.5f, 0.6f, 0.7f}});
    CHECK(radiance(scene, ray_beside(0), 5) == approx(expected, 1e-4f));
}

TEST_CASE("light that glass under a coat reflects inside tinted glass is absorbed both ways too") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    const Medium tinted{1, absorption};
    Glassware scene = ball_of(Dielectric{tinted});
    const int inner = add(scene.materials, Dielectric{glass_15, tinted});
    scene.spheres.push_back({center, 0.25f * radius, add(scene.materials, Coated{0, inner})});
    // Three boundaries: in, reflection at the inner ball, out. All other paths cross more.
    CHECK(radiance(scene, ray_beside(0), 3) ==
          approx(0.04f * exp(-absorption * 2.0f * 0.75f * radius), 1e-5f));
}

TEST_CASE("a camera inside a medium sees through it") {
    const vec3 absorption{0.1f, 0.35f, 0.8f};
    Glassware scene = white_furnace();
    const Ray ray{{1, 2, 3}, -2.0f * normal};
    CHECK_MESSAGE(radiance(scene, ray, 4, absorption) == approx(vec3(0)),
                  "an infinite absorbing medium is black");
    CHECK_MESSAGE(radiance(scene, ray, 4) == approx(vec3(1)), "a clear medium is not black");
    scene.spheres = {{vec3(1, 2, 3) - 4.0f * normal, 1.5f, add(scene.materials, emissive({0.5f, 2, 1}))}};
    CHECK(radiance(scene, ray, 4, absorption) == approx(vec3(0.5f, 2, 1) * exp(-absorption * 2.5f)));
}
