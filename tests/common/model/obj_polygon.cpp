// Facts about faces of many corners: triangulation is exact and takes about as long as reading the file.
#include "common/model/obj/polygon.h"
#include "common/math/random.h"
#include "tests/check.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <ctime>

using namespace rt;

namespace {

double shoelace(const std::vector<vec3>& corners) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const dvec3 a(corners[i]), b(corners[(i + 1) % corners.size()]);
        sum += (a.x * b.y - a.y * b.x) / 2;
    }
    return sum;
}

/// Builds a spiral band of constant width.
std::vector<vec3> spiral(int count) {
    std::vector<vec3> corners, inside;
    for (int i = 0; i < count / 2; ++i) {
        const float angle = std::sqrt(float(i)) * 0.8f, radius = 1 + angle;
        corners.push_back(vec3(std::cos(angle), std::sin(angle), 0) * (radius + 2));
        inside.push_back(vec3(std::cos(angle), std::sin(angle), 0) * radius);
    }
    corners.insert(corners.end(), inside.rbegin(), inside.rend());
    return corners;
}

std::vector<vec3> comb(int teeth) {
    std::vector<vec3> corners{{float(teeth), -5, 0}, {float(teeth), 0, 0}};
    for (int i = teeth - 1; i >= 0; --i) {
        corners.emplace_back(float(i) + 0.5f, 10 - float(i % 7) * 0.1f, 0);
        corners.emplace_back(float(i), 0, 0);
    }
    corners.emplace_back(0, -5, 0);
    return corners;
}

std::vector<vec3> star(int count, Random& random) {
    std::vector<vec3> corners;
    for (int i = 0; i < count; ++i) {
        const float angle = 2 * pi * float(i) / float(count), radius = 1 + 2 * random.get_1d();
        corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
    }
    return corners;
}

/// Checks that no triangle is reversed, so that the sum of the areas detects gaps and overlaps.
void check_cut(const std::vector<vec3>& corners) {
    double sum = 0;
    bool all_left = true;
    const auto triangles = triangulate(corners);
    CHECK(triangles.size() == corners.size() - 2);
    for (const auto& [a, b, c] : triangles) {
        const double area =
            shoelace({corners[std::size_t(a)], corners[std::size_t(b)], corners[std::size_t(c)]});
        all_left = all_left && area >= 0;
        sum += area;
    }
    CHECK(all_left);
    CHECK(sum == doctest::Approx(shoelace(corners)).epsilon(1e-6));
}

double cpu_seconds_to_cut(const std::vector<vec3>& corners) {
    double best = 1e9;
    for (int round = 0; round < 3; ++round) {
        const std::clock_t start = std::clock();
        triangulate(corners);
        best = std::min(best, double(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return best;
}

} // namespace

TEST_CASE("spirals, combs and stars of thousands of corners are triangulated without gap or overlap") {
    Random random(41);
    check_cut(spiral(1000));
    check_cut(spiral(20000));
    check_cut(comb(5000));
    for (const int count : {5, 6, 7, 8, 12, 40, 1000, 10001}) check_cut(star(count, random));
}

TEST_CASE("a polygon of 1000 corners costs less than 50 triangles per corner and eight times the corners far "
          "less than 64 times the time") {
    // 0.4 ms on a quiet machine; 120 ms with a cubic algorithm.
    CHECK(cpu_seconds_to_cut(spiral(1000)) < 0.02);
    // n log n is about 9 times, a quadratic algorithm 64 times. On a busy machine, shared caches
    // may triple the larger time.
    Random random(42);
    CHECK(cpu_seconds_to_cut(spiral(80000)) < 30 * cpu_seconds_to_cut(spiral(10000)) + 0.01);
    CHECK(cpu_seconds_to_cut(comb(40000)) < 30 * cpu_seconds_to_cut(comb(5000)) + 0.01);
    CHECK(cpu_seconds_to_cut(star(80000, random)) < 30 * cpu_seconds_to_cut(star(10000, random)) + 0.01);
}

TEST_CASE("a polygon that crosses itself many times is split into n - 2 triangles in acceptable time") {
    Random random(43);
    std::vector<vec3> corners;
    for (int i = 0; i < 2000; ++i) corners.emplace_back(random.get_1d(), random.get_1d(), 0.0f);
    CHECK(triangulate(corners).size() == 1998);
    CHECK(cpu_seconds_to_cut(corners) < 1); // 0.02 s on a quiet machine
}
