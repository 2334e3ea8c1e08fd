// Facts about explanations of renders of a scene that is in no chapter: shifted, turned and zoomed.
#include "01_spheres/camera.h"
#include "02_shadows/radiance.h"
#include "02_shadows/scene.h"
#include "tests/compare/pictures.h"

#include <doctest/doctest.h>

using namespace rt;
using namespace rt::compare;

namespace {

Scene three_balls() {
    Scene scene;
    scene.sky = {.nadir = {0.2f, 0.2f, 0.25f}, .zenith = {0.05f, 0.1f, 0.3f}};
    const int clay = add(scene.materials, Diffuse{{0.7f, 0.4f, 0.25f}});
    const int slate = add(scene.materials, Diffuse{{0.3f, 0.35f, 0.45f}});
    const int floor = add(scene.materials, Checkerboard{{0.7f, 0.7f, 0.6f}, {0.2f, 0.25f, 0.3f}, 0.8f});
    scene.lights = {{{-2, 4, 3}, vec3(40, 36, 30)}};
    scene.spheres = {
        {{-0.8f, 0.7f, 0}, 0.7f, clay}, {{0.9f, 0.5f, 0.8f}, 0.5f, slate}, {{0.4f, 1.3f, -1}, 0.6f, clay}};
    scene.planes = {{{0, 0, 0}, {0, 1, 0}, floor}};
    return scene;
}

struct View {
    float fov = 40;
    vec3 up{0, 1, 0};
    vec2 offset{0.0f}; ///< of all rays, in pixels
};

Image render(const View& view) {
    static const Scene scene = three_balls();
    Image image(240, 150);
    const LookAt look_at{.from = {0.6f, 1.6f, 4.5f}, .at = {0, 0.6f, 0}, .up = view.up, .fov = view.fov};
    const Camera camera = make_camera(look_at, image.width, image.height);
    constexpr int samples = 16;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int i = 0; i < samples; ++i)
                image(x, y) += radiance(scene, camera_ray(camera, vec2(x, y) + view.offset + r2_offset(i))) /
                               float(samples);
    return image;
}

/// Returns the explanations of the picture as it is, and as a noisy one.
std::vector<std::string> explained(const View& view) {
    static const Image right = render({});
    const Image wrong = render(view);
    const NoisyPicture a(wrong, 1), b(right, 2);
    return {explain({wrong}, {right}, {}), explain({a.mean}, {b.mean}, {a.variance, b.variance})};
}

std::vector<std::string> twice(const std::string& words) {
    return {words, words};
}

} // namespace

TEST_CASE("a render that is shifted by half a pixel is explained") {
    CHECK(explained({.offset = {-0.5f, -0.5f}})[0] == "shifted half a pixel to the right and down");
    CHECK(explained({.offset = {0.5f, 0}})[0] == "shifted half a pixel to the left");
    CHECK(explained({.offset = {0, 1}})[0] == none_of_these);
}

TEST_CASE("a render that is upside down is explained although its samples are elsewhere in the pixels") {
    CHECK(explained({.up = {0, -1, 0}}) == twice("rotated by 180 degrees (flipped in x and y)"));
    CHECK(explained({.up = {0, -1, 0}, .offset = {0.5f, 0}}) ==
          twice("rotated by 180 degrees (flipped in x and y)"));
}

TEST_CASE("a render with another field of view is explained with its factor") {
    // tan(20) / tan(14) and tan(25) / tan(20)
    CHECK(explained({.fov = 28}) == twice("zoomed in about the middle by a factor of 1.46"));
    CHECK(explained({.fov = 50}) == twice("zoomed out about the middle by a factor of 1.28"));
}
