// Facts about curves of error over time, from which the benchmark computes its ratios.
#include "tools/bench/convergence.h"
#include "tests/check.h"

using namespace rt;
using namespace rt::bench;

TEST_CASE("between its points a curve of error over time is a power function") {
    // error = 3 seconds^-1/2, at 1, 4 and 16 seconds.
    const Series series{"", "", "", {{1, 1, 3, 0}, {4, 4, 1.5, 0}, {16, 16, 0.75, 0}}};
    for (const double seconds : {1.0, 2.0, 4.0, 9.0, 16.0}) {
        INFO("after " << seconds << " s");
        const double error = 3 / std::sqrt(seconds);
        REQUIRE(error_at_time(series, seconds).has_value());
        CHECK(float(*error_at_time(series, seconds)) == approx(float(error)));
        REQUIRE(time_at_error(series, error * (1 - 1e-12)).has_value() == (seconds < 16));
        if (seconds < 16) CHECK(float(*time_at_error(series, error * (1 - 1e-12))) == approx(float(seconds)));
    }
    CHECK_MESSAGE(!error_at_time(series, 0.9), "nothing is known before the first point");
    CHECK_MESSAGE(!error_at_time(series, 17), "nothing is known after the last point");
    CHECK(!time_at_error(series, 3.1));
    CHECK(!time_at_error(series, 0.7));
}
