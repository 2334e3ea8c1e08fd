// Finds the known wrong picture that matches a picture, or none: a wrong guess would mislead.
#pragma once

#include "tools/compare/explain.h"

#include <string>
#include <vector>

namespace rt::compare {

struct CatalogueImage {
    std::string name;
    EncodedImage picture;
    Image variance; ///< empty: assumed to be that of the picture to identify
};

struct CatalogueMatch {
    std::vector<std::string> names; ///< empty: no match; several: they match about equally well
    double distance = 0;            ///< mean FLIP; for noisy pictures the root mean square of z

    explicit operator bool() const { return !names.empty(); }
};

/// Returns the known pictures that match the test, if they are clearly closer than the reference. Throws
/// Error, which names the picture, if one differs in size.
CatalogueMatch find_in_catalogue(const EncodedImage& test, const EncodedImage& reference,
                                 const Variances& variances, const std::vector<CatalogueImage>& catalogue);

/// Reads all NAME.hdr and NAME.png in a folder, sorted by name; the .hdr if both exist, with its
/// NAME.variance.hdr. Throws Error if the folder does not exist, contains no picture, or a picture
/// cannot be read.
std::vector<CatalogueImage> read_catalogue_images(const std::string& folder);

} // namespace rt::compare
