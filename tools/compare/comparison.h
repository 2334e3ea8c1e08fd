// Compares a picture with its reference: the verdict, where and how they differ, and the likely cause.
#pragma once

#include "tools/compare/explain.h"
#include "tools/compare/flip.h"
#include "tools/compare/catalogue.h"
#include "tools/compare/locate.h"

#include <optional>
#include <string>
#include <vector>

namespace rt::compare {

enum class Verdict {
    same,       ///< the same picture
    noise,      ///< the same up to noise
    borderline, ///< not the same, but close: a person should look at the map
    different
};
const char* name_of(Verdict verdict); ///< "same", "noise", "look", "different"

bool is_same(Verdict verdict); ///< same, or same up to noise

struct Comparison {
    Verdict verdict = Verdict::different;
    std::vector<std::string> lines;      ///< text for a person; the verdict comes first
    std::string explanation;             ///< as explain() returns it
    FlipMap flip;                        ///< differences within the rounding of a PNG do not count
    double rmse = 0;                     ///< of linear values
    double mean_change = 0;              ///< relative, of the sum of all pixels
    std::optional<TileDifference> tiles; ///< set if variances were given
    Location location;
    std::optional<NotANumber> not_a_number; ///< set if there are such pixels
    CatalogueMatch match;
};

struct ComparisonInput {
    EncodedImage test, reference;
    Variances variances{};                   ///< if given, differences that noise explains do not count
    std::vector<CatalogueImage> catalogue{}; ///< known wrong pictures
    int step = 0;                            ///< the step that the pictures belong to; 0: none
};

/// Compares two pictures. Throws Error if these or a known picture differ in size or number of channels.
Comparison compare_images(const ComparisonInput& input);

/// Returns one line of JSON: {"verdict", "explanation", "flip": {"mean", "max"}, "rmse", "mean_change",
/// "tiles_over_4", "where", "nearest", "words"}. tiles_over_4 is null without variances, rmse is null if a pixel is NaN.
std::string to_json(const Comparison& comparison);

/// Returns an error map in linear RGB: FLIP from black (no difference) to pale yellow (1); for noisy pictures
/// the z of the tiles, red where the test is too bright and blue where it is too dark.
Image error_map(const Comparison& comparison);

} // namespace rt::compare
