// Facts about diffuse surfaces: what they reflect and what they emit.
#include "tests/check.h"

#include "01_spheres/diffuse.h"

#include "tests/01_spheres/step.h"

using namespace rt;

TEST_CASE("a matte surface reflects albedo / pi of the light that arrives") {
    const vec3 out = outgoing_radiance(Diffuse{{0.8f, 0.4f, 0.5f}}, vec3(2, 3, pi));
    CHECK_MESSAGE(out == approx(vec3(1.6f / pi, 1.2f / pi, 0.5f)),
                  hint(out.z, {{0.5f * pi, "the 1/pi is missing: everything is three times too bright"},
                               {0.25f, "1/(2 pi) instead of 1/pi"},
                               {0, "nothing is reflected"}}));
}

TEST_CASE("an emissive surface has its own radiance, whatever light arrives") {
    CHECK(outgoing_radiance(emissive({0.2f, 3, 0.7f}), vec3(0)) == approx(vec3(0.2f, 3, 0.7f)));
    CHECK(outgoing_radiance(emissive({0.2f, 3, 0.7f}), vec3(9)) == approx(vec3(0.2f, 3, 0.7f)));
    CHECK_MESSAGE(outgoing_radiance(Diffuse{{0.8f, 0.4f, 0.5f}, {1, 2, 3}}, vec3(pi)) ==
                      approx(vec3(1.8f, 2.4f, 3.5f)),
                  "emission is added to the reflected light");
}
