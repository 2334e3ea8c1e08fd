// Facts about the radiance along a ray: light from lamps and sky, reflected by the closest surface.
#include "tests/check.h"

#include "02_shadows/radiance.h"
#include "02_shadows/scene.h"

#include <algorithm>
#include <vector>

#include "tests/02_shadows/step.h"

using namespace rt;

TEST_CASE("a floor of albedo .5 at an irradiance of pi / 4 shows a radiance of .125") {
    Scene scene;
    scene.planes = {{somewhere, tilted, add(scene.materials, Diffuse{vec3(0.5f, 0.8f, 0.4f)})}};
    scene.lights = {{somewhere + 2.0f * tilted, vec3(pi)}};
    const vec3 aslant = -2.0f * tilted + 1.5f * beside(tilted);
    const vec3 seen = radiance(scene, Ray{somewhere - 0.7f * aslant, aslant});
    CHECK_MESSAGE(seen == approx(vec3(0.125f, 0.2f, 0.1f)),
                  hint(seen.x, {{0.125f * pi, "the 1/pi of Lambert's law is missing"},
                                {0.5f, "no falloff"},
                                {0.25f, "divided by r, or the vector to the light was not normalised"},
                                {0, "black: the floor shadows itself, or the shadow test is inverted"}}));
}

TEST_CASE("matte surfaces look equally bright from every direction") {
    Scene scene;
    scene.planes = {{somewhere, tilted, add(scene.materials, Diffuse{vec3(0.5f)})}};
    scene.lights = {{somewhere + 2.0f * tilted + 1.0f * beside(tilted), vec3(7)}};
    const vec3 straight = radiance(scene, Ray{somewhere + tilted, -tilted});
    const vec3 grazing = 0.1f * tilted + 3.0f * beside(tilted);
    CHECK(radiance(scene, Ray{somewhere + grazing, -2.0f * grazing}) == approx(straight));
}

TEST_CASE("a floor seen from below is lit only by the lights below it") {
    Scene scene;
    scene.planes = {{somewhere, tilted, add(scene.materials, Diffuse{vec3(0.5f)})}};
    const PointLight above{somewhere + 2.0f * tilted, vec3(pi)},
        below{somewhere - 2.0f * tilted, vec3(3 * pi)};
    const Ray from_above{somewhere + tilted, -0.5f * tilted}, from_below{somewhere - tilted, 0.5f * tilted};
    scene.lights = {above, below};
    CHECK(radiance(scene, from_above) == approx(vec3(0.125f)));
    CHECK(radiance(scene, from_below) == approx(vec3(0.375f)));
}

namespace {

/// Builds balls over a checkerboard floor under a black sky, without lights.
Scene room() {
    Scene scene;
    const int chalk = add(scene.materials, Diffuse{{0.8f, 0.4f, 0.6f}});
    const int lamp = add(scene.materials, Diffuse{{0.3f, 0.3f, 0.3f}, {0.5f, 0.2f, 0}});
    const int floor = add(scene.materials, Checkerboard{{0.7f, 0.6f, 0.5f}, {0.2f, 0.3f, 0.4f}, 0.5f});
    scene.spheres = {
        {{0, 0.9f, 0}, 0.9f, chalk}, {{1.5f, 0.6f, 0.7f}, 0.4f, chalk}, {{-1.5f, 0.5f, 0.6f}, 0.5f, lamp}};
    scene.planes = {{{0, 0, 0}, {0.1f, 0.99f, -0.0994987f}, floor}};
    return scene;
}

/// Renders a small picture of the scene, row by row.
std::vector<vec3> picture(const Scene& scene) {
    std::vector<vec3> pixels;
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 80; ++x)
            pixels.push_back(radiance(
                scene, Ray{{0.2f, 2.4f, 6.2f}, {0.01f * float(x - 40), -0.01f * float(y - 10), -1.3f}}));
    return pixels;
}

} // namespace

TEST_CASE("the picture lit by two lights is the sum of the pictures lit by each") {
    const PointLight warm{{-2.2f, 3, 2}, {9, 6.5f, 4}}, cool{{3.2f, 2.2f, 1.2f}, {2, 3, 5}};
    Scene a = room(), b = room(), both = room();
    for (Scene* scene : {&a, &b, &both}) scene->materials[1] = Diffuse{vec3(0.3f)}; // no emission
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
    CHECK_MESSAGE(worst <= 1e-6f, "light must add up; off by "
                                      << worst << ". Is an ambient constant counted once per light?");
    CHECK(lit > 500); // enough cases to check
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

TEST_CASE("without lights a white matte ball is invisible under a uniform sky") {
    Scene scene{.sky = {{0.5f, 2, 0.25f}, {0.5f, 2, 0.25f}}};
    scene.spheres = {{somewhere, 2, add(scene.materials, Diffuse{vec3(1)})}};
    const vec3 seen = radiance(scene, Ray{somewhere + vec3(4, 3, 5), {-0.7f, -0.5f, -1}});
    CHECK_MESSAGE(seen == approx(vec3(0.5f, 2, 0.25f)),
                  hint(seen.x, {{0, "the light of the sky was left out"},
                                {1, "the light of the sky was added twice"}}));
}

TEST_CASE("twice the intensity gives twice the light and no light gives black") {
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
    CHECK_MESSAGE(!negative, "light was subtracted: a negative cosine");
}

TEST_CASE("a surface in shadow still shows its own emission") {
    Scene scene;
    scene.spheres = {{{0, 0, -5}, 1, add(scene.materials, Diffuse{vec3(0.5f), {3, 2, 1}})}};
    scene.lights = {{{0, 0, -9}, vec3(100)}}; // behind the ball
    CHECK(radiance(scene, Ray{{0, 0, 0}, {0, 0, -2}}) == approx(vec3(3, 2, 1)));
}

TEST_CASE("each shape has its own material and the closest one is visible") {
    Scene scene;
    const int red = add(scene.materials, emissive({1, 0, 0})),
              green = add(scene.materials, emissive({0, 1, 0}));
    scene.spheres = {{{0, 0, -9}, 3, red}, {{0, 0, -3}, 1, green}};
    CHECK(radiance(scene, Ray{{0, 0, 0}, {0, 0, -2}}) == approx(vec3(0, 1, 0)));
    CHECK(radiance(scene, Ray{{0, 0, -5}, {0, 0, -2}}) == approx(vec3(1, 0, 0)));
}

TEST_CASE("a lit checkerboard floor shows the colours of its squares") {
    Scene scene;
    scene.planes = {{{0, 0, 0},
                     {0, 1, 0},
                     add(scene.materials, Checkerboard{{0.8f, 0.2f, 0.1f}, {0.1f, 0.4f, 0.3f}, 0.5f})}};
    scene.lights = {{{0.7f, 2, -0.3f}, vec3(pi)}};
    CHECK(radiance(scene, Ray{{0.7f, 1, -0.3f}, {0, -0.5f, 0}}) == approx(vec3(0.1f, 0.4f, 0.3f) / 4.0f));
    scene.lights = {{{-0.2f, 2, 0.3f}, vec3(pi)}};
    CHECK(radiance(scene, Ray{{-0.2f, 1, 0.3f}, {0, -0.5f, 0}}) == approx(vec3(0.8f, 0.2f, 0.1f) / 4.0f));
}

TEST_CASE("a ray that hits nothing sees the sky and not the lights") {
    Scene scene{.sky = {{0.1f, 0.2f, 0.9f}, {0.7f, 0.4f, 0.1f}}};
    scene.lights = {{{0, 0, -2}, vec3(100)}};
    CHECK(radiance(scene, Ray{{0, 0, 0}, {0, 0, -3}}) == approx(vec3(0.4f, 0.3f, 0.5f)));
}

namespace {
/// A scene of a different type: an infinite floor, and a roof over x > 0 as the only occluder.
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

TEST_CASE("light travels in any scene type that answers closest-hit and any-hit queries") {
    CHECK(radiance(Porch{}, Ray{{0.5f, 1, 0}, {0, -2, 0}}) == vec3(0));
    const float cosine = 4 / std::sqrt(17.0f);
    CHECK(radiance(Porch{}, Ray{{-0.5f, 1, 0}, {0, -2, 0}}) == approx(vec3(4 * cosine / 17)));
}
