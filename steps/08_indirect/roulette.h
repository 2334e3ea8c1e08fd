// Russian roulette: ends paths early without changing the expected value.
#pragma once

#include "common/math/random.h"
#include "common/math/vec.h"

#include <optional>

namespace rt {

/// Russian roulette (Arvo and Kirk 1990): continues with a probability and divides by it, so the estimate
/// stays unbiased. Returns the new throughput, or nothing if the path ends.
template <RandomSource Source>
std::optional<vec3> russian_roulette(vec3 throughput, Source& source) {
    //> how likely should a path go on that carries this, and what must it carry then?
    const float largest = glm::max(throughput.x, glm::max(throughput.y, throughput.z));
    const float survival = glm::min(largest, 0.95f);
    if (source.get_1d() >= survival) return std::nullopt;
    return throughput / survival;
    //< return throughput;
}

} // namespace rt
