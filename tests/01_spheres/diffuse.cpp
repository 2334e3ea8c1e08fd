// Facts about matte surfaces: what they send back.
#include "tests/check.h"

#include "01_spheres/diffuse.h"

#include "tests/01_spheres/step.h"

using namespace rt;

TEST_CASE("a matte surface sends back albedo / pi of what arrives") {
    const vec3 out = outgoing_radiance(Diffuse{{0.8f, 0.4f, 0.5f}}, vec3(2, 3, pi));
    CHECK_MESSAGE(out == approx(vec3(1.6f / pi, 1.2f / pi, 0.5f)),
                  hint(out.z, {{0.5f * pi, "the 1/pi is missing: everything is three times too bright"},
                               {0.25f, "1/(2 pi) in place of 1/pi"},
                               {0, "nothing comes back"}}));
}

TEST_CASE("a flat surface has its own radiance, whatever light there is") {
    CHECK(outgoing_radiance(emissive({0.2f, 3, 0.7f}), vec3(0)) == approx(vec3(0.2f, 3, 0.7f)));
    CHECK(outgoing_radiance(emissive({0.2f, 3, 0.7f}), vec3(9)) == approx(vec3(0.2f, 3, 0.7f)));
    CHECK_MESSAGE(outgoing_radiance(Diffuse{{0.8f, 0.4f, 0.5f}, {1, 2, 3}}, vec3(pi)) ==
                      approx(vec3(1.8f, 2.4f, 3.5f)),
                  "what a surface sends out by itself is added to what it reflects");
}
