// Russian roulette: when a path may end, without a change of the mean.
#pragma once

#include "common/math/random.h"
#include "common/math/vec.h"

#include <optional>

namespace rt {

/// Russian roulette: a path that carries little goes on with a probability in proportion, and what goes on is
/// weighed up by 1 / probability, so the mean stays (Arvo and Kirk 1990). Answers the new throughput, or
/// nothing if the path ends.
template <RandomSource Source>
std::optional<vec3> russian_roulette(vec3 throughput, Source& source) {
    //> survive with the largest component, at most .95, and divide by it
    const float largest = glm::max(throughput.x, glm::max(throughput.y, throughput.z));
    const float survival = glm::min(largest, 0.95f);
    if (source.uniform() >= survival) return std::nullopt;
    return throughput / survival;
    //< return throughput;
}

} // namespace rt
