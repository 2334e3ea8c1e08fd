// Facts about SIMD vectors: comparisons, masks, and NaN, lane by lane.
#include "accel/simd.h"
#include "tests/check.h"

#include <cmath>

using namespace rt;
using namespace rt::accel;

namespace {

/// Returns these numbers in the first lanes and 100 in the others.
FloatN lanes_of(std::initializer_list<float> numbers) {
    FloatN all = broadcast(100);
    int lane = 0;
    for (const float number : numbers) all[lane++] = number;
    return all;
}

} // namespace

TEST_CASE("the bits of movemask() are in the order of the lanes") {
    const unsigned all = (1u << simd_width) - 1;
    const FloatN values = lanes_of({3, -1, -5, 0});
    CHECK(movemask(values < 0) == 0b0110u);
    CHECK(movemask(values < -10) == 0);
    CHECK(movemask(values > -10) == all);
    FloatN last = broadcast(1);
    last[simd_width - 1] = -1;
    CHECK(movemask(last < 0) == 1u << (simd_width - 1));
    unsigned mask = 0b01011010u;
    CHECK(pop_lowest_bit(mask) == 1);
    CHECK(pop_lowest_bit(mask) == 3);
    CHECK(mask == 0b01010000u);
}

TEST_CASE("less() and less_equal() compare lane by lane and are false for NaN") {
    const float nan = std::nanf("");
    const FloatN a = lanes_of({1, 5, nan, 2}), b = lanes_of({2, 4, 3, 2});
    CHECK((less(a, b) & 0b1111u) == 0b0001u);
    CHECK((less_equal(a, b) & 0b1111u) == 0b1001u);
    CHECK((less(b, a) & 0b1111u) == 0b0010u);
    FloatN last = broadcast(1);
    last[simd_width - 1] = -1;
    CHECK(less(last, FloatN{}) == 1u << (simd_width - 1));
    CHECK(less_equal(last, FloatN{}) == 1u << (simd_width - 1));
}

TEST_CASE("min() and max() return the second operand if one is NaN") {
    const float nan = std::nanf("");
    const FloatN a = lanes_of({1, 5, nan, 2}), b = lanes_of({2, 4, 3, nan});
    CHECK(min(a, b)[0] == 1);
    CHECK(min(a, b)[1] == 4);
    CHECK(min(a, b)[2] == 3);
    CHECK(max(a, b)[0] == 2);
    CHECK(max(a, b)[2] == 3);
    CHECK(std::isnan(max(a, b)[3]));
}
