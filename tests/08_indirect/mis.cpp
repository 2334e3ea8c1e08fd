// Facts about the power heuristic.
#include "08_indirect/mis.h"
#include "tests/check.h"

#include <limits>

using namespace rt;

TEST_CASE("the MIS weights of two strategies for the same light add up to one") {
    const float most = std::numeric_limits<float>::max();
    for (const float p : {1e-30f, 1e-6f, 0.3f, 1.0f, 7.0f, 1e9f, most})
        for (const float q : {1e-30f, 1e-6f, 0.2f, 1.0f, 50.0f, 1e9f, most}) {
            INFO("densities " << p << " and " << q << ": " << power_heuristic(p, q) << " and "
                              << power_heuristic(q, p));
            REQUIRE(power_heuristic(p, q) + power_heuristic(q, p) == approx(1, 1e-6f));
        }
    CHECK_MESSAGE(power_heuristic(3, 0) == 1, "a single strategy must get the full weight");
    CHECK_MESSAGE(power_heuristic(3, 1) == approx(0.9f),
                  "3^2 / (3^2 + 1^2); 3/4: this is the balance heuristic");
    CHECK(power_heuristic(1e-3f, most) == 0);
}
