// Multiple importance sampling: how much counts of a light that two ways of sampling can find.
#pragma once

namespace rt {

/// Two ways find the same light, with densities p and q. The share that counts where the first one finds it:
/// the power heuristic with exponent 2 (Veach and Guibas 1995),  p^2 / (p^2 + q^2).  Both shares add up to 1.
/// p > 0.
inline float power_heuristic(float p, float q) {
    //> by way of q / p, whose square does not overflow where those of p and q do
    const float ratio = q / p;
    return 1 / (1 + ratio * ratio);
    //< return 1;
}

} // namespace rt
