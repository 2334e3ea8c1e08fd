// Rows of numbers, and blocks that find what each shape says alone.
#include "05_mesh_bvh/block.h"
#include "05_mesh_bvh/triangle.h"
#include "05_mesh_bvh/wide_bvh.h"
#include "common/math/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

#include <bit>

using namespace rt;

// ---------------------------------------------------------------------------------------------------- rows

/// These numbers in the first lanes, 100 in the others.
Row row_of(std::initializer_list<float> numbers) {
    Row all = row(100);
    int lane = 0;
    for (const float number : numbers) all[lane++] = number;
    return all;
}

TEST_CASE("bits of a mask stand in the order of the lanes") {
    const unsigned all = (1u << lanes) - 1;
    const Row values = row_of({3, -1, -5, 0});
    CHECK(bits(values < 0) == 0b0110u);
    CHECK(bits(values < -10) == 0);
    CHECK(bits(values > -10) == all);
    Row last = row(1);
    last[lanes - 1] = -1;
    CHECK(bits(last < 0) == 1u << (lanes - 1));
    unsigned mask = 0b01011010u;
    CHECK(next_lane(mask) == 1);
    CHECK(next_lane(mask) == 3);
    CHECK(mask == 0b01010000u);
}

TEST_CASE("less and at_most tell rows apart lane by lane, and what is not a number is neither") {
    const float nan = std::nanf("");
    const Row a = row_of({1, 5, nan, 2}), b = row_of({2, 4, 3, 2});
    CHECK((less(a, b) & 0b1111u) == 0b0001u);
    CHECK((at_most(a, b) & 0b1111u) == 0b1001u);
    CHECK((less(b, a) & 0b1111u) == 0b0010u);
    Row last = row(1);
    last[lanes - 1] = -1;
    CHECK(less(last, Row{}) == 1u << (lanes - 1));
    CHECK(at_most(last, Row{}) == 1u << (lanes - 1));
}

TEST_CASE("least and greatest answer the second where one is not a number") {
    const float nan = std::nanf("");
    const Row a = row_of({1, 5, nan, 2}), b = row_of({2, 4, 3, nan});
    CHECK(least(a, b)[0] == 1);
    CHECK(least(a, b)[1] == 4);
    CHECK(least(a, b)[2] == 3);
    CHECK(greatest(a, b)[0] == 2);
    CHECK(greatest(a, b)[2] == 3);
    CHECK(std::isnan(greatest(a, b)[3]));
}

// -------------------------------------------------------------------------------------------------- blocks

TEST_CASE("a block finds the triangles that a ray meets, and where, whatever their size and distance") {
    Random random(81);
    int hits = 0, wrong = 0, off = 0;
    for (int round = 0; round < 12800 / lanes; ++round) {
        TriangleBlock block;
        std::array<std::array<vec3, 3>, lanes> triangles;
        const int filled = 1 + round % lanes;
        for (int lane = 0; lane < filled; ++lane) {
            auto& corners = triangles[std::size_t(lane)];
            const float size = std::pow(10.0f, 6 * random.uniform() - 3); // from a millimetre to a kilometre
            const vec3 place = 3.0f * random_point(random) + vec3(2, -1, 0.5f);
            for (vec3& corner : corners) corner = place + size * (random_point(random) - 0.5f);
            put(block, lane, corners, std::uint32_t(100 + lane));
            CHECK(corners_at(block, std::size_t(lane)) == corners);
        }
        // One ray aims at a triangle, the other starts a few roundings off it, as shadow rays do.
        const auto& [a, b, c] = triangles[std::size_t(round % filled)];
        const float u = 0.05f + 0.45f * random.uniform(), v = 0.05f + 0.4f * random.uniform();
        const vec3 target = (1 - u - v) * a + u * b + v * c;
        const vec3 from = 8.0f * random_direction(random);
        for (const Ray& ray :
             {Ray{from, 0.7f * (target - from), 0.2f, 1.6f}, Ray{target + 1e-6f * from, from, 0, 1}}) {
            const Candidates found = candidates(block, TriangleBlock::prepare(ray), ray.t_min, ray.t_max);
            CHECK_MESSAGE((found.maybe >> (filled - 1)) <= 1u, "an empty lane is never met");
            CHECK_MESSAGE((found.certain & ~found.maybe) == 0, "what is certain may be");
            for (std::size_t lane = 0; lane < std::size_t(filled); ++lane) {
                const auto& [p, q, r] = triangles[lane];
                const auto right = intersect(p, q, r, ray);
                const auto got = meeting(triangles[lane], ray);
                const bool met = (found.maybe >> lane & 1) && got;
                hits += met;
                wrong += met != right.has_value() || ((found.certain >> lane & 1) && !right);
                if (met && right) off += got->t != right->t || got->u != right->u || got->v != right->v;
            }
        }
    }
    CHECK(hits > 1500);
    CHECK_MESSAGE(wrong <= 2, "only a ray within rounding of an edge may be judged in two ways");
    CHECK_MESSAGE(off == 0, "where a ray meets a triangle is what triangle.h says, to the last bit");
}

TEST_CASE("a point that is outside by a rounding is drawn into the triangle") {
    const std::array<vec3, 3> corners{vec3(1, -2, 3), vec3(3, 1, 4), vec3(-1, 2, 6)};
    const auto& [a, b, c] = corners;
    const vec3 from(4, -3, -9);
    for (const vec2 outside : {vec2(-1e-4f, 0.4f), vec2(0.5f, -1e-4f), vec2(0.6f, 0.4001f)}) {
        const vec3 target = a + outside.x * (b - a) + outside.y * (c - a);
        const auto hit = meeting(corners, {from, target - from});
        REQUIRE(hit);
        CHECK(std::min({hit->u, hit->v, 1 - hit->u - hit->v}) >= -1e-6f);
        CHECK(hit->t == approx(1, 1e-3f));
    }
    CHECK_FALSE_MESSAGE(meeting(corners, {a - 3.0f * (b - a), b - a}), "seen edge-on, a triangle is not met");
}

TEST_CASE("a triangle is met at any size, and from both sides, a row at a time") {
    const vec3 a = {1, -2, 3}, b = {3, 1, 4}, c = {-1, 2, 6};
    for (const float size : {1e-12f, 1e-8f, 1e-3f, 1.0f, 1e4f, 1e8f, 1e15f}) {
        for (const float side : {1.0f, -1.0f}) {
            TriangleBlock block;
            put(block, lanes - 1, {size * a, size * b, size * c}, 7);
            const vec3 target = (0.2f * a + 0.3f * b + 0.5f * c) * size;
            const vec3 from = target + side * size * vec3(4, -3, 9);
            INFO("size ", size, ", side ", side);
            const Ray ray{from, target - from};
            const auto prepared = TriangleBlock::prepare(ray);
            CHECK(candidates(block, prepared, 0, infinity).certain == 1u << (lanes - 1));
            CHECK_MESSAGE(candidates(block, prepared, 0, 0.5f).maybe == 0, "it lies beyond the end");
            CHECK_MESSAGE(candidates(block, prepared, 2, infinity).maybe == 0, "it lies before the begin");
            const auto hit = meeting(corners_at(block, lanes - 1), ray);
            REQUIRE(hit);
            CHECK(hit->t == approx(1, 1e-6f));
            CHECK(vec2(hit->u, hit->v) == approx({0.3f, 0.5f}, 1e-5f));
        }
    }
}

TEST_CASE("a block of spheres leaves out none that a ray meets") {
    Random random(83);
    int hits = 0, lost = 0, all_candidates = 0;
    for (int round = 0; round < 4000 / lanes; ++round) {
        SphereBlock block{};
        std::array<Sphere, lanes> spheres;
        const int filled = 1 + round % lanes;
        for (int lane = 0; lane < filled; ++lane) {
            spheres[std::size_t(lane)] = {4.0f * random_point(random), 2 * random.uniform() + 0.01f, 0};
            if (lane == 3) spheres[3] = {{1, -1000, 2}, 1000, 0}; // a floor
            put(block, lane, spheres[std::size_t(lane)], std::uint32_t(lane));
        }
        const Ray ray{4.0f * random_point(random), random_direction(random), 0.1f, 6.0f};
        const unsigned maybe = candidates(block, SphereBlock::prepare(ray), ray.t_min, ray.t_max).maybe;
        CHECK_MESSAGE((maybe >> (filled - 1)) <= 1u, "an empty lane is never met");
        all_candidates += std::popcount(maybe);
        for (int lane = 0; lane < filled; ++lane) {
            const bool right = intersect(spheres[std::size_t(lane)], ray).has_value();
            hits += right;
            lost += right && !(maybe >> lane & 1);
        }
    }
    CHECK_MESSAGE(lost == 0, "from inside too");
    CHECK(hits > 200);
    CHECK_MESSAGE(all_candidates < 3 * hits, "most candidates are met, or the exact test has too much to do");
}

TEST_CASE("a block leaves out no sphere that a ray grazes, near or far, small or large") {
    Random random(84);
    int hits = 0, misses = 0, lost = 0;
    for (int i = 0; i < 20000; ++i) {
        const float radius = std::pow(10.0f, 8 * random.uniform() - 4);
        const float distance = radius * (1 + std::pow(10.0f, 6 * random.uniform() - 3));
        const vec3 origin = 3.0f * random_direction(random), way = normalize(random_direction(random));
        const vec3 aside = normalize(cross(way, random_direction(random)));
        const Sphere sphere{origin + distance * way, radius, 0};
        const float beside = 1 + (random.uniform() - 0.5f) * std::pow(10.0f, -6 * random.uniform());
        const Ray ray{origin, 0.3f * (distance * way + radius * beside * aside)};
        SphereBlock block{};
        put(block, i % lanes, sphere, 0);
        const unsigned maybe = candidates(block, SphereBlock::prepare(ray), ray.t_min, ray.t_max).maybe;
        const bool hit = intersect(sphere, ray).has_value();
        (hit ? hits : misses) += 1;
        lost += maybe == 0 && hit;
    }
    CHECK_MESSAGE(lost == 0, "floats may only leave out what they are certain of");
    CHECK(hits > 1000);
    CHECK(misses > 1000);
}
