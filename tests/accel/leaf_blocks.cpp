// Facts about leaf blocks: they find the hits of their primitives, with the values of the lesson's formulas.
#include "accel/exact.h"
#include "accel/leaf_blocks.h"
#include "01_spheres/sphere.h"
#include "05_mesh_bvh/triangle.h"
#include "common/math/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

#include <bit>

using namespace rt;

TEST_CASE("a block finds the triangles that a ray hits whatever their size and distance") {
    Random random(81);
    int hits = 0, wrong = 0, off = 0;
    for (int round = 0; round < 12800 / accel::simd_width; ++round) {
        accel::TriangleN block;
        std::array<std::array<vec3, 3>, accel::simd_width> triangles;
        const int filled = 1 + round % accel::simd_width;
        for (int lane = 0; lane < filled; ++lane) {
            auto& corners = triangles[std::size_t(lane)];
            const float size = std::pow(10.0f, 6 * random.get_1d() - 3); // from a millimetre to a kilometre
            const vec3 place = 3.0f * random_point(random) + vec3(2, -1, 0.5f);
            for (vec3& corner : corners) corner = place + size * (random_point(random) - 0.5f);
            set_lane(block, lane, corners, std::uint32_t(100 + lane));
            CHECK(primitive_at(block, std::size_t(lane)) == corners);
        }
        // One ray aims at a triangle, the other starts a few rounding errors off it, like a shadow ray.
        const auto& [a, b, c] = triangles[std::size_t(round % filled)];
        const float u = 0.05f + 0.45f * random.get_1d(), v = 0.05f + 0.4f * random.get_1d();
        const vec3 target = (1 - u - v) * a + u * b + v * c;
        const vec3 from = 8.0f * random_direction(random);
        for (const Ray& ray :
             {Ray{from, 0.7f * (target - from), 0.2f, 1.6f}, Ray{target + 1e-6f * from, from, 0, 1}}) {
            const accel::Candidates found =
                candidates(block, accel::TriangleN::make_ray(ray), ray.t_min, ray.t_max);
            CHECK_MESSAGE((found.maybe >> (filled - 1)) <= 1u, "an empty lane must never be hit");
            CHECK_MESSAGE((found.certain & ~found.maybe) == 0,
                          "every certain candidate must be a possible one");
            for (std::size_t lane = 0; lane < std::size_t(filled); ++lane) {
                const auto& [p, q, r] = triangles[lane];
                const auto right = intersect(p, q, r, ray);
                const auto got = accel::exact_hit(triangles[lane], ray);
                const bool met = (found.maybe >> lane & 1) && got;
                hits += met;
                wrong += met != right.has_value() || ((found.certain >> lane & 1) && !right);
                if (met && right) off += got->t != right->t || got->u != right->u || got->v != right->v;
            }
        }
    }
    CHECK(hits > 1500);
    CHECK_MESSAGE(wrong <= 2, "only for a ray within rounding of an edge may the results differ");
    CHECK_MESSAGE(off == 0, "t, u and v of a hit must equal those of triangle.h to the last bit");
}

TEST_CASE("a point that is outside by a rounding error is moved into the triangle") {
    const std::array<vec3, 3> corners{vec3(1, -2, 3), vec3(3, 1, 4), vec3(-1, 2, 6)};
    const auto& [a, b, c] = corners;
    const vec3 from(4, -3, -9);
    for (const vec2 outside : {vec2(-1e-4f, 0.4f), vec2(0.5f, -1e-4f), vec2(0.6f, 0.4001f)}) {
        const vec3 target = a + outside.x * (b - a) + outside.y * (c - a);
        const auto hit = accel::exact_hit(corners, Ray{from, target - from});
        REQUIRE(hit);
        CHECK(std::min({hit->u, hit->v, 1 - hit->u - hit->v}) >= -1e-6f);
        CHECK(hit->t == approx(1, 1e-3f));
    }
    CHECK_FALSE_MESSAGE(accel::exact_hit(corners, Ray{a - 3.0f * (b - a), b - a}),
                        "a triangle seen edge-on must not be hit");
}

TEST_CASE("a triangle in a block is hit at any size and from both sides") {
    const vec3 a = {1, -2, 3}, b = {3, 1, 4}, c = {-1, 2, 6};
    for (const float size : {1e-12f, 1e-8f, 1e-3f, 1.0f, 1e4f, 1e8f, 1e15f}) {
        for (const float side : {1.0f, -1.0f}) {
            accel::TriangleN block;
            set_lane(block, accel::simd_width - 1, {size * a, size * b, size * c}, 7);
            const vec3 target = (0.2f * a + 0.3f * b + 0.5f * c) * size;
            const vec3 from = target + side * size * vec3(4, -3, 9);
            INFO("size ", size, ", side ", side);
            const Ray ray{from, target - from};
            const auto prepared = accel::TriangleN::make_ray(ray);
            CHECK(candidates(block, prepared, 0, infinity).certain == 1u << (accel::simd_width - 1));
            CHECK_MESSAGE(candidates(block, prepared, 0, 0.5f).maybe == 0, "the triangle is beyond t_max");
            CHECK_MESSAGE(candidates(block, prepared, 2, infinity).maybe == 0,
                          "the triangle is before t_min");
            const auto hit = accel::exact_hit(primitive_at(block, accel::simd_width - 1), ray);
            REQUIRE(hit);
            CHECK(hit->t == approx(1, 1e-6f));
            CHECK(vec2(hit->u, hit->v) == approx({0.3f, 0.5f}, 1e-5f));
        }
    }
}

TEST_CASE("a block of spheres rejects none that a ray hits") {
    Random random(83);
    int hits = 0, lost = 0, all_candidates = 0;
    for (int round = 0; round < 4000 / accel::simd_width; ++round) {
        accel::SphereN block{};
        std::array<accel::Sphere, accel::simd_width> spheres;
        const int filled = 1 + round % accel::simd_width;
        for (int lane = 0; lane < filled; ++lane) {
            spheres[std::size_t(lane)] = {4.0f * random_point(random), 2 * random.get_1d() + 0.01f};
            if (lane == 3) spheres[3] = {{1, -1000, 2}, 1000}; // a floor
            set_lane(block, lane, spheres[std::size_t(lane)], std::uint32_t(lane));
        }
        const Ray ray{4.0f * random_point(random), random_direction(random), 0.1f, 6.0f};
        const unsigned maybe = candidates(block, accel::SphereN::make_ray(ray), ray.t_min, ray.t_max).maybe;
        CHECK_MESSAGE((maybe >> (filled - 1)) <= 1u, "an empty lane must never be hit");
        all_candidates += std::popcount(maybe);
        for (int lane = 0; lane < filled; ++lane) {
            const bool right = accel::exact_hit(spheres[std::size_t(lane)], ray).has_value();
            hits += right;
            lost += right && !(maybe >> lane & 1);
        }
    }
    CHECK_MESSAGE(lost == 0, "from inside, too");
    CHECK(hits > 200);
    CHECK_MESSAGE(all_candidates < 3 * hits,
                  "most candidates must be hits, or the exact test has too much work");
}

TEST_CASE("a block rejects no sphere that a ray grazes, near or far, small or large") {
    Random random(84);
    int hits = 0, misses = 0, lost = 0, off = 0;
    for (int i = 0; i < 20000; ++i) {
        const float radius = std::pow(10.0f, 8 * random.get_1d() - 4);
        const float distance = radius * (1 + std::pow(10.0f, 6 * random.get_1d() - 3));
        const vec3 origin = 3.0f * random_direction(random), way = normalize(random_direction(random));
        const vec3 aside = normalize(cross(way, random_direction(random)));
        const Sphere sphere{origin + distance * way, radius, 0};
        const accel::Sphere same{sphere.center, sphere.radius};
        const float beside = 1 + (random.get_1d() - 0.5f) * std::pow(10.0f, -6 * random.get_1d());
        const Ray ray{origin, 0.3f * (distance * way + radius * beside * aside)};
        accel::SphereN block{};
        set_lane(block, i % accel::simd_width, same, 0);
        const unsigned maybe = candidates(block, accel::SphereN::make_ray(ray), ray.t_min, ray.t_max).maybe;
        const auto t = intersect(sphere, ray);
        const auto hit = accel::exact_hit(same, ray);
        (hit ? hits : misses) += 1;
        lost += maybe == 0 && hit;
        off += hit.has_value() != t.has_value() || (hit && hit->t != *t);
    }
    CHECK_MESSAGE(lost == 0, "the float test may reject only certain misses");
    CHECK_MESSAGE(off == 0, "t of a hit must equal that of sphere.h to the last bit");
    CHECK(hits > 1000);
    CHECK(misses > 1000);
}
