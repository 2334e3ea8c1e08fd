// Multiple importance sampling: weights for light that two sampling strategies can find.
#pragma once

namespace rt {

/// Power heuristic, exponent 2 (Veach and Guibas 1995): the weight  p^2 / (p^2 + q^2)  of a sample drawn with
/// density p > 0 when another strategy would draw it with density q. The weights of both add up to 1.
inline float power_heuristic(float p, float q) {
    //> how much does the strategy of density p count beside that of density q, even where p^2 overflows?
    const float ratio = q / p;
    return 1 / (1 + ratio * ratio);
    //< return 1;
}

} // namespace rt
