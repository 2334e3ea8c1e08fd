// Facts about Sobol points: which they are, and what scrambling leaves of them. Seeds are fixed: a right
// scrambling is beyond z = 4 in one run of 31,000.
#include "07_antialias/sobol.h"
#include "tests/07_antialias/step.h"
#include "tests/check.h"

#include <array>
#include <bit>
#include <vector>

using namespace rt;

TEST_CASE("Sobol's first points are those of the book, and the rest follow its direction numbers") {
    const std::array<vec2, 8> book{vec2(0, 0),           vec2(0.5f, 0.5f),     vec2(0.25f, 0.75f),
                                   vec2(0.75f, 0.25f),   vec2(0.125f, 0.625f), vec2(0.625f, 0.125f),
                                   vec2(0.375f, 0.375f), vec2(0.875f, 0.875f)};
    for (std::uint32_t i = 0; i < 8; ++i) {
        INFO("point " << i);
        CHECK(vec2(to_unit_float(i), to_unit_float(sobol_dimension_1(i))) == approx(book[i]));
    }
    // Of the polynomial x + 1: m_1 = 1, m_k = 2 m_(k-1) xor m_(k-1); bit k-1 of the index adds m_k / 2^k.
    std::uint32_t m = 1;
    for (int k = 1; k <= 32; ++k) {
        const std::uint32_t direction = m << (32 - k);
        INFO("direction " << k);
        CHECK(sobol_dimension_1(1u << (k - 1)) == reverse_bits(direction));
        m = 2 * m ^ m;
    }
    for (std::uint32_t i = 1; i < 1000; ++i) // and sums of indices without a common bit are sums of points
        CHECK(sobol_dimension_1(i) == (sobol_dimension_1(i & (i - 1)) ^ sobol_dimension_1(i & ~(i - 1))));
}

TEST_CASE("Owen's scrambling sends boxes to boxes, and flips each digit for itself") {
    Random random(5);
    for (int trial = 0; trial < 10'000; ++trial) {
        const auto a = std::uint32_t(random.bits()), b = std::uint32_t(random.bits()) << (trial % 31) ^ a;
        const auto key = std::uint32_t(random.bits());
        INFO("digits that agree from the front on still agree, and the first that differs still differs");
        CHECK(std::countr_zero(owen_scramble(a, key) ^ owen_scramble(b, key)) == std::countr_zero(a ^ b));
    }
    // Digit d is flipped by chance alone, and by another chance below another digit before it.
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
