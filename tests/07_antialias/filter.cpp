// Facts about filters: their support and their weights.
// Statistical checks are z-tests with fixed seeds; a correct renderer exceeds |z| =
// 4 in one run out of 16,000.
#include "07_antialias/filter.h"
#include "tests/07_antialias/filters.h"
#include "tests/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

using namespace rt;

TEST_CASE("the tent has the density 1 - |x|") {
    std::array<double, 20> bins{};
    const int count = 200'000;
    for (int i = 0; i < count; ++i) {
        const float x = sample_tent((float(i) + 0.5f) / float(count));
        REQUIRE(x >= -1);
        REQUIRE(x <= 1);
        bins[std::size_t(std::min(int((x + 1) * 10), 19))] += 1.0 / count;
    }
    for (int bin = 0; bin < 20; ++bin) {
        const float middle = (float(bin) + 0.5f) / 10 - 1;
        const float expected = (1 - std::abs(middle)) / 10;
        INFO("between " << middle - 0.05f << " and " << middle + 0.05f
                        << ": a constant .05 is a box of width two, zero beyond .5 is a box of width one");
        CHECK(float(bins[std::size_t(bin)]) == approx(expected, 2e-4f));
    }
}

TEST_CASE("Box-Muller produces two independent standard normal numbers") {
    std::array<Mean, 2> mean, square, fourth, beyond;
    Mean product, product_of_squares, quadrant;
    Random random(17);
    for (int i = 0; i < 100'000; ++i) {
        const vec2 p = box_muller(random.get_2d());
        for (int k = 0; k < 2; ++k) {
            const double x = double(p[k]);
            mean[std::size_t(k)].add(x);
            square[std::size_t(k)].add(x * x);
            fourth[std::size_t(k)].add(x * x * x * x);
            beyond[std::size_t(k)].add(std::abs(x) > 1 ? 1 : 0);
        }
        product.add(double(p.x) * double(p.y));
        product_of_squares.add(double(p.x) * double(p.x) * double(p.y) * double(p.y));
        quadrant.add(p.x > 0 && p.y > 0 ? 1 : 0);
    }
    for (int k = 0; k < 2; ++k) {
        INFO(std::string(k == 0 ? "x" : "y"));
        INFO("mean: " << mean[std::size_t(k)].against(0));
        CHECK(std::abs(mean[std::size_t(k)].z(0)) < 4);
        INFO("variance; 2 or 1/2: the factor -2 under the square root is wrong: "
             << square[std::size_t(k)].against(1));
        CHECK(std::abs(square[std::size_t(k)].z(1)) < 4);
        INFO("fourth moment, 3 for a normal distribution: " << fourth[std::size_t(k)].against(3));
        CHECK(std::abs(fourth[std::size_t(k)].z(3)) < 4);
        INFO("share beyond one standard deviation: " << beyond[std::size_t(k)].against(0.3173105));
        CHECK(std::abs(beyond[std::size_t(k)].z(0.3173105)) < 4);
    }
    INFO("mean of x y; 1: the cosine is used twice: " << product.against(0));
    CHECK(std::abs(product.z(0)) < 4);
    INFO("mean of x^2 y^2; 3: both are the same number; less than 1: the radius does not vary: "
         << product_of_squares.against(1));
    CHECK(std::abs(product_of_squares.z(1)) < 4);
    INFO("share of the first quadrant; 1/2: the cosine is used twice, or only half of the angles occur: "
         << quadrant.against(0.25));
    CHECK(std::abs(quadrant.z(0.25)) < 4);
}

TEST_CASE("Box-Muller is finite at the corners of the unit square") {
    const float most = 1 - 0x1p-24f;
    for (const vec2 u : {vec2(0, 0), vec2(0, most), vec2(most, 0), vec2(most, most), vec2(0.3f, 0)}) {
        const vec2 p = box_muller(u);
        INFO("from " << to_text(u) << " came " << to_text(p)
                     << ": the logarithm of 0 is infinite, use 1 - u");
        CHECK(std::isfinite(p.x));
        CHECK(std::isfinite(p.y));
        CHECK(length(p) < 6); // sqrt(-2 ln 2^-24) = 5.77
    }
}

TEST_CASE("a box covers the pixel, a tent reaches the neighbouring centres and a Gaussian deviates by half a "
          "pixel") {
    // Means of x^2: 1/12 for a box, 1/6 for a tent, 1/4 for the Gaussian, times the square of the width.
    const std::array variances{1.0 / 12, 1.0 / 6, 1.0 / 4};
    const std::array reach{0.5f, 1.0f, 3.0f};
    for (const float width : {1.0f, 2.5f})
        for (const Filter filter : filters) {
            const double want = variances[std::size_t(filter)] * double(width) * double(width);
            std::array<Mean, 2> mean, square;
            float farthest = 0;
            Random random(19);
            for (int i = 0; i < 40'000; ++i) {
                const vec2 p = sample_filter(filter, random.get_2d(), width);
                for (int k = 0; k < 2; ++k) {
                    mean[std::size_t(k)].add(double(p[k]));
                    square[std::size_t(k)].add(double(p[k]) * double(p[k]));
                    farthest = std::max(farthest, std::abs(p[k]));
                }
            }
            for (std::size_t k = 0; k < 2; ++k) {
                INFO(name(filter) << " of width " << width << ", " << std::string(k == 0 ? "x" : "y"));
                INFO("mean: " << mean[k].against(0));
                CHECK(std::abs(mean[k].z(0)) < 4);
                INFO("mean square; 4 times too large: the filter is twice as wide as it should be: "
                     << square[k].against(want));
                CHECK(std::abs(square[k].z(want)) < 4);
            }
            INFO(name(filter) << " of width " << width << " reaches " << farthest);
            CHECK(farthest <= reach[std::size_t(filter)] * width);
            CHECK(farthest > 0.95f * reach[std::size_t(std::min(filter, Filter::tent))] * width);
        }
}

TEST_CASE("a filter of width 0 samples only the centre of the pixel") {
    for (const Filter filter : filters) {
        Random random(23);
        for (int i = 0; i < 100; ++i) CHECK(sample_filter(filter, random.get_2d(), 0) == approx(vec2(0)));
    }
}

TEST_CASE("the Gaussian weighs an edge equally from every side") {
    // An edge at distance d from the pixel centre leaves Phi(d / sigma) of the weight
    // white: sigma = 1/2, d = .4.
    const double want = 0.5 * (1 + std::erf(0.4 / 0.5 / std::sqrt(2.0)));
    for (const float degrees : {0.0f, 30.0f, 45.0f, 90.0f, 135.0f, 200.0f, 315.0f}) {
        const vec2 outward(std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees)));
        Mean white;
        Random random(29);
        for (int i = 0; i < 40'000; ++i)
            white.add(dot(sample_filter(Filter::gaussian, random.get_2d(), 1), outward) < 0.4f ? 1 : 0);
        INFO("edge towards " << degrees << " degrees: " << white.against(want)
                             << "; correct only along the axes: x and y are not independent");
        CHECK(std::abs(white.z(want)) < 4);
    }
}
