// Plots as SVG files, readable on a light page and on a dark one.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace rt::bench {

/// A curve through measured points. Curves of one `colour` belong together; dashes tell them apart.
struct Curve {
    std::string name;
    std::vector<std::pair<double, double>> points; ///< in order of x; those that are not finite are left out
    int colour = 0;                                ///< 0 to 5
    bool dashed = false;
};

/// Both axes logarithmic, both quantities positive.
struct LogPlot {
    std::string title, x_label, y_label;
    std::vector<Curve> curves;
};

/// Groups of upright bars from 0, with a line at `reference` (0: none).
struct Bars {
    std::string title, y_label;
    std::vector<std::string> groups, series;
    std::vector<std::vector<double>> values; ///< values[group][series]; what is not finite is left out
    double reference = 0;
};

/// Lying bars, each a whole cut into shares that add up to 1.
struct Shares {
    std::string title;
    std::vector<std::string> rows, series;
    std::vector<std::vector<double>> values; ///< values[row][series]
};

std::string svg(const LogPlot& plot);
std::string svg(const Bars& bars);
std::string svg(const Shares& shares);

} // namespace rt::bench
