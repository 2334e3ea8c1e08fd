// What counts as the same picture: every limit of the comparison, each with the measurement behind it
// (docs/comparing.md has the tables).
#pragma once

namespace rt {

struct Limits {
    // Pictures of the same samples (steps 01 to 06): rounding and other compilers may differ, physics may
    // not.
    float tolerance = 1e-3f;     ///< a channel agrees within tolerance * max(1, value)
    double least_within = 0.999; ///< share of pixels whose channels all agree
    double largest_mean = 2e-4;  ///< of the absolute difference over all channels

    // Pictures of different samples (07, 08), tile by tile. Of tiles that differ by noise alone one in 16,000
    // lies beyond 4 and one in 150,000 beyond 4.5; a wrong picture lights whole regions.
    double alarm_z = 4;
    double never_z = 4.5;
    double most_alarms = 0.001; ///< share of the tiles, but one tile may always alarm

    // Noisy pictures that are not the same, but nearly. 20 seeds and more on the real scenes stayed below z = 3
    // with no alarm at all, so this is no longer noise: a person should look.
    double look_z = 6;      ///< the largest |z|,
    double look_alarms = 3; ///< and this many times the alarms that are allowed

    // Explanations.
    double named_gain = 0.01;  ///< how near, relatively, a gain must be to pi to be called pi
    double least_gain = 0.002; ///< relative; a smaller gain is no explanation
    // Half a pixel shifted back leaves .09 to .19 of the difference in the scenes of 01 to 06, of a whole pixel
    // .51, of anything else 1.
    double shift_residue = 0.3;
    double shift_alarms = 0.2; ///< for noisy pictures: share of the alarms that may be left

    // The nearest known wrong picture.
    double known_flip_mean = 0.002; ///< FLIP to the known picture: mean
    double known_flip_max = 0.10;   ///< and largest
    double known_nearer = 0.5;      ///< the known picture is at most this share of the way to the reference
    double known_tie = 1.1;         ///< known pictures within this factor of the nearest are named too
};
inline constexpr Limits limits{};

/// The mean FLIP up to which pictures that are not the same are worth a look. Right renders of other compilers
/// measure 0; the smallest real mistakes .001 to .023, so nothing here is a pass. 04 allows a shortcut (Schlick).
constexpr double look_flip(int step) {
    return step == 4 ? 0.015 : 0.01;
}

} // namespace rt
