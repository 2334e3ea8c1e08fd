// Compares a picture with its reference: the verdict, where and how they differ, and why.
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
    borderline, ///< not the same, but so near that a person should look at the map
    different
};
const char* name_of(Verdict verdict); ///< "same", "noise", "look", "different"

bool is_same(Verdict verdict); ///< up to noise at least

struct Comparison {
    Verdict verdict = Verdict::different;
    std::vector<std::string> lines; ///< what to tell a person, the verdict first
    std::string explanation;        ///< as explain() says it
    FlipMap flip;    ///< of what two files of different kinds can tell: the rounding of a PNG is none
    double rmse = 0; ///< of linear light
    std::optional<TileDifference> tiles; ///< where variances were given
    Location location;
    CatalogueMatch match;
};

struct ComparisonInput {
    EncodedImage test, reference;
    Variances variances{};                   ///< if they are given, only what noise does not explain counts
    std::vector<CatalogueImage> catalogue{}; ///< wrong pictures that the test may be
    int step = 0;                            ///< of which step the pictures are, 0: of none
};

/// Throws Error if the pictures, or a known one, differ in size or number of channels.
Comparison compare_images(const ComparisonInput& input);

/// {"verdict", "explanation", "flip": {"mean", "max"}, "rmse", "tiles_over_4", "where", "nearest", "words"},
/// one line. tiles_over_4 is null where there are no variances, rmse where a pixel is not a number.
std::string to_json(const Comparison& comparison);

/// FLIP from black (no difference) to pale yellow (1); for noisy pictures the tiles' z, red where the test is
/// too bright and blue where it is too dark. In linear light.
Image error_map(const Comparison& comparison);

} // namespace rt::compare
