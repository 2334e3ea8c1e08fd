// What the checks of paths share: what comes back along a ray, and in which ways lamps are
// looked for.
#pragma once

#include "08_indirect/radiance.h"
#include "08_indirect/scene.h"
#include "tests/08_indirect/step.h"

#include <array>
#include <string>

namespace rt {

/// The red light that comes back along a ray.
inline Mean seen(Scene& scene, const Transport& transport, const Ray& ray, int samples = 20'000,
                 std::uint64_t seed = 3) {
    prepare(scene);
    const AreaLights lights = area_lights(scene);
    Random random(seed);
    Mean mean;
    for (int i = 0; i < samples; ++i) mean.add(double(radiance(scene, lights, transport, ray, random).x));
    return mean;
}

inline const std::array all_ways{Direct::mis, Direct::lights, Direct::bounces};

inline std::string words(const Transport& transport) {
    return "depth " + std::to_string(transport.depth) + (transport.indirect ? "" : ", no indirect light") +
           (transport.direct == Direct::mis      ? ", lights sampled and found"
            : transport.direct == Direct::lights ? ", lights sampled"
                                                 : ", lights found by chance") +
           (transport.spread == Spread::cosine ? "" : ", uniform bounces") +
           (transport.roulette ? ", roulette" : ", no roulette");
}

} // namespace rt
