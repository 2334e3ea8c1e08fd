// All limits of the comparison, each with the measurement behind it (docs/comparing.md has the tables).
#pragma once

namespace rt::compare {

struct Limits {
    // Pictures with the same samples (steps 01 to 06). Built by g++ and clang++, with and without
    // -march=native, the .hdr files of 01 to 05 are bit-identical; in 06 the largest difference is 0.0039 and
    // the mean 4.3e-8. Correct renders with 25 samples per pixel, which are other pictures, have means from
    // 1.4e-4 to 2.1e-3.
    float tolerance = 1e-3f;           ///< a channel agrees if |difference| <= tolerance * max(1, value)
    double min_share_within = 0.999;   ///< minimum share of pixels whose channels all agree
    double max_mean_difference = 2e-4; ///< maximum of the mean absolute difference over all channels

    // Some pixels amplify rounding: in glass, and where a fine pattern ends at the horizon. Rounding favours neither
    // brighter nor darker. Rays by steps of a pixel, as in "Ray Tracing in One Weekend", change 0.2 to 0.9 % of the
    // pixels of 01 to 06 and their sum (mean_change of ./learn compare --json) by at most 7.4e-6; the smallest mistake
    // that shows (an offset of a millimetre in 02) changes 0.3 % and the sum by 4.6e-5.
    double min_share_within_rounding = 0.99;
    double max_mean_change_rounding = 2e-5; ///< maximum relative change of the sum of all pixels

    // Pictures with different samples (07, 08), compared by tiles. If only noise differs, one tile in 16,000
    // has |z| > 4 and one in 150,000 has |z| > 4.5; a wrong picture has whole regions of outliers. Measured:
    // 24 seeds of 07 (96,000 tiles) and 24 of 08 (86,400 tiles) gave no outlier; the largest |z| was 2.93.
    // Stratified samples are less noisy than their estimated variance, so the test is milder than it looks.
    double outlier_z = 4;
    double max_z = 4.5;
    double max_outlier_share = 0.001; ///< maximum share of outliers; one is always allowed

    // Noisy pictures that almost agree. The correct renders above stayed below |z| = 3 without any outlier,
    // so this is unlikely to be noise: a person should look at the map.
    double borderline_z = 6;        ///< maximum |z|, and
    double borderline_outliers = 3; ///< maximum multiple of the allowed outliers

    // Explanations.
    double named_gain = 0.01; ///< maximum relative difference of a gain from pi to be called pi
    double min_gain = 0.002;  ///< a gain closer to 1 than this is not an explanation
    // Undoing a shift of half a pixel leaves 0.06 to 0.24 of the difference in renders of 02 to 06, of 0.31 where
    // edges are steep, a whole pixel 0.5: tests/compare/explain.cpp checks both.
    double max_movement_residue = 0.4;
    double max_movement_outliers = 0.2; ///< for noisy pictures: maximum share of the outliers

    // The closest known wrong picture. These limits were chosen for small scenes and not measured with these.
    double catalogue_flip_mean = 0.002; ///< maximum of the mean FLIP to the known picture
    double catalogue_flip_max = 0.10;   ///< maximum of the largest FLIP
    double catalogue_max_ratio = 0.5;   ///< maximum ratio of the distances to the known picture and reference
    double catalogue_tie = 1.1;         ///< known pictures within this factor of the closest one match, too
};
inline constexpr Limits limits{};

/// Returns the mean FLIP up to which a wrong picture counts as almost the same. Correct renders with other
/// sample positions (25 per pixel) measure 0.0038 to 0.0069; in 04, where Schlick's approximation is allowed,
/// too, 0.0102. The smallest real mistakes measure 0.001, so such a picture does not pass.
constexpr double borderline_flip(int step) {
    return step == 4 ? 0.015 : 0.01;
}

} // namespace rt::compare
