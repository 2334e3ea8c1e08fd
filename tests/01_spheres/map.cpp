// Facts about the uv map of a sphere: longitude, latitude, and the direction of east.
#include "tests/check.h"

#include "01_spheres/camera.h"
#include "01_spheres/sphere.h"

#include "tests/01_spheres/step.h"

using namespace rt;

TEST_CASE("the map of a ball has the south pole at v = 0 and the north pole at v = 1") {
    CHECK(sphere_uv({0, 1, 0}).y == approx(1));
    CHECK_MESSAGE(sphere_uv({0, -1, 0}).y == approx(0), "v is flipped: the map is upside down");
    for (const float angle : {0.0f, 40.0f, 170.0f, 200.0f, 301.0f})
        CHECK(sphere_uv({std::cos(angle * degrees), 0, std::sin(angle * degrees)}).y == approx(0.5f));
    const vec3 north_30 = normalize(vec3(1, 1, std::sqrt(2.0f))); // 30 degrees north
    const float v = sphere_uv(north_30).y;
    CHECK_MESSAGE(v == approx(2.0f / 3), hint(v, {{0.75f, "v grows with the height, not with the latitude"},
                                                  {1.0f / 3, "v is upside down"}}));
}

TEST_CASE("on the map of a ball u grows evenly eastward") {
    for (const float latitude : {0.0f, -50.0f, 70.0f})
        for (int i = 0; i < 36; ++i) {
            const auto point = [&](float longitude) {
                const vec3 east(1, 0, 0), south_of_view(0, 0, -1);
                return std::cos(latitude * degrees) * (std::cos(longitude * degrees) * east +
                                                       std::sin(longitude * degrees) * south_of_view) +
                       vec3(0, std::sin(latitude * degrees), 0);
            };
            const float u = sphere_uv(point(10.0f * float(i))).x;
            const float step = sphere_uv(point(10.0f * float(i + 1))).x - u;
            INFO("latitude " << latitude << ", ten degrees east of " << 10 * i << ", u = " << u);
            CHECK(u >= 0);
            CHECK(u <= 1);
            CHECK_MESSAGE(step - std::floor(step) == approx(1.0f / 36),
                          hint(step, {{-1.0f / 36, "u grows westward: the globe is mirrored"},
                                      {1.0f / 72, "u covers only half of [0, 1]"}}));
        }
}

TEST_CASE("east on the map of a ball is to the viewer's right if north is up") {
    const Sphere globe{{2, 1, -4}, 1.5f, 0};
    const Camera camera = make_camera({.from = {6, 2, 3}, .at = globe.center, .fov = 20}, 100, 100);
    const auto uv = [&](vec2 pixel) {
        Ray ray = camera_ray(camera, pixel);
        const auto t = intersect(globe, ray);
        REQUIRE(t);
        ray.t_max = *t;
        return surface_hit(globe, ray).uv;
    };
    CHECK_MESSAGE(uv({52, 50}).x > uv({48, 50}).x, "u grows to the left: writing would be mirrored");
    CHECK_MESSAGE(uv({50, 48}).y > uv({50, 52}).y, "v grows downward: the map would be upside down");
}

TEST_CASE("a pole that rounding moves off the unit sphere still has valid uv coordinates") {
    for (const vec3 p :
         {vec3(0, 1.0000001f, 0), vec3(0, -1.0000001f, 0), vec3(-1, 0, 0), vec3(-1, 0, -0.0f)}) {
        const vec2 uv = sphere_uv(p);
        INFO("at " << to_text(p) << " uv = " << to_text(uv));
        CHECK(uv.x >= 0);
        CHECK(uv.x <= 1);
        CHECK(uv.y >= 0);
        CHECK(uv.y <= 1);
    }
}
