// Facts about the extent of shadows: where they begin and end, and what a lamp inside a ball lights.
#include "tests/check.h"

#include "02_shadows/radiance.h"
#include "02_shadows/scene.h"

#include "tests/02_shadows/step.h"
#include "tests/02_shadows/scenes.h"

using namespace rt;

TEST_CASE("a lamp inside a ball lights its inner side and nothing outside") {
    Scene scene = lit_balls({{somewhere + 0.5f * tilted, vec3(4)}}, {{somewhere, 2, 0}});
    const vec3 within =
        radiance(scene, Ray{somewhere, 0.5f * tilted}); // the wall is 1.5 metres from the lamp
    CHECK_MESSAGE(within == approx(vec3(0.5f / pi * 4 / 2.25f)), "the normal is flipped to the ray's side");
    CHECK(radiance(scene, Ray{somewhere + 5.0f * tilted, -tilted}) == vec3(0));
}

TEST_CASE("the umbra under a ball has the radius H tan(asin(a / (H - h)))") {
    const float a = 0.5f, h = 1.2f, H = 3.4f; // radius of the ball, height of its centre, height of the light
    Scene scene;
    const vec3 foot(2, -1, -3); // on the floor, below both
    scene.planes = {{foot, {0, 1, 0}, add(scene.materials, Diffuse{vec3(0.5f)})}};
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
            hint(bright, {{a, "this is the ball's own radius: the shadow of a light at infinity"},
                          {H * a / (H - h), "H a / (H - h): the light rays graze the ball above its equator"},
                          {0, "no shadow at all"},
                          {3, "no light at all"}}));
    }
}

TEST_CASE("a ball of half a millimetre has its shadow in the correct place") {
    // The light is at 45 degrees: with an epsilon of a millimetre, the shadow ray starts past the ball.
    Scene scene;
    const vec3 foot(0.3f, 0, -0.4f), way = normalize(vec3(0.6f, 1, 0.8f));
    const float radius = 5e-4f;
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, add(scene.materials, Diffuse{vec3(0.5f)})}};
    scene.spheres = {{foot + vec3(0, radius, 0), radius, 0}};
    scene.lights = {{foot + 3.0f * way, vec3(10)}};
    const auto seen = [&](vec3 point) {
        const vec3 view(0.3f, -1, 0.2f);
        return radiance(scene, Ray{point - 0.5f * view, view}).x;
    };
    const vec3 middle =
        scene.spheres[0].center - radius / way.y * way; // where the ray through the centre ends
    CHECK_MESSAGE(seen(middle) == 0, "the shadow is detached from the ball: epsilon is too large");
    CHECK(seen(middle + vec3(0.9f * radius, 0, -0.675f * radius)) > 0); // beside it
}

TEST_CASE("a floor is dark up to the very point where a ball touches it") {
    Scene scene;
    const vec3 touch(1, 0, -2);
    scene.planes = {{touch, {0, 1, 0}, add(scene.materials, Diffuse{vec3(0.5f)})}};
    scene.spheres = {{touch + vec3(0, 0.5f, 0), 0.5f, 0}};
    scene.lights = {{touch + vec3(0, 4, 0), vec3(10)}};
    int lit = 0;
    for (int i = 0; i < 100; ++i) {
        const vec3 point = touch + vec3(0.004f * float(i + 1), 0, 0); // up to .4 metres away
        const vec3 view = normalize(vec3(-1, -0.05f, 0.3f));
        lit += direct_irradiance(scene, make_hit(Ray{point - view, view, 0, 1}, {0, 1, 0}, {0, 0}, 0)) !=
               vec3(0);
    }
    CHECK_MESSAGE(lit == 0, lit << " of 100 points under the ball are lit");
}
