// Facts about the random numbers: their fixed values, and their statistical quality.
// The seeds are fixed, so the results are reproducible; the stated rates of false alarms
// apply if the generator changes.
#include "common/math/random.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <vector>

namespace {

constexpr int size = 1 << 20;

/// Returns Pearson's r of a[i] and b[i]. For independent numbers it is approximately normal
/// with deviation 1 / sqrt(n).
double correlation(const std::vector<float>& a, const std::vector<float>& b) {
    double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double u = double(a[i]), v = double(b[i]);
        sum_a += u;
        sum_b += v;
        aa += u * u;
        bb += v * v;
        ab += u * v;
    }
    const double n = double(a.size());
    return (ab - sum_a * sum_b / n) / std::sqrt((aa - sum_a * sum_a / n) * (bb - sum_b * sum_b / n));
}

/// Returns the limit of |r|: 5 standard deviations, one false alarm in 1.7 million.
double correlation_limit(std::size_t count) {
    return 5 / std::sqrt(double(count));
}

/// Returns Pearson's chi-square of 256 equal bins: 255 degrees of freedom.
double chi_square(const std::vector<float>& numbers) {
    std::array<double, 256> bins{};
    for (const float u : numbers) bins[std::size_t(u * 256)] += 1;
    const double expected = double(numbers.size()) / 256;
    double sum = 0;
    for (const double found : bins) sum += (found - expected) * (found - expected) / expected;
    return sum;
}

/// Checks uniformity with one false alarm in a million: half of it too low (too even), half too high.
void check_uniform(const std::vector<float>& numbers) {
    const double found = chi_square(numbers);
    CHECK(found > 159.4);
    CHECK(found < 381.1);
}

std::vector<float> one_stream() {
    rt::Random random(20, 30, 4, 1);
    std::vector<float> numbers(size);
    for (float& u : numbers) u = random.get_1d();
    return numbers;
}

/// Returns the first number of each pixel of a 1024 x 1024 picture, offset by (dx, dy)
/// pixels, dsample and dseed.
std::vector<float> first_numbers(int dx, int dy, int dsample, int dseed) {
    std::vector<float> numbers;
    for (int y = 0; y < 1024; ++y)
        for (int x = 0; x < 1024; ++x)
            numbers.push_back(rt::Random(x + dx, y + dy, dsample, std::uint64_t(1 + dseed)).get_1d());
    return numbers;
}

} // namespace

TEST_CASE("mix64 with a counter gives the published numbers of SplitMix64") {
    // Seed 1234567; many other implementations test these numbers.
    std::uint64_t counter = 1234567;
    CHECK(rt::mix64(counter += 0x9e3779b97f4a7c15u) == 6457827717110365317u);
    CHECK(rt::mix64(counter += 0x9e3779b97f4a7c15u) == 3203168211198807973u);
    CHECK(rt::mix64(counter += 0x9e3779b97f4a7c15u) == 9817491932198370423u);
}

TEST_CASE("the first random numbers are fixed on every machine") {
    struct Pin {
        int x, y, sample;
        std::uint64_t seed;
        std::array<std::uint64_t, 3> bits;
    };
    // Computed from the definition by a program in a different language.
    const Pin pins[] = {
        {0, 0, 0, 0, {0xe220a8397b1dcdaf, 0x6e789e6aa1b965f4, 0x06c45d188009454f}},
        {0, 0, 0, 1, {0x4181b152fb77616f, 0x169c646d52269d62, 0x4a5de8d8d53b7280}},
        {1, 0, 0, 1, {0x7f57b93309eec620, 0x75fcc279b1187c8f, 0x9d639bb9b29be4cc}},
        {0, 1, 0, 1, {0x93bb34c1b1f13c09, 0x8379bad707234884, 0xca922ebb723d3fbe}},
        {0, 0, 1, 1, {0x275f2ae791fef8a1, 0x0091f1cf4437d33e, 0xee57a3a974d5f617}},
        {639, 399, 8, 1, {0xca07baca4978257c, 0x5d433512785064a1, 0xbcd6b1c374a91a34}},
        {1048575,
         1048575,
         16777215,
         ~std::uint64_t(0),
         {0xee9a84b4a8ad7116, 0xb1a64439ce2d8a65, 0xe52011b65e22005b}},
    };
    for (const Pin& pin : pins) {
        CAPTURE(pin.x);
        CAPTURE(pin.y);
        CAPTURE(pin.sample);
        rt::Random random(pin.x, pin.y, pin.sample, pin.seed);
        for (const std::uint64_t expected : pin.bits) CHECK(random.bits() == expected);
    }
    rt::Random keyed(42);
    CHECK(keyed.bits() == 0x989b3f130a063869);
}

TEST_CASE("get_1d is the top 24 bits as a fraction and get_2d draws x before y") {
    rt::Random random(0, 0, 0, 1);
    CHECK(random.get_1d() == 4293041 / 16777216.0f);
    CHECK(random.get_1d() == 1481828 / 16777216.0f);
    const rt::vec2 point = random.get_2d();
    CHECK(point.x == 4873704 / 16777216.0f);
    CHECK(point.y == 9500655 / 16777216.0f);
}

TEST_CASE("different pixels, samples and seeds have different streams") {
    std::set<std::uint64_t> firsts;
    std::size_t streams = 0;
    const auto add = [&](int x, int y, int sample, std::uint64_t seed) {
        ++streams;
        firsts.insert(rt::Random(x, y, sample, seed).bits());
    };
    add(0, 0, 0, 7);
    for (int bit = 0; bit < 20; ++bit) { // every bit that the comment permits
        add(1 << bit, 0, 0, 7);
        add(0, 1 << bit, 0, 7);
    }
    for (int bit = 0; bit < 24; ++bit) add(0, 0, 1 << bit, 7);
    for (int bit = 0; bit < 64; ++bit) add(0, 0, 0, 7 ^ std::uint64_t(1) << bit);
    for (int y = 1; y < 20; ++y)
        for (int x = 1; x < 20; ++x)
            for (int sample = 1; sample < 20; ++sample)
                add(x << 1 | 1, y << 1 | 1, sample << 1 | 1,
                    7); // odd, so that none repeats a stream from above
    CHECK(firsts.size() == streams);
}

TEST_CASE("get_1d is at least 0 and below 1 with mean 1/2 and variance 1/12") {
    double sum = 0, squares = 0;
    float least = 1, most = 0;
    for (const float u : one_stream()) {
        sum += double(u);
        squares += (double(u) - 0.5) * (double(u) - 0.5);
        least = std::min(least, u);
        most = std::max(most, u);
    }
    CHECK(least >= 0);
    CHECK(most < 1);
    CHECK(least < 2e-5f); // of 2^20 numbers: e^-20 is the probability of none below this
    CHECK(most > 1 - 2e-5f);
    // 5 standard deviations each: sqrt(1/12 / n) and sqrt(1/180 / n).
    CHECK(std::abs(sum / size - 0.5) < 5 * std::sqrt(1 / 12.0 / size));
    CHECK(std::abs(squares / size - 1 / 12.0) < 5 * std::sqrt(1 / 180.0 / size));
}

TEST_CASE("the largest bits still give a number below 1") {
    constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
    CHECK(float(most >> 40) * 0x1p-24f < 1.0f); // what get_1d() does with them; 25 bits would round up
    CHECK(float(most >> 39) * 0x1p-25f == 1.0f);
}

TEST_CASE("the numbers of one stream fill the unit interval evenly") {
    check_uniform(one_stream());
}

TEST_CASE("the first numbers of the pixels of a picture fill the unit interval evenly") {
    check_uniform(first_numbers(0, 0, 0, 0));
}

TEST_CASE("consecutive numbers of a stream are uncorrelated") {
    const std::vector<float> numbers = one_stream();
    for (const std::ptrdiff_t lag : {1, 2, 3}) {
        CAPTURE(lag);
        const std::vector<float> early(numbers.begin(), numbers.end() - lag);
        const std::vector<float> late(numbers.begin() + lag, numbers.end());
        CHECK(std::abs(correlation(early, late)) < correlation_limit(early.size()));
    }
}

TEST_CASE("neighbouring pixels, samples and seeds are uncorrelated") {
    const std::vector<float> here = first_numbers(0, 0, 0, 0);
    const int moves[][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {1, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
    for (const auto& move : moves) {
        CAPTURE(move[0]);
        CAPTURE(move[1]);
        CAPTURE(move[2]);
        CAPTURE(move[3]);
        const std::vector<float> there = first_numbers(move[0], move[1], move[2], move[3]);
        CHECK(std::abs(correlation(here, there)) < correlation_limit(here.size()));
    }
}

TEST_CASE("pairs of numbers fill the unit square evenly") {
    // 16 x 16 cells, from the two numbers of get_2d, over the pixels of a picture:
    // stripes would be detected here.
    std::vector<float> cells;
    for (int y = 0; y < 512; ++y) {
        for (int x = 0; x < 512; ++x) {
            const rt::vec2 point = rt::Random(x, y, 0, 1).get_2d();
            cells.push_back((std::floor(point.x * 16) * 16 + std::floor(point.y * 16) + 0.5f) / 256);
        }
    }
    check_uniform(cells);
}
