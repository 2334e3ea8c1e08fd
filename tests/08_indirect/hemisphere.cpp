// Facts about bounces: their distribution over the hemisphere above a surface.
// Statistical checks are z-tests with fixed seeds; a correct renderer exceeds |z| =
// 4 in one run out of 16,000.
#include "08_indirect/hemisphere.h"
#include "tests/08_indirect/step.h"
#include "tests/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

using namespace rt;

TEST_CASE("two tangents and the normal are perpendicular for every normal") {
    Random random(1);
    std::vector<vec3> all(normals.begin(), normals.end());
    for (int i = 0; i < 1000; ++i)
        all.push_back(normalize(vec3(random.get_1d(), random.get_1d(), random.get_1d()) - 0.5f));
    for (const vec3 n : all) {
        const OrthonormalBasis pair = make_basis(n);
        const vec3 u = pair.u, v = pair.v;
        INFO("normal " << to_text(n) << " has tangents " << to_text(u) << " and " << to_text(v));
        INFO("NaN at (0, 0, -1): a cross product with the normal itself, or a division by 1 + z");
        REQUIRE(length(u) == approx(1));
        REQUIRE(length(v) == approx(1));
        REQUIRE(dot(u, n) == approx(0));
        REQUIRE(dot(v, n) == approx(0));
        REQUIRE(dot(u, v) == approx(0));
    }
}

TEST_CASE("a bounce has unit length and leaves above the surface") {
    const float most = 1 - 0x1p-24f;
    Random random(2);
    for (const vec3 normal : normals) {
        std::vector<vec2> all{{0, 0}, {0, most}, {most, 0}, {most, most}, {0.5f, 0.25f}};
        for (int i = 0; i < 2000; ++i) all.push_back(random.get_2d());
        for (const vec2 u : all) {
            const vec3 direction = sample_cosine_hemisphere(normal, u);
            INFO("normal " << to_text(normal) << ", u " << to_text(u) << ", direction "
                           << to_text(direction));
            REQUIRE(length(direction) == approx(1));
            REQUIRE_MESSAGE(dot(direction, normal) > 0,
                            "below the surface: light comes from inside the object");
        }
    }
}

TEST_CASE("bounces are denser around the normal by Lambert's cosine") {
    for (const vec3 normal : normals) {
        Mean cosine, inverse;
        std::vector<double> found(10), even(10, 2000);
        Random random(3);
        for (int i = 0; i < 20'000; ++i) {
            const float c = dot(sample_cosine_hemisphere(normal, random.get_2d()), normal);
            cosine.add(double(c));
            inverse.add(c > 0.02f ? 1 / double(cosine_hemisphere_pdf(c)) : 0);
            found[std::size_t(std::clamp(int(c * c * 10), 0, 9))] += 1;
        }
        INFO("normal " << to_text(normal));
        INFO("mean cosine, 2/3; 1/2: uniform directions; 3/4: cos^2: " << cosine.against(2.0 / 3));
        CHECK(off(cosine, 2.0 / 3) < 4);
        // All directions within acos(.02) of the normal fill 2 pi (1 - .02); without this cut-off,
        // 1/pdf has infinite variance.
        const double directions = 2 * double(pi) * 0.98;
        INFO("mean of 1/pdf, the solid angle of all directions, 2 pi: " << inverse.against(directions));
        CHECK(off(inverse, directions) < 4);
        INFO("cos^2 must be uniform; chi-square of ten bins exceeds 37.7 once in 50,000 for each of nine "
             "normals");
        CHECK(chi_square(found, even) < 37.7);
    }
}

TEST_CASE("the mean of cos^2/pdf over all bounces is the integral of cos^2") {
    // Over an even grid of u instead of random numbers, so there is no noise, whichever number is the azimuth.
    // The mean of 1/pdf itself has no finite variance.
    const int side = 300;
    for (const vec3 normal : {normals[4], normals[2]}) {
        double sum = 0;
        for (int i = 0; i < side * side; ++i) {
            const vec2 u = (vec2(float(i % side), float(i / side)) + 0.5f) / float(side);
            const float cosine = dot(sample_cosine_hemisphere(normal, u), normal);
            sum += double(cosine) * double(cosine) / double(cosine_hemisphere_pdf(cosine)) / (side * side);
        }
        INFO("normal " << to_text(normal) << "; 2/3: the pdf lacks its 1/pi; 2 pi / 3 is correct");
        CHECK(float(sum) == approx(2 * pi / 3, 2e-3f));
    }
}

TEST_CASE("the pdf of bounces is that of the sampled directions") {
    // 8 x 12 cells of equal solid angle around an oblique normal; the expected count of each is the integral
    // of the pdf. 95 degrees of freedom: above 163.3 once in 50,000. It also tests the azimuth.
    const int cosines = 8, angles = 12, samples = 60'000;
    for (const vec3 normal : {normals[4], normals[5], normals[2]}) {
        std::vector<double> found(cosines * angles), expected(cosines * angles);
        Random random(5);
        for (int i = 0; i < samples; ++i) {
            const vec3 direction = sample_cosine_hemisphere(normal, random.get_2d());
            const int row = std::clamp(int(dot(direction, normal) * cosines), 0, cosines - 1);
            found[std::size_t(row * angles + int(azimuth(normal, direction) * angles))] += 1;
        }
        for (int row = 0; row < cosines; ++row)
            for (int angle = 0; angle < angles; ++angle)
                for (int i = 0; i < 100; ++i) {
                    const float c = (float(row) + (float(i) + 0.5f) / 100) / cosines;
                    expected[std::size_t(row * angles + angle)] +=
                        samples * double(cosine_hemisphere_pdf(c)) * 2 * double(pi) / angles / cosines / 100;
                }
        double total = 0;
        for (const double cell : expected) total += cell / samples;
        CHECK_MESSAGE(float(total) == approx(1, 1e-4f), "the pdf must integrate to 1 over the hemisphere");
        INFO("normal " << to_text(normal)
                       << ": the pdf belongs to another sampler, or the azimuth is not uniform");
        CHECK(chi_square(found, expected) < 163.3);
    }
    CHECK_MESSAGE(cosine_hemisphere_pdf(-0.4f) == 0, "no bounce goes below the surface");
    CHECK(cosine_hemisphere_pdf(0.4f) == approx(0.4f / pi));
}

TEST_CASE("bounces are uniform in azimuth") {
    // 24 bins, 23 degrees of freedom: above 62 once in 50,000.
    for (const vec3 normal : normals) {
        std::vector<double> found(24), even(24, 1000);
        Mean with_height;
        Random random(7);
        for (int i = 0; i < 24'000; ++i) {
            const vec3 direction = sample_cosine_hemisphere(normal, random.get_2d());
            const double turn = azimuth(normal, direction);
            found[std::size_t(turn * 24)] += 1;
            with_height.add(std::cos(2 * double(pi) * turn) * double(dot(direction, normal)));
        }
        INFO("normal " << to_text(normal));
        CHECK(chi_square(found, even) < 62);
        INFO("the azimuth must be independent of the height: " << with_height.against(0));
        CHECK(off(with_height, 0) < 4);
    }
}

TEST_CASE("unit vectors are uniform over the sphere and uniform bounces over the hemisphere") {
    const int samples = 40'000;
    std::array<Mean, 3> mean, square;
    Random random(67);
    for (int i = 0; i < samples; ++i) {
        const vec3 direction = sample_uniform_sphere(random.get_2d());
        REQUIRE(length(direction) == approx(1));
        for (int k = 0; k < 3; ++k) {
            mean[std::size_t(k)].add(double(direction[k]));
            square[std::size_t(k)].add(double(direction[k] * direction[k]));
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        INFO("axis " << k << ": mean " << mean[k].against(0) << "; of the square "
                     << square[k].against(1.0 / 3));
        CHECK(off(mean[k], 0) < 4);
        CHECK(off(square[k], 1.0 / 3) < 4);
    }
    // 8 x 12 cells of equal solid angle: 95 degrees of freedom, above 163.3 once in 50,000.
    for (const vec3 normal : {normals[4], normals[2], normals[8]}) {
        std::vector<double> found(96), even(96, samples / 96.0);
        for (int i = 0; i < samples; ++i) {
            const vec3 direction = sample_hemisphere(HemisphereSampling::uniform, normal, random.get_2d());
            const float cosine = dot(direction, normal);
            REQUIRE_MESSAGE(cosine >= 0, "below the surface");
            const int row = std::clamp(int(cosine * 8), 0, 7);
            found[std::size_t(row * 12 + int(azimuth(normal, direction) * 12))] += 1;
        }
        INFO("normal " << to_text(normal) << ": a cosine-weighted sampler would be denser around the normal");
        CHECK(chi_square(found, even) < 163.3);
    }
    CHECK_MESSAGE(hemisphere_pdf(HemisphereSampling::uniform, 0.3f) == approx(1 / (2 * pi)),
                  "the hemisphere has a solid angle of 2 pi");
    CHECK(hemisphere_pdf(HemisphereSampling::uniform, -0.3f) == 0);
    CHECK(hemisphere_pdf(HemisphereSampling::cosine, 0.3f) == cosine_hemisphere_pdf(0.3f));
}
