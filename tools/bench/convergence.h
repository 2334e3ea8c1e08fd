// Curves of error against time: where they cross a given error or a given time.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace rt::bench {

/// One measurement; all but the first two are means over several pictures.
struct Convergence {
    int samples = 0;
    double seconds = 0; ///< processor time
    double rmse = 0;    ///< of linear radiance, over all pixels and channels
    /// Mean of (error / (truth + 1/10 of the picture's mean))^2, without the worst 1/1000.
    double relative = 0;
};

struct Series {
    std::string scene, estimator, sampler;
    std::vector<Convergence> points; ///< with more and more samples
};

/// A straight line in the logarithms through (x0, y0) and (x1, y1), at x.
inline double on_log_line(double x, double x0, double y0, double x1, double y1) {
    return y0 * std::pow(y1 / y0, std::log(x / x0) / std::log(x1 / x0));
}

/// Where the curve through `points`, whose x only rises or only falls, reaches x; nothing beyond its ends.
template <typename GetX, typename GetY>
std::optional<double> on_curve(const std::vector<Convergence>& points, double x, GetX get_x, GetY get_y) {
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double x0 = get_x(points[i - 1]), x1 = get_x(points[i]);
        if ((x0 <= x && x <= x1) || (x1 <= x && x <= x0))
            return on_log_line(x, x0, get_y(points[i - 1]), x1, get_y(points[i]));
    }
    return std::nullopt;
}

inline std::optional<double> error_at_time(const Series& series, double seconds) {
    return on_curve(
        series.points, seconds, [](const Convergence& c) { return c.seconds; },
        [](const Convergence& c) { return c.rmse; });
}

inline std::optional<double> time_at_error(const Series& series, double rmse) {
    return on_curve(
        series.points, rmse, [](const Convergence& c) { return c.rmse; },
        [](const Convergence& c) { return c.seconds; });
}

} // namespace rt::bench
