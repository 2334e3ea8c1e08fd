// Facts about the numbers of a sample: even over the samples of a pixel in each dimension, and without any
// knowledge of each other across dimensions, pixels and seeds. Seeds are fixed: a right sampler is beyond
// z = 4 in one run of 31,000 for the one-sided tests of spread, of 16,000 for the two-sided ones of a mean.
#include "07_antialias/sampler.h"
#include "tests/check.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

using namespace rt;

namespace {

const std::array kinds{SamplerKind::random, SamplerKind::stratified, SamplerKind::sobol};
const std::array even_kinds{SamplerKind::stratified, SamplerKind::sobol};

std::string name(SamplerKind kind) {
    return std::array{"random", "stratified", "Sobol"}[std::size_t(kind)];
}

Sampler sampler_of(SamplerKind kind, int pixel, int index, int count, std::uint64_t seed) {
    return {kind, Sample{pixel % 640, pixel / 640, index, count,
                         Random(pixel % 640, pixel / 640, index, seed), seed}};
}

/// What a sample asks for in these tests: a pair, a number, a pair, a number.
constexpr std::size_t dimensions = 6;
using Point = std::array<float, dimensions>;

Point point_of(SamplerKind kind, int pixel, int index, int count, std::uint64_t seed = 3) {
    Sampler sampler = sampler_of(kind, pixel, index, count, seed);
    const vec2 a = sampler.uniform2();
    const float b = sampler.uniform();
    const vec2 c = sampler.uniform2();
    return {a.x, a.y, b, c.x, c.y, sampler.uniform()};
}

std::vector<Point> points_of(SamplerKind kind, int pixel, int count, std::uint64_t seed = 3) {
    std::vector<Point> points;
    for (int i = 0; i < count; ++i) points.push_back(point_of(kind, pixel, i, count, seed));
    return points;
}

/// How many standard deviations these counts are more uneven than even chances make them: Pearson's
/// chi-square, made normal by Wilson and Hilferty (1931).
double unevenness(const std::vector<int>& counts) {
    double sum = 0, chi_square = 0;
    for (const int count : counts) sum += count;
    const double expected = sum / double(counts.size()), freedom = double(counts.size()) - 1;
    for (const int count : counts) chi_square += (count - expected) * (count - expected) / expected;
    const double spread = 2 / (9 * freedom);
    return (std::cbrt(chi_square / freedom) - (1 - spread)) / std::sqrt(spread);
}

std::size_t bin(float u, int bins) {
    return std::size_t(std::min(int(u * float(bins)), bins - 1));
}

/// How many samples the fullest of `columns` x `rows` equal boxes holds.
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

// ---- what samplers are made of

TEST_CASE("a permutation reaches every place once, for any count and key") {
    for (int count = 1; count <= 200; ++count)
        for (std::uint64_t key = 1; key <= 20; ++key) {
            std::vector<int> visits(std::size_t(count), 0);
            for (int i = 0; i < count; ++i) {
                const int place = permuted(i, count, scatter(key));
                REQUIRE(place >= 0);
                REQUIRE(place < count);
                ++visits[std::size_t(place)];
            }
            INFO(count << " places, key " << key << ": two samples share a place and another stays empty");
            CHECK(*std::max_element(visits.begin(), visits.end()) == 1);
        }
}

TEST_CASE("over the keys, any two samples are sent to any two places equally often") {
    for (const int count : {2, 3, 4, 5, 7, 8, 12, 16, 30, 64}) {
        const auto n = std::size_t(count);
        std::vector<int> found(n * n, 0);
        const auto first = int(scatter(std::uint64_t(count)) % n);
        const int second = (first + 1) % count;
        for (int key = 0; key < 40 * count * count; ++key) {
            const std::uint64_t bits = scatter(std::uint64_t(key) << 8 | n);
            const auto place = std::size_t(permuted(first, count, bits));
            ++found[place * n + std::size_t(permuted(second, count, bits))];
        }
        std::vector<int> off_diagonal;
        for (std::size_t i = 0; i < n * n; ++i)
            if (i / n != i % n) off_diagonal.push_back(found[i]);
        INFO(count << " places: z = " << unevenness(off_diagonal)
                   << "; the permutations are too few or alike");
        CHECK(unevenness(off_diagonal) < 4);
    }
}

TEST_CASE("Sobol's first points are those of the book, and the rest follow its direction numbers") {
    const std::array<vec2, 8> book{vec2(0, 0),           vec2(0.5f, 0.5f),     vec2(0.25f, 0.75f),
                                   vec2(0.75f, 0.25f),   vec2(0.125f, 0.625f), vec2(0.625f, 0.125f),
                                   vec2(0.375f, 0.375f), vec2(0.875f, 0.875f)};
    for (std::uint32_t i = 0; i < 8; ++i) {
        INFO("point " << i);
        CHECK(vec2(fraction(i), fraction(sobol_second(i))) == approx(book[i]));
    }
    // Of the polynomial x + 1: m_1 = 1, m_k = 2 m_(k-1) xor m_(k-1); bit k-1 of the index adds m_k / 2^k.
    std::uint32_t m = 1;
    for (int k = 1; k <= 32; ++k) {
        const std::uint32_t direction = m << (32 - k);
        INFO("direction " << k);
        CHECK(sobol_second(1u << (k - 1)) == reversed_bits(direction));
        m = 2 * m ^ m;
    }
    for (std::uint32_t i = 1; i < 1000; ++i) // and sums of indices without a common bit are sums of points
        CHECK(sobol_second(i) == (sobol_second(i & (i - 1)) ^ sobol_second(i & ~(i - 1))));
}

TEST_CASE("Owen's scrambling sends boxes to boxes, and flips each digit for itself") {
    Random random(5);
    for (int trial = 0; trial < 10'000; ++trial) {
        const auto a = std::uint32_t(random.bits()), b = std::uint32_t(random.bits()) << (trial % 31) ^ a;
        const auto key = std::uint32_t(random.bits());
        INFO("digits that agree from the front on still agree, and the first that differs still differs");
        CHECK(std::countr_zero(owen_scrambled(a, key) ^ owen_scrambled(b, key)) == std::countr_zero(a ^ b));
    }
    // Digit d is flipped by chance alone, and by another chance below another digit before it.
    for (int digit = 0; digit < 12; ++digit)
        for (int before = 0; before < digit; ++before) {
            std::vector<int> flips(4, 0);
            for (int key = 0; key < 10'000; ++key) {
                const auto bits = std::uint32_t(scatter(std::uint64_t(key)));
                const auto flip = [&](std::uint32_t x) { return owen_scrambled(x, bits) >> digit & 1; };
                ++flips[flip(0) * 2 + flip(1u << before)];
            }
            INFO("digit " << digit << " below a 0 and a 1 of digit " << before
                          << ": z = " << unevenness(flips));
            CHECK(unevenness(flips) < 4);
        }
}

// ---- even over the samples of a pixel

TEST_CASE("of 2^k Sobol samples one lies in every box of area 2^-k, whatever its shape") {
    for (int k = 0; k <= 10; ++k)
        for (const int pixel : {0, 1, 99'999}) {
            const std::vector<Point> points = points_of(SamplerKind::sobol, pixel, 1 << k);
            for (int a = 0; a <= k; ++a)
                for (const std::size_t first : {0u, 3u}) {
                    INFO((1 << k) << " samples, boxes 2^-" << a << " wide, dimensions " << first << " and "
                                  << first + 1 << ": 2 samples in a box leave another empty");
                    CHECK(fullest_box(pairs_of(points, first), 1 << a, 1 << (k - a)) == 1);
                }
            for (const std::size_t single : {2u, 5u}) {
                std::vector<vec2> line;
                for (const Point& point : points) line.emplace_back(point[single], 0);
                CHECK(fullest_box(line, 1 << k, 1) == 1);
            }
        }
}

TEST_CASE("of any number of Sobol samples no two share a box that the next power of two divides into") {
    for (int count = 1; count <= 130; ++count) {
        const int k = std::bit_width(std::uint32_t(count - 1));
        const std::vector<Point> points = points_of(SamplerKind::sobol, 7, count);
        for (int a = 0; a <= k; ++a) {
            INFO(count << " samples, boxes 2^-" << a << " x 2^-" << k - a);
            CHECK(fullest_box(pairs_of(points, 3), 1 << a, 1 << (k - a)) == 1);
        }
    }
}

TEST_CASE("of any number of stratified samples one lies in every cell, in every dimension") {
    for (int count = 1; count <= 130; ++count) {
        const std::vector<Point> points = points_of(SamplerKind::stratified, 7, count);
        for (const std::size_t single : {2u, 5u}) {
            std::vector<int> cells(std::size_t(count), 0);
            // The float nearest to a cell's border may stand a rounding before it: a nudge keeps it inside.
            for (const Point& point : points) ++cells[bin(point[single] + 1e-7f, count)];
            INFO(count << " samples, dimension " << single);
            CHECK(*std::max_element(cells.begin(), cells.end()) == 1);
        }
        const int rows = int(std::sqrt(float(count)));
        if (rows * rows != count)
            continue; // cells of other counts: see "each of 1 to 100 stratified samples"
        for (const std::size_t first : {0u, 3u}) {
            INFO(count << " samples, dimensions " << first << " and " << first + 1);
            std::vector<vec2> pairs = pairs_of(points, first);
            for (vec2& pair : pairs) pair += 1e-7f;
            CHECK(fullest_box(pairs, rows, rows) == 1);
        }
    }
}

TEST_CASE("every sample is spread evenly over the pixels, in every dimension") {
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
                                << "; beyond 4 the mean of a picture is not the mean of light");
                CHECK(unevenness(bins[d]) < 4);
            }
        }
}

TEST_CASE("no number reaches 1") {
    CHECK(fraction(0xffffffffu) < 1);
    Random random(5);
    const int count = 1 << 24;
    float largest = 0;
    for (int repeat = 0; repeat < 100'000; ++repeat)
        largest = std::max(largest, stratified_number(count - 1, count, random));
    CHECK_MESSAGE(largest < 1, "the last cell and the jitter add up to 1");
    for (const SamplerKind kind : kinds)
        for (int index = 0; index < 100'000; ++index)
            for (const float u : point_of(kind, 1, index, 100'000)) {
                REQUIRE(u >= 0);
                REQUIRE(u < 1);
            }
}

// ---- no knowledge of each other

TEST_CASE("two dimensions of a pixel fill their square as evenly as chance does, or better") {
    // With c = 12 (u - 1/2) (v - 1/2), the mean of n samples' c has the variance 1 / n for random samples,
    // 1 / (n - 1) for dimensions that are even, but permuted against each other.
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
                INFO("in a single pixel, n x its square: " << square.mean()
                                                           << "; about n: both dimensions go through the "
                                                              "samples in the same order");
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

TEST_CASE("a pixel, a seed or a sample more, and the numbers know nothing of those before") {
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
                      "numbers depend on what was asked before");
    }
}

TEST_CASE("the random sampler hands out what Random does") {
    Random random(4, 2, 9, 77), same = random;
    Sampler of_sample(SamplerKind::random, Sample{4, 2, 9, 16, random, 77}), of_random(random);
    for (int i = 0; i < 10; ++i) {
        const float one = same.uniform();
        const vec2 two = same.uniform2();
        CHECK(of_sample.uniform() == one);
        CHECK(of_random.uniform() == one);
        CHECK(of_sample.uniform2() == two);
        CHECK(of_random.uniform2() == two);
    }
}

// ---- what it is for

TEST_CASE("the error of a smooth mean falls much faster for even samples") {
    // In the first two dimensions, the last two, and in sum over all six: evenness does not fade.
    const auto bump = [](float x, float y) { return double(std::exp(-x) * (1 + x * y)); };
    const auto exact = 0.632120559 + 0.264241118 / 2; // (1 - 1/e) + (1 - 2/e) / 2
    const std::array<double, 3> factor{0, 30, 200};   // at least this much less squared error at 256
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
