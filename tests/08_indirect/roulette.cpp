// Facts about Russian roulette: the mean that it preserves, and which paths it ends.
#include "08_indirect/roulette.h"
#include "tests/08_indirect/step.h"
#include "tests/check.h"

#include <array>

using namespace rt;

TEST_CASE("roulette leaves the mean of a path's throughput unchanged") {
    for (const vec3 carried : {vec3(0.2f, 0.05f, 0.1f), vec3(0.02f), vec3(0.5f, 0.9f, 0.1f),
                               vec3(0.5f, 0, 0.2f), vec3(1), vec3(1.3f)}) {
        std::array<Mean, 3> mean;
        Random random(11);
        for (int i = 0; i < 50'000; ++i) {
            const vec3 left = russian_roulette(carried, random).value_or(vec3(0));
            for (int k = 0; k < 3; ++k) mean[std::size_t(k)].add(double(left[k]));
        }
        for (int k = 0; k < 3; ++k) {
            INFO("channel " << k << ": " << mean[std::size_t(k)].against(double(carried[k]))
                            << "; too low: divide survivors by their probability");
            CHECK(off(mean[std::size_t(k)], double(carried[k])) < 4);
        }
    }
}

TEST_CASE("roulette ends dim paths more often than bright ones, and black ones immediately") {
    Random random(13);
    const auto survivors = [&](vec3 carried) {
        int count = 0;
        for (int i = 0; i < 10'000; ++i) count += russian_roulette(carried, random).has_value();
        return count;
    };
    const int dim = survivors(vec3(0.05f)), middle = survivors(vec3(0.1f, 0.4f, 0.3f)),
              bright = survivors(vec3(0.8f));
    INFO("of 10,000 paths " << dim << " dim, " << middle << " medium and " << bright
                            << " bright ones continued");
    CHECK(dim < middle);
    CHECK(middle < bright);
    CHECK_MESSAGE(dim < 2000, "too few paths end: roulette saves no work");
    CHECK(survivors(vec3(0)) == 0);
}
