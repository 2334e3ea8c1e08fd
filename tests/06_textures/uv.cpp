// Facts about uv coordinates on a sphere, and about a checkerboard that uses them.
#include "01_spheres/checkerboard.h"
#include "01_spheres/sphere.h"
#include "tests/check.h"

using namespace rt;

TEST_CASE("on a sphere v is 0 at the south pole, .5 at the equator and 1 at the north pole") {
    CHECK_MESSAGE(sphere_uv({0, -1, 0}).y == approx(0), "1: upside down");
    CHECK(sphere_uv({0, 1, 0}).y == approx(1));
    CHECK(sphere_uv(normalize(vec3(3, 0, -2))).y == approx(0.5f));
    CHECK_MESSAGE(sphere_uv(normalize(vec3(0.6f, 1, -0.8f))).y == approx(0.75f),
                  "45 degrees north is halfway from the equator: v depends on the angle, not on y (.854)");
    CHECK(sphere_uv(normalize(vec3(1.2f, -1, 1.6f))).y == approx(0.5f - std::atan(0.5f) / pi));
}

TEST_CASE("on a sphere u grows eastward from 0 to 1") {
    float previous = -1;
    for (int i = 1; i < 360; ++i) {
        // Seen from outside with north up, east is to the right: from +z to +x, seen from between them.
        const float east = glm::radians(float(i) - 90);
        const float u = sphere_uv({0.8f * std::sin(east), 0.6f, 0.8f * std::cos(east)}).x;
        if (!(u >= 0 && u <= 1)) FAIL_CHECK("u = ", u, " is outside [0, 1]");
        if (!(u > previous))
            FAIL_CHECK("u falls from ", previous, " to ", u, " at ", i, " degrees: a mirrored globe");
        previous = u;
    }
    CHECK(sphere_uv({0, 0, 1}).x == approx(sphere_uv({1, 0, 0}).x - 0.25f));
}

TEST_CASE("a point that rounding moves beyond a pole still has valid uv coordinates") {
    for (const float y : {1.0000001f, -1.0000001f, 1.0f, -1.0f}) {
        const vec2 uv = sphere_uv({0, y, 0});
        INFO("y = ", y, ": uv = ", uv);
        CHECK_MESSAGE(std::isfinite(uv.x), "asin of a value above 1 is NaN");
        CHECK(uv.y == approx(y > 0 ? 1 : 0));
    }
}

TEST_CASE("a checkerboard changes at every square including at zero") {
    const Checkerboard checkerboard{vec3(0.8f), vec3(0.15f), 0.5f};
    for (int y = -5; y < 5; ++y) {
        for (int x = -5; x < 5; ++x) {
            INFO("square ", x, ", ", y);
            CHECK_MESSAGE(evaluate(checkerboard, {(float(x) + 0.3f) / 2, (float(y) + 0.7f) / 2}).albedo.x ==
                              ((x + y) % 2 == 0 ? 0.8f : 0.15f),
                          "a cast to int merges the two squares beside zero");
        }
    }
}
