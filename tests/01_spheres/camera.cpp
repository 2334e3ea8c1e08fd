// Facts about the camera: the rays that it sends through the points of an image.
#include "tests/check.h"

#include "01_spheres/camera.h"

#include <set>
#include <utility>

#include "tests/01_spheres/step.h"

using namespace rt;

TEST_CASE("the ray through the centre of an even-sized picture points exactly along -z") {
    const Camera camera = make_camera({}, 200, 100);
    const Ray ray = camera_ray(camera, {100, 50});
    CHECK_MESSAGE(ray.direction == vec3(0, 0, -1), "(0, 0, 1): +z was taken as forward. A small deviation: "
                                                   "the picture spans 0 to 200, so its centre is at 100");
    CHECK(ray.origin == vec3(0, 0, 0));
    CHECK(ray.t_min == 0);
    CHECK(ray.t_max == infinity);
}

TEST_CASE("at a field of view of 90 degrees the top ray leaves at 45 degrees") {
    const vec3 top = camera_ray(make_camera({.fov = 90}, 200, 100), {100, 0}).direction;
    const float slope = top.y / -top.z;
    CHECK_MESSAGE(
        slope == approx(1),
        hint(slope, {{-1, "the picture is upside down"},
                     {1.6197752f, "tan(45): the angle in degrees was used as radians"},
                     {-1.9952004f, "tan(90): the angle in degrees was used as radians, and not halved"},
                     {0.5f, "the field of view is vertical: the aspect ratio applies to the width"},
                     {2, "the field of view is vertical: the aspect ratio applies to the width"}}));
    CHECK(camera_ray(make_camera({.fov = 90}, 200, 100), {100, 100}).direction.y / -top.z == approx(-1));
}

TEST_CASE("the edge of a picture twice as wide as high has twice the slope") {
    const vec3 right = camera_ray(make_camera({.fov = 90}, 200, 100), {200, 50}).direction;
    const float slope = right.x / -right.z;
    CHECK_MESSAGE(slope == approx(2), hint(slope, {{1, "the aspect ratio was ignored: balls become ellipses"},
                                                   {0.5f, "the aspect ratio is inverted: height / width"},
                                                   {-2, "the picture is mirrored"}}));
    const vec3 narrow = camera_ray(make_camera({.fov = 90}, 100, 200), {100, 100}).direction;
    CHECK_MESSAGE(narrow.x / -narrow.z == approx(0.5f),
                  "the field of view is vertical in a tall picture, too");
}

TEST_CASE("the field of view is the angle from the lower to the upper edge") {
    for (const float fov : {10.0f, 40.0f, 120.0f, 170.0f}) {
        const Camera camera = make_camera({.fov = fov}, 300, 200);
        const vec3 top = camera_ray(camera, {150, 0}).direction;
        const vec3 bottom = camera_ray(camera, {150, 200}).direction;
        INFO("fov " << fov);
        CHECK(std::acos(dot(top, bottom)) / degrees == approx(fov, 1e-4f));
        const vec3 right = camera_ray(camera, {300, 100}).direction;
        CHECK_MESSAGE(right.x / -right.z == approx(1.5f * std::tan(fov / 2 * degrees)),
                      "pixels must be square");
    }
}

TEST_CASE("pixel (0, 0) is the top left corner of the picture") {
    const Camera camera = make_camera({}, 40, 30);
    const vec3 first = camera_ray(camera, {0.5f, 0.5f}).direction;
    CHECK_MESSAGE(first.x < 0, "the picture is mirrored");
    CHECK_MESSAGE(first.y > 0, "the picture is upside down");
    const vec3 last = camera_ray(camera, {39.5f, 29.5f}).direction;
    CHECK_MESSAGE(last == approx(vec3(-first.x, -first.y, first.z)),
                  "the picture is symmetric about its centre");
}

TEST_CASE("the points of a picture lie evenly on a flat screen") {
    const Camera camera = make_camera({.fov = 100}, 40, 30);
    const auto on_screen = [&](float x, float y) {
        const vec3 d = camera_ray(camera, {x, y}).direction;
        return vec2(d.x, d.y) / -d.z;
    };
    const vec2 step = on_screen(21, 16) - on_screen(20, 15);
    CHECK_MESSAGE(on_screen(37, 3) == approx(vec2(17, -12) * step, 1e-4f),
                  "equal steps in the picture are equal steps on the screen, not equal angles");
    CHECK(step.x == approx(-step.y));
}

TEST_CASE("every ray of the camera has unit length and starts at the camera") {
    const Camera camera = make_camera({{4, 3, 2}, {1, 1, -1}, {0.4f, 3, 0.1f}, 75}, 64, 48);
    for (const vec2 pixel : {vec2(0, 0), vec2(64, 48), vec2(10.3f, 40), vec2(32, 24)}) {
        const Ray ray = camera_ray(camera, pixel);
        CHECK_MESSAGE(length(ray.direction) == approx(1), "the direction was not normalised");
        CHECK(ray.origin == vec3(4, 3, 2));
    }
}

TEST_CASE("an oblique camera looks at its target, and `up` points to the upper half of the picture") {
    const LookAt look_at{{4, 3, 2}, {1, 1, -1}, {0.4f, 1, 0.1f}, 50};
    const Camera camera = make_camera(look_at, 60, 40);
    const vec3 forward = normalize(look_at.at - look_at.from);
    const vec3 centre = camera_ray(camera, {30, 20}).direction;
    const vec3 top = camera_ray(camera, {30, 0}).direction;
    const vec3 bottom = camera_ray(camera, {30, 40}).direction;
    const vec3 left = camera_ray(camera, {0, 20}).direction;
    const vec3 right = camera_ray(camera, {60, 20}).direction;
    CHECK_MESSAGE(centre == approx(forward), "the centre of the picture shows look_at.at");
    const vec3 side = cross(forward, look_at.up);
    CHECK_MESSAGE(dot(top, side) == approx(0), "the middle column lies in the plane of `forward` and `up`");
    CHECK_MESSAGE(dot(bottom, side) == approx(0),
                  "the middle column lies in the plane of `forward` and `up`");
    CHECK_MESSAGE(dot(top, look_at.up) > dot(centre, look_at.up), "the picture is upside down");
    CHECK_MESSAGE(dot(right, side) > 0, "the picture is mirrored");
    CHECK(dot(left, side) == approx(-dot(right, side)));
    CHECK_MESSAGE(dot(top - bottom, right - left) == approx(0), "rows and columns must be perpendicular");
    CHECK_MESSAGE(dot(top, bottom) == approx(std::cos(50 * degrees)), "the field of view is 50 degrees");
    CHECK_MESSAGE(dot(right, forward) == approx(std::cos(std::atan(1.5f * std::tan(25 * degrees)))),
                  "`right` must have unit length even if `up` is oblique or not of unit length");
}

TEST_CASE("neither the distance to the target nor the length of `up` changes the picture") {
    const Camera one = make_camera({{4, 3, 2}, {1, 1, -1}, {0.4f, 1, 0.1f}, 50}, 60, 40);
    const Camera other = make_camera({{4, 3, 2}, {-2, -1, -4}, {2, 5, 0.5f}, 50}, 60, 40);
    for (const vec2 pixel : {vec2(0, 0), vec2(60, 0), vec2(13, 37)})
        CHECK(camera_ray(one, pixel).direction == approx(camera_ray(other, pixel).direction));
}

TEST_CASE("the first sample of a pixel is at its centre, and the others spread evenly over it") {
    CHECK(r2_offset(0) == vec2(0.5f));
    int count[4][4] = {};
    bool within = true;
    std::set<std::pair<float, float>> different;
    for (int i = 0; i < 1600; ++i) {
        const vec2 p = r2_offset(i);
        within = within && p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1;
        if (!within) break;
        ++count[int(4 * p.x)][int(4 * p.y)];
        different.insert({p.x, p.y});
    }
    REQUIRE_MESSAGE(within, "a sample lies outside its pixel");
    CHECK(different.size() == 1600);
    for (const auto& row : count)
        for (const int samples : row)
            CHECK_MESSAGE(std::abs(samples - 100) <= 20,
                          "each sixteenth of a pixel must get about 100 of the 1600 samples");
}
