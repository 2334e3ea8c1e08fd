// Facts about samplers: even over the samples of a pixel, and independent of pixel, seed and dimension.
// Seeds are fixed: a correct sampler exceeds z = 4 in one run out of 31,000 in one-sided tests of the
// distribution, and out of 16,000 in two-sided tests of a mean.
#include "07_antialias/sampler.h"
#include "tests/07_antialias/step.h"
#include "tests/check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

using namespace rt;

namespace {

const std::array even_kinds{SamplerKind::stratified, SamplerKind::sobol};

Sampler sampler_of(SamplerKind kind, int pixel, int index, int count, std::uint64_t seed) {
    return {kind, PixelSample{pixel % 640, pixel / 640, index, count,
                              Random(pixel % 640, pixel / 640, index, seed), seed}};
}

/// The dimensions that these checks draw: a 2D point, a number, a 2D point, a number.
constexpr std::size_t dimensions = 6;
using Point = std::array<float, dimensions>;

Point point_of(SamplerKind kind, int pixel, int index, int count, std::uint64_t seed = 3) {
    Sampler sampler = sampler_of(kind, pixel, index, count, seed);
    const vec2 a = sampler.get_2d();
    const float b = sampler.get_1d();
    const vec2 c = sampler.get_2d();
    return {a.x, a.y, b, c.x, c.y, sampler.get_1d()};
}

std::vector<Point> points_of(SamplerKind kind, int pixel, int count, std::uint64_t seed = 3) {
    std::vector<Point> points;
    for (int i = 0; i < count; ++i) points.push_back(point_of(kind, pixel, i, count, seed));
    return points;
}

std::size_t bin(float u, int bins) {
    return std::size_t(std::min(int(u * float(bins)), bins - 1));
}

/// Returns how many samples are in the fullest of `columns` x `rows` equal boxes.
int fullest_box(const std::vector<vec2>& points, int columns, int rows) {
    std::vector<int> boxes(std::size_t(columns) * std::size_t(rows));
    for (const vec2 p : points) ++boxes[bin(p.y, rows) * std::size_t(columns) + bin(p.x, columns)];
    return *std::max_element(boxes.begin(), boxes.end());
}

std::vector<vec2> pairs_of(const std::vector<Point>& points, std::size_t first) {
    std::vector<vec2> pairs;
    for (const Point& point : points) pairs.emplace_back(point[first], point[first + 1]);
    return pairs;
}

} // namespace

// ---- even over the samples of a pixel

TEST_CASE("of 2^k Sobol samples one is in every box of area 2^-k whatever its shape") {
    for (int k = 0; k <= 10; ++k)
        for (const int pixel : {0, 1, 99'999}) {
            const std::vector<Point> points = points_of(SamplerKind::sobol, pixel, 1 << k);
            for (int a = 0; a <= k; ++a)
                for (const std::size_t first : {0u, 3u}) {
                    INFO((1 << k) << " samples, boxes 2^-" << a << " wide, dimensions " << first << " and "
                                  << first + 1 << ": 2 samples in a box leave another one empty");
                    CHECK(fullest_box(pairs_of(points, first), 1 << a, 1 << (k - a)) == 1);
                }
            for (const std::size_t single : {2u, 5u}) {
                std::vector<vec2> line;
                for (const Point& point : points) line.emplace_back(point[single], 0);
                CHECK(fullest_box(line, 1 << k, 1) == 1);
            }
        }
}

TEST_CASE("of any number of Sobol samples no two share a box of the next power-of-two subdivision") {
    for (int count = 1; count <= 130; ++count) {
        const int k = std::bit_width(std::uint32_t(count - 1));
        const std::vector<Point> points = points_of(SamplerKind::sobol, 7, count);
        for (int a = 0; a <= k; ++a) {
            INFO(count << " samples, boxes 2^-" << a << " x 2^-" << k - a);
            CHECK(fullest_box(pairs_of(points, 3), 1 << a, 1 << (k - a)) == 1);
        }
    }
}

TEST_CASE("of any number of stratified samples one is in every cell in every dimension") {
    for (int count = 1; count <= 130; ++count) {
        const std::vector<Point> points = points_of(SamplerKind::stratified, 7, count);
        for (const std::size_t single : {2u, 5u}) {
            std::vector<int> cells(std::size_t(count), 0);
            // Rounding may put the float of a cell's border just before it: a small offset keeps it inside.
            for (const Point& point : points) ++cells[bin(point[single] + 1e-7f, count)];
            INFO(count << " samples, dimension " << single);
            CHECK(*std::max_element(cells.begin(), cells.end()) == 1);
        }
        const int rows = int(std::sqrt(float(count)));
        if (rows * rows != count) continue; // for other counts see "each of 1 to 100 stratified samples"
        for (const std::size_t first : {0u, 3u}) {
            INFO(count << " samples, dimensions " << first << " and " << first + 1);
            std::vector<vec2> pairs = pairs_of(points, first);
            for (vec2& pair : pairs) pair += 1e-7f;
            CHECK(fullest_box(pairs, rows, rows) == 1);
        }
    }
}

TEST_CASE("every sample is spread evenly over the pixels in every dimension") {
    for (const SamplerKind kind : kinds)
        for (const int index : {0, 1, 11}) {
            std::array<std::vector<int>, dimensions> bins;
            bins.fill(std::vector<int>(64, 0));
            for (int pixel = 0; pixel < 20'000; ++pixel) {
                const Point point = point_of(kind, pixel, index, 12);
                for (std::size_t d = 0; d < dimensions; ++d) ++bins[d][bin(point[d], 64)];
            }
            for (std::size_t d = 0; d < dimensions; ++d) {
                INFO(name(kind) << ", sample " << index << ", dimension " << d
                                << ": z = " << unevenness(bins[d])
                                << "; if z exceeds 4, the mean of the picture is biased");
                CHECK(unevenness(bins[d]) < 4);
            }
        }
}

TEST_CASE("no number reaches 1") {
    CHECK(to_unit_float(0xffffffffu) < 1);
    Random random(5);
    const int count = 1 << 24;
    float largest = 0;
    for (int repeat = 0; repeat < 100'000; ++repeat)
        largest = std::max(largest, stratified_1d(count - 1, count, random));
    CHECK_MESSAGE(largest < 1, "the index of the last cell and the jitter add up to 1");
    for (const SamplerKind kind : kinds)
        for (int index = 0; index < 100'000; ++index)
            for (const float u : point_of(kind, 1, index, 100'000)) {
                REQUIRE(u >= 0);
                REQUIRE(u < 1);
            }
}

// ---- independent of each other

TEST_CASE("two dimensions of a pixel fill their square at least as evenly as random numbers") {
    // With c = 12 (u - 1/2) (v - 1/2), the mean of c over n samples has the variance 1 / n for random
    // samples, and 1 / (n - 1) for dimensions that are stratified and independently permuted.
    const int count = 16;
    for (const SamplerKind kind : kinds)
        for (std::size_t a = 0; a < dimensions; ++a)
            for (std::size_t b = 0; b < a; ++b) {
                Mean mean, square;
                for (int pixel = 0; pixel < 2000; ++pixel) {
                    double sum = 0;
                    for (const Point& p : points_of(kind, pixel, count))
                        sum += 12 * double(p[a] - 0.5f) * double(p[b] - 0.5f) / count;
                    mean.add(sum);
                    square.add(sum * sum * count);
                }
                INFO(name(kind) << ", dimensions " << b << " and " << a);
                INFO("correlation: " << mean.against(0));
                CHECK(std::abs(mean.z(0)) < 4);
                INFO("in a single pixel, n times its square: "
                     << square.mean() << "; about n: both dimensions visit the samples in the same order");
                CHECK(square.z(double(count) / (count - 1)) < 4);
            }
}

TEST_CASE("two dimensions fill their square evenly over the pixels") {
    for (const SamplerKind kind : kinds)
        for (std::size_t a = 0; a < dimensions; ++a)
            for (std::size_t b = 0; b < a; ++b) {
                std::vector<int> bins(64, 0);
                for (int pixel = 0; pixel < 10'000; ++pixel) {
                    const Point p = point_of(kind, pixel, 5, 16);
                    ++bins[bin(p[a], 8) * 8 + bin(p[b], 8)];
                }
                INFO(name(kind) << ", dimensions " << b << " and " << a << ": z = " << unevenness(bins));
                CHECK(unevenness(bins) < 4);
            }
}

TEST_CASE("numbers of different pixels, seeds and samples are independent") {
    for (const SamplerKind kind : kinds) {
        std::array<Mean, 3> other;
        for (int pixel = 0; pixel < 30'000; ++pixel) {
            const Point here = point_of(kind, pixel, 3, 64, 1);
            const std::array points{point_of(kind, pixel + 1, 3, 64, 1), point_of(kind, pixel, 3, 64, 2),
                                    point_of(kind, pixel + 640, 3, 64, 1)};
            for (std::size_t k = 0; k < points.size(); ++k) {
                REQUIRE(here != points[k]);
                double sum = 0;
                for (std::size_t d = 0; d < dimensions; ++d)
                    sum += double(here[d] - 0.5f) * double(points[k][d] - 0.5f);
                other[k].add(sum);
            }
        }
        INFO(name(kind) << ": the pixel to the right " << other[0].against(0) << "; another seed "
                        << other[1].against(0) << "; the pixel below " << other[2].against(0));
        for (const Mean& mean : other) CHECK(std::abs(mean.z(0)) < 4);
        CHECK(point_of(kind, 8, 0, 64) != point_of(kind, 8, 1, 64));
        CHECK_MESSAGE(point_of(kind, 8, 5, 64) == point_of(kind, 8, 5, 64),
                      "the numbers depend on earlier calls");
    }
}

TEST_CASE("the random sampler returns the numbers of Random") {
    Random random(4, 2, 9, 77), same = random;
    Sampler of_sample(SamplerKind::random, PixelSample{4, 2, 9, 16, random, 77}), of_random(random);
    for (int i = 0; i < 10; ++i) {
        const float one = same.get_1d();
        const vec2 two = same.get_2d();
        CHECK(of_sample.get_1d() == one);
        CHECK(of_random.get_1d() == one);
        CHECK(of_sample.get_2d() == two);
        CHECK(of_random.get_2d() == two);
    }
}

TEST_CASE("every sample of every pixel has its own position") {
    const auto first = [](SamplerKind kind, int x, int y, int index, std::uint64_t seed) {
        return Sampler(kind, PixelSample{x, y, index, 16, Random(x, y, index, seed), seed}).get_2d();
    };
    for (const SamplerKind kind : kinds) {
        INFO(name(kind)
             << ": equal positions mean that all pixels share one seed (a fixed pattern over the picture)");
        const vec2 here = first(kind, 0, 0, 0, 1);
        CHECK(here != first(kind, 1, 0, 0, 1));
        CHECK(here != first(kind, 0, 1, 0, 1));
        CHECK(first(kind, 1, 0, 0, 1) != first(kind, 0, 1, 0, 1));
        CHECK(here != first(kind, 0, 0, 0, 2));
        CHECK_MESSAGE(here != first(kind, 0, 0, 1, 1), "the generator restarts at every sample");
    }
}

TEST_CASE("render gives neighbouring pixels and samples different positions") {
    std::array<vec2, 6> places{};
    RenderSettings wanted = picture(2, 2, 2);
    wanted.threads = 1;
    render(wanted, [&](const PixelSample& sample) {
        const vec2 u = Sampler(SamplerKind::random, sample).get_2d();
        const int pixel = sample.y * 2 + sample.x;
        if (pixel < 3) places[std::size_t(pixel * 2 + sample.index)] = u;
        return vec3(0);
    });
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            INFO("sample " << i % 2 << " of pixel " << i / 2 << " and sample " << j % 2 << " of pixel "
                           << j / 2);
            CHECK(places[i] != places[j]);
        }
}

// ---- purpose

TEST_CASE("the error of a smooth mean decreases much faster for even samples") {
    // For the first two dimensions, the last two, and the sum over all six: evenness does not degrade.
    const auto bump = [](float x, float y) { return double(std::exp(-x) * (1 + x * y)); };
    const auto exact = 0.632120559 + 0.264241118 / 2; // (1 - 1/e) + (1 - 2/e) / 2
    const std::array<double, 3> factor{0, 30, 200};   // minimum ratio of squared errors at 256
    for (int part = 0; part < 3; ++part) {
        std::array<std::array<double, 3>, 3> squared{};
        for (const SamplerKind kind : kinds)
            for (std::size_t n = 0; n < 3; ++n) {
                const int count = 16 << (2 * n);
                for (int pixel = 0; pixel < 200; ++pixel) {
                    double sum = 0;
                    for (const Point& p : points_of(kind, pixel, count)) {
                        if (part != 1) sum += bump(p[0], p[1]) - exact;
                        if (part != 0) sum += bump(p[3], p[4]) - exact;
                        if (part == 2) sum += double(p[2]) - 0.5 + double(p[5] * p[5]) - 1.0 / 3;
                    }
                    squared[std::size_t(kind)][n] += sum / count * sum / count / 200;
                }
            }
        const auto& random = squared[0];
        for (const SamplerKind kind : even_kinds) {
            const auto& even = squared[std::size_t(kind)];
            INFO("part " << part << ", " << name(kind)
                         << ": random / even at 16, 64 and 256 samples: " << random[0] / even[0] << ", "
                         << random[1] / even[1] << ", " << random[2] / even[2]);
            CHECK(random[2] / even[2] > factor[std::size_t(kind)]);
            CHECK(random[2] / even[2] > 4 * random[0] / even[0]);
        }
    }
}

TEST_CASE("16 even samples have less than half of the variance at an edge of 16 random samples") {
    // The line crosses pixels at all angles and distances; p is the share on its inner side.
    std::array<Mean, 3> variance;
    Random shapes(37);
    for (int trial = 0; trial < 60; ++trial) {
        const float angle = 2 * pi * shapes.get_1d();
        const vec2 outward(std::cos(angle), std::sin(angle));
        const vec2 through = vec2(0.5f) + (shapes.get_1d() - 0.5f) * 0.6f * outward;
        for (const SamplerKind kind : kinds) {
            double share = 0, squares = 0;
            std::array<double, 100> got{};
            for (int pixel = 0; pixel < 100; ++pixel) {
                int inside = 0;
                for (int i = 0; i < 16; ++i)
                    inside += dot(first_point(kind, i, 16, trial * 100 + pixel, 41) - through, outward) < 0;
                got[std::size_t(pixel)] = inside / 16.0;
                share += inside / 1600.0;
            }
            for (const double value : got) squares += (value - share) * (value - share) / 99;
            if (share > 0.05 && share < 0.95)
                variance[std::size_t(kind)].add(squares / (share * (1 - share) / 16));
        }
    }
    const Mean &random = variance[0], &stratified = variance[1], &sobol = variance[2];
    INFO("variances in units of p (1 - p) / 16: random samples "
         << random.mean() << ", stratified " << stratified.mean() << ", Sobol " << sobol.mean());
    CHECK_MESSAGE(stratified.mean() < 0.5,
                  "as much as random samples: the samples do not stay in their cells");
    CHECK_MESSAGE(sobol.mean() < 0.5, "as much as random samples: these are not Sobol points");
    CHECK_MESSAGE(std::abs(random.z(1)) < 4, "the random samples are not random: " << random.against(1));
}
