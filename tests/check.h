// Shared by all checks: approximate comparison, readable failure output, means with standard errors.
#pragma once

#include "common/math/vec.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>

/// Marks a check that cannot run on this machine, with the reason; ctest reports it as skipped.
#define SKIP_CHECK(reason) MESSAGE((std::string("[skipped] ") + (reason)))

namespace rt {

/// Returns nine significant digits, enough to distinguish any two floats.
inline std::string to_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}
inline std::string to_text(vec2 v) {
    return "(" + to_text(v.x) + ", " + to_text(v.y) + ")";
}
inline std::string to_text(vec3 v) {
    return "(" + to_text(v.x) + ", " + to_text(v.y) + ", " + to_text(v.z) + ")";
}

/// The right-hand side of CHECK(got == approx(want)): each component may differ by at most `tolerance` *
/// max(1, |want|). NaN equals nothing; an infinity equals only itself.
template <typename Value>
struct Approx {
    Value want;
    float tolerance;
};

inline Approx<float> approx(float want, float tolerance = 1e-5f) {
    return {want, tolerance};
}
inline Approx<vec2> approx(vec2 want, float tolerance = 1e-5f) {
    return {want, tolerance};
}
inline Approx<vec3> approx(vec3 want, float tolerance = 1e-5f) {
    return {want, tolerance};
}

inline bool operator==(float got, const Approx<float>& approx) {
    const float allowed = approx.tolerance * std::max(1.0f, std::abs(approx.want));
    return got == approx.want || (std::isfinite(approx.want) && std::abs(got - approx.want) <= allowed);
}
inline bool operator==(vec2 got, const Approx<vec2>& approx) {
    const auto [want, tolerance] = approx;
    return got.x == Approx<float>{want.x, tolerance} && got.y == Approx<float>{want.y, tolerance};
}
inline bool operator==(vec3 got, const Approx<vec3>& approx) {
    const auto [want, tolerance] = approx;
    return got.x == Approx<float>{want.x, tolerance} && got.y == Approx<float>{want.y, tolerance} &&
           got.z == Approx<float>{want.z, tolerance};
}

/// The mean of a sequence and its standard error, by Welford's running update, which avoids cancellation.
class Mean {
  public:
    void add(double value) {
        ++n;
        const double step = value - average;
        average += step / double(n);
        squares += step * (value - average);
    }

    long long count() const { return n; }
    double mean() const { return average; }
    /// Returns the unbiased variance of a single value: sum of (value - mean)^2 / (n - 1).
    double variance() const { return n < 2 ? 0 : squares / double(n - 1); }
    /// Returns the standard error of the mean: sqrt(variance / n).
    double standard_error() const { return n < 2 ? 0 : std::sqrt(variance() / double(n)); }

    /// Returns by how many standard errors the mean exceeds `expected`. A correct renderer exceeds |z| = 4 in
    /// one run out of 16,000, so use CHECK(std::abs(m.z(expected)) < 4). If the values do not vary at all, z
    /// is 0 if the mean is correct up to rounding, else infinity.
    double z(double expected) const {
        const double error = average - expected;
        if (standard_error() > 0) return error / standard_error();
        const double rounding = 1e-6 * std::max(1.0, std::abs(expected));
        return std::abs(error) <= rounding ? 0
                                           : std::copysign(std::numeric_limits<double>::infinity(), error);
    }

    /// Returns the text for INFO(m.against(expected)).
    std::string against(double expected) const {
        return "expected " + to_text(expected) + ", got " + to_text(average) + " +- " +
               to_text(standard_error()) + " over " + std::to_string(n) + ", z = " + to_text(z(expected));
    }

  private:
    long long n = 0;
    double average = 0;
    double squares = 0; ///< sum of (value - mean)^2
};

} // namespace rt

// How doctest prints these types when a check fails.
namespace doctest {

template <>
struct StringMaker<rt::vec2> {
    static String convert(rt::vec2 v) { return rt::to_text(v).c_str(); }
};
template <>
struct StringMaker<rt::vec3> {
    static String convert(rt::vec3 v) { return rt::to_text(v).c_str(); }
};
template <typename Value>
struct StringMaker<std::optional<Value>> {
    static String convert(const std::optional<Value>& value) {
        return value ? toString(*value) : String("nothing");
    }
};
template <typename Value>
struct StringMaker<rt::Approx<Value>> {
    static String convert(const rt::Approx<Value>& approx) {
        return (rt::to_text(approx.want) + " within " + rt::to_text(approx.tolerance)).c_str();
    }
};

} // namespace doctest
