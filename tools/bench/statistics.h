// Medians and geometric means.
#pragma once

#include "tools/bench/table.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace rt::bench {

/// Returns `unknown` if there are no values.
inline double median(std::vector<double> values) {
    if (values.empty()) return unknown;
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

/// The geometric mean of those values that are numbers above 0.
inline double geometric_mean(const std::vector<double>& values) {
    double sum = 0;
    int count = 0;
    for (const double value : values) {
        if (!(value > 0)) continue;
        sum += std::log(value);
        ++count;
    }
    return count > 0 ? std::exp(sum / count) : unknown;
}

} // namespace rt::bench
