// Facts about the sky: its radiance, and the irradiance on a surface below it.
#include "tests/check.h"

#include "01_spheres/sky.h"

#include "tests/01_spheres/step.h"

using namespace rt;
using glm::dvec3;

TEST_CASE("the sky changes linearly from nadir to zenith") {
    const Sky sky{{0.1f, 0.2f, 0.9f}, {0.7f, 0.4f, 0.1f}};
    CHECK(radiance(sky, {0, 3, 0}) == approx(sky.zenith));
    CHECK(radiance(sky, {0, -0.2f, 0}) == approx(sky.nadir));
    CHECK(radiance(sky, {5, 0, -2}) == approx(0.5f * (sky.nadir + sky.zenith)));
    const vec3 got = radiance(sky, {3, 3, std::sqrt(18.0f)}); // 30 degrees above the horizon, length 6
    CHECK_MESSAGE(got == approx(0.25f * sky.nadir + 0.75f * sky.zenith),
                  "linear in the height of the unit direction: 1/4 nadir + 3/4 zenith");
}

TEST_CASE("a tilted sky is brightest along its own up") {
    const vec3 up = vec3(2, -3, 6) / 7.0f, across = vec3(3, 6, 2) / 7.0f;
    const Sky sky{{0.1f, 0.2f, 0.9f}, {0.7f, 0.4f, 0.1f}, up};
    CHECK(radiance(sky, 5.0f * up) == approx(sky.zenith));
    CHECK(radiance(sky, -0.2f * up) == approx(sky.nadir));
    CHECK(radiance(sky, 3.0f * across) == approx(0.5f * (sky.nadir + sky.zenith)));
    CHECK(radiance(sky, 0.6f * up - 0.8f * across) == approx(0.2f * sky.nadir + 0.8f * sky.zenith));
}

TEST_CASE("the irradiance from the whole sky is the integral of its radiance times the cosine") {
    const Sky level{{0.1f, 0.2f, 0.9f}, {0.7f, 1.4f, 0.1f}};
    const Sky tilted{level.nadir, level.zenith, vec3(-6, 2, 3) / 7.0f};
    for (const vec3 normal : {vec3(2, 3, 6) / 7.0f, vec3(6, -3, 2) / 7.0f, vec3(-2, -6, 3) / 7.0f,
                              vec3(0, 1, 0), vec3(0, -1, 0), vec3(1, 0, 0)}) {
        const vec3 a = beside(normal), b = cross(normal, a);
        dvec3 of_level(0), of_tilted(0);
        const int rings = 200, sectors = 16;
        for (int i = 0; i < rings; ++i)
            for (int j = 0; j < sectors; ++j) {
                const float theta = (float(i) + 0.5f) / rings * pi / 2;
                const float phi = (float(j) + 0.5f) / sectors * 2 * pi;
                const vec3 w =
                    std::cos(theta) * normal + std::sin(theta) * (std::cos(phi) * a + std::sin(phi) * b);
                const float weight = std::cos(theta) * std::sin(theta);
                of_level += dvec3(weight * radiance(level, w));
                of_tilted += dvec3(weight * radiance(tilted, w));
            }
        const double step = (pi / 2 / rings) * (2 * pi / sectors);
        INFO("normal " << to_text(normal));
        CHECK(irradiance(level, normal) == approx(vec3(step * of_level), 1e-4f));
        CHECK(irradiance(tilted, normal) == approx(vec3(step * of_tilted), 1e-4f));
    }
}

TEST_CASE("under a uniform sky the irradiance on every surface is pi times the radiance") {
    const Sky sky{{0.5f, 2, 0.25f}, {0.5f, 2, 0.25f}};
    for (const vec3 normal : {vec3(2, 3, 6) / 7.0f, vec3(-2, -6, 3) / 7.0f})
        CHECK(irradiance(sky, normal) == approx(pi * vec3(0.5f, 2, 0.25f)));
}
