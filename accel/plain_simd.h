// Lanes of numbers without SIMD: slow, with the same results, and what simd.h needs of other compilers.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

namespace rt::accel {

template <typename Number, int count>
struct alignas(count * sizeof(Number)) Lanes {
    Number numbers[count];

    Lanes() = default; ///< without values; Lanes{} is zero
    Lanes(Number all) {
        for (Number& number : numbers) number = all;
    }
    Lanes(std::convertible_to<Number> auto... each) requires(sizeof...(each) == count)
        : numbers{Number(each)...} {}

    Number& operator[](std::size_t lane) { return numbers[lane]; }
    Number operator[](std::size_t lane) const { return numbers[lane]; }

    template <typename Result>
    static Result for_each(const auto& value_of) {
        Result result;
        for (std::size_t i = 0; i < count; ++i) result[i] = value_of(i);
        return result;
    }

    using Mask = Lanes<std::int32_t, count>; ///< a comparison gives -1 or 0 per lane

    friend Lanes operator+(const Lanes& a, const Lanes& b) {
        return for_each<Lanes>([&](std::size_t i) { return a[i] + b[i]; });
    }
    friend Lanes operator-(const Lanes& a, const Lanes& b) {
        return for_each<Lanes>([&](std::size_t i) { return a[i] - b[i]; });
    }
    friend Lanes operator*(const Lanes& a, const Lanes& b) {
        return for_each<Lanes>([&](std::size_t i) { return a[i] * b[i]; });
    }
    friend Lanes operator/(const Lanes& a, const Lanes& b) {
        return for_each<Lanes>([&](std::size_t i) { return a[i] / b[i]; });
    }
    friend Mask operator<(const Lanes& a, const Lanes& b) {
        return for_each<Mask>([&](std::size_t i) { return -int(a[i] < b[i]); });
    }
    friend Mask operator>(const Lanes& a, const Lanes& b) { return b < a; }
    friend Mask operator<=(const Lanes& a, const Lanes& b) {
        return for_each<Mask>([&](std::size_t i) { return -int(a[i] <= b[i]); });
    }
    friend Lanes select(const Mask& mask, const Lanes& a, const Lanes& b) {
        return for_each<Lanes>([&](std::size_t i) { return mask[i] != 0 ? a[i] : b[i]; });
    }
    friend Mask truncated(const Lanes& a) {
        return for_each<Mask>([&](std::size_t i) { return std::int32_t(a[i]); });
    }
};

} // namespace rt::accel
