// Rows of numbers, and blocks of shapes that answer what each shape answers alone.
#include "05_mesh_bvh/block.h"
#include "05_mesh_bvh/triangle.h"
#include "05_mesh_bvh/wide_bvh.h"
#include "common/random.h"
#include "tests/check.h"
#include "tests/meshes.h"

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

TEST_CASE("a block of triangles answers what each triangle answers alone") {
    Random random(81);
    int hits = 0, wrong = 0;
    for (int round = 0; round < 3200 / lanes; ++round) {
        TriangleBlock block{};
        std::array<std::array<vec3, 3>, lanes> triangles;
        const int filled = 1 + round % lanes;
        for (int lane = 0; lane < filled; ++lane) {
            auto& corners = triangles[std::size_t(lane)];
            for (vec3& corner : corners) corner = 3.0f * random_point(random) + vec3(2, -1, 0.5f);
            put(block, lane, corners, std::uint32_t(100 + lane));
        }
        const vec3 origin = 8.0f * random_direction(random),
                   target = 3.0f * random_point(random) + vec3(2, -1, 0.5f);
        const Ray ray{origin, 0.7f * (target - origin), 0.2f, 1.6f};
        const BlockHits got = intersect(block, TriangleBlock::prepare(ray), row(ray.t_min), row(ray.t_max));
        for (int lane = 0; lane < lanes; ++lane) {
            const bool hit = got.hit >> lane & 1;
            if (lane >= filled) {
                CHECK_MESSAGE(!hit, "an empty lane is never hit");
                continue;
            }
            const auto& [a, b, c] = triangles[std::size_t(lane)];
            const auto right = intersect(a, b, c, ray);
            hits += hit;
            if (right.has_value() != hit) ++wrong;
            if (!right || !hit) continue;
            CHECK(got.t[lane] == approx(right->t, 1e-4f));
            CHECK_MESSAGE(vec2(got.u[lane], got.v[lane]) == approx(vec2(right->u, right->v), 2e-3f),
                          "u weighs the second corner and v the third");
        }
    }
    CHECK(hits > 100);
    CHECK_MESSAGE(wrong <= 1, "only a ray within rounding of an edge may be judged in two ways");
}

TEST_CASE("a triangle is met at any size, and from both sides, a row at a time") {
    const vec3 a = {1, -2, 3}, b = {3, 1, 4}, c = {-1, 2, 6};
    for (const float size : {1e-8f, 1e-3f, 1.0f, 1e4f, 1e8f}) {
        for (const float side : {1.0f, -1.0f}) {
            TriangleBlock block{};
            put(block, lanes - 1, {size * a, size * b, size * c}, 7);
            const vec3 target = (0.2f * a + 0.3f * b + 0.5f * c) * size;
            const vec3 from = target + side * size * vec3(4, -3, 9);
            const BlockHits hits =
                intersect(block, TriangleBlock::prepare({from, target - from}), row(0), row(infinity));
            INFO("size ", size, ", side ", side);
            REQUIRE(hits.hit == 1u << (lanes - 1));
            CHECK(hits.t[lanes - 1] == approx(1, 1e-5f));
            CHECK(vec2(hits.u[lanes - 1], hits.v[lanes - 1]) == approx({0.3f, 0.5f}, 1e-4f));
        }
    }
}

TEST_CASE("a block of spheres answers what each sphere answers alone") {
    Random random(83);
    int hits = 0;
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
        const BlockHits got = intersect(block, SphereBlock::prepare(ray), row(ray.t_min), row(ray.t_max));
        for (int lane = 0; lane < lanes; ++lane) {
            const auto right = lane < filled ? intersect(spheres[std::size_t(lane)], ray) : std::nullopt;
            const bool hit = got.hit >> lane & 1;
            CHECK_MESSAGE(hit == right.has_value(),
                          "the far root counts from inside, and an empty lane never");
            if (hit && right) CHECK(got.t[lane] == *right);
            hits += hit;
        }
    }
    CHECK(hits > 200);
}

TEST_CASE("a block leaves out no sphere that a ray grazes, near or far, small or large") {
    Random random(84);
    int hits = 0, misses = 0, wrong = 0;
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
        const BlockHits got = intersect(block, SphereBlock::prepare(ray), row(ray.t_min), row(ray.t_max));
        const bool hit = intersect(sphere, ray).has_value();
        (hit ? hits : misses) += 1;
        wrong += (got.hit != 0) != hit;
    }
    CHECK_MESSAGE(wrong == 0, "floats may only leave out what they are certain of");
    CHECK(hits > 1000);
    CHECK(misses > 1000);
}
