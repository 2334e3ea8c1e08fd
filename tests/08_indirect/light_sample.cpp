// Facts about single lights: the points sampled on them.
// Statistical checks are z-tests with fixed seeds; a correct renderer exceeds |z| =
// 4 in one run out of 16,000.
#include "08_indirect/light_sample.h"
#include "tests/08_indirect/step.h"
#include "tests/check.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

using namespace rt;

TEST_CASE("the points sampled on a light are spread evenly over it") {
    const Quad quad{{1, 2, -1}, {2, 0.5f, 0.3f}, {0.9f, 1, 1.5f}, 0};
    const LightTriangle triangle{{1, 0, 2}, {3, 0.5f, 1}, {0.5f, 2, -1}};
    const Sphere sphere{{-1, 2, 0.5f}, 2.5f, 0};
    // 64 cells of equal area: 63 degrees of freedom, above 120.6 once in 50,000.
    const auto cells = [](auto&& light, const std::function<int(vec3)>& cell_of) {
        std::vector<double> found(64), even(64, 500);
        Random random(17);
        for (int i = 0; i < 32'000; ++i)
            found[std::size_t(std::clamp(cell_of(sample_area(light, random.get_2d()).position), 0, 63))] += 1;
        return chi_square(found, even);
    };
    CHECK(cells(quad, [&](vec3 p) {
              const vec2 uv = quad_uv(quad, dvec3(p));
              return int(uv.x * 8) * 8 + int(uv.y * 8);
          }) < 120.6);
    INFO("triangle: u.x instead of sqrt(u.x) concentrates the points at a vertex");
    CHECK(cells(triangle, [&](vec3 p) { // 8 strips each way, each square split in two: 36 + 28 triangles
              const vec3 b = triangle.b - triangle.a, c = triangle.c - triangle.a, n = cross(b, c);
              const vec2 uv =
                  8.0f * vec2(dot(cross(p - triangle.a, c), n), dot(cross(b, p - triangle.a), n)) / dot(n, n);
              const vec2 corner = floor(uv), rest = uv - corner;
              const int row = int(corner.x + corner.y);
              return (rest.x + rest.y < 1 ? 0 : 36) + row * (row + 1) / 2 + int(corner.y);
          }) < 120.6);
    const vec3 axis = normals[5];
    INFO("sphere: a uniform latitude concentrates the points at the poles");
    CHECK(cells(sphere, [&](vec3 p) {
              const vec3 n = (p - sphere.center) / sphere.radius;
              return int((1 + dot(n, axis)) / 2 * 8) * 8 + int(azimuth(axis, n) * 8);
          }) < 120.6);
}

TEST_CASE("the points sampled on a light are on it and have its normal") {
    const Quad quad{{1, 2, -1}, {2, 0.5f, 0.3f}, {0.9f, 1, 1.5f}, 0};
    const LightTriangle triangle{{1, 0, 2}, {3, 0.5f, 1}, {0.5f, 2, -1}};
    const Sphere sphere{{-1, 2, 0.5f}, 2.5f, 0};
    const vec3 quad_normal = cross(quad.edge_u, quad.edge_v);
    const vec3 triangle_normal = cross(triangle.b - triangle.a, triangle.c - triangle.a);
    Mean height; // uniform directions have the mean cosine 1/2 over a hemisphere
    Random random(19);
    for (int i = 0; i < 3000; ++i) {
        const vec2 u = random.get_2d();
        const LightSample a = sample_area(quad, u), b = sample_area(triangle, u), c = sample_area(sphere, u);
        const vec2 uv = quad_uv(quad, dvec3(a.position));
        REQUIRE(min(uv, 1.0f - uv) == approx(max(min(uv, 1.0f - uv), vec2(0))));
        REQUIRE(dot(a.position - quad.corner, quad_normal) == approx(0));
        REQUIRE(std::abs(dot(a.normal, normalize(quad_normal))) == approx(1));
        REQUIRE(dot(b.position - triangle.a, triangle_normal) == approx(0));
        REQUIRE(std::abs(dot(b.normal, normalize(triangle_normal))) == approx(1));
        REQUIRE(distance(c.position, sphere.center) == approx(2.5f));
        REQUIRE(c.position == approx(sphere.center + 2.5f * c.normal));
        height.add(double(std::abs(dot(c.normal, normals[5]))));
    }
    INFO("mean |cosine| of uniform directions, 1/2: " << height.against(0.5));
    CHECK(off(height, 0.5) < 4);
}
