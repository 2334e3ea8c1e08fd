// Facts about Sobol points: their values, and what scrambling preserves.
// Seeds are fixed: a correct scrambling exceeds z = 4 in one run out of 31,000.
#include "07_antialias/sobol.h"
#include "tests/07_antialias/step.h"
#include "tests/check.h"

#include <array>
#include <bit>
#include <vector>

using namespace rt;

TEST_CASE("Sobol's first points are the published ones, and the rest follow from the direction numbers") {
    const std::array<vec2, 8> book{vec2(0, 0),           vec2(0.5f, 0.5f),     vec2(0.25f, 0.75f),
                                   vec2(0.75f, 0.25f),   vec2(0.125f, 0.625f), vec2(0.625f, 0.125f),
                                   vec2(0.375f, 0.375f), vec2(0.875f, 0.875f)};
    for (std::uint32_t i = 0; i < 8; ++i) {
        INFO("point " << i);
        CHECK(vec2(to_unit_float(i), to_unit_float(sobol_dimension_1(i))) == approx(book[i]));
    }
    // For the polynomial x + 1: m_1 = 1, m_k = 2 m_(k-1) xor m_(k-1); bit k-1 of the index adds m_k / 2^k.
    std::uint32_t m = 1;
    for (int k = 1; k <= 32; ++k) {
        const std::uint32_t direction = m << (32 - k);
        INFO("direction " << k);
        CHECK(sobol_dimension_1(1u << (k - 1)) == reverse_bits(direction));
        m = 2 * m ^ m;
    }
    for (std::uint32_t i = 1; i < 1000;
         ++i) // indices without a common bit: the point of a sum is the sum of the points
        CHECK(sobol_dimension_1(i) == (sobol_dimension_1(i & (i - 1)) ^ sobol_dimension_1(i & ~(i - 1))));
}

TEST_CASE("Owen scrambling maps boxes to boxes and flips each digit independently") {
    Random random(5);
    for (int trial = 0; trial < 10'000; ++trial) {
        const auto a = std::uint32_t(random.bits()), b = std::uint32_t(random.bits()) << (trial % 31) ^ a;
        const auto key = std::uint32_t(random.bits());
        INFO("leading digits that agree must still agree, and the first that differs must still differ");
        CHECK(std::countr_zero(owen_scramble(a, key) ^ owen_scramble(b, key)) == std::countr_zero(a ^ b));
    }
    // The flip of digit d is random, and independent for different values of an earlier digit.
    for (int digit = 0; digit < 12; ++digit)
        for (int before = 0; before < digit; ++before) {
            std::vector<int> flips(4, 0);
            for (int key = 0; key < 10'000; ++key) {
                const auto bits = std::uint32_t(mix64(std::uint64_t(key)));
                const auto flip = [&](std::uint32_t x) { return owen_scramble(x, bits) >> digit & 1; };
                ++flips[flip(0) * 2 + flip(1u << before)];
            }
            INFO("digit " << digit << " below a 0 and a 1 of digit " << before
                          << ": z = " << unevenness(flips));
            CHECK(unevenness(flips) < 4);
        }
}
