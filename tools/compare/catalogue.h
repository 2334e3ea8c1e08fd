// Which known wrong picture is this? The nearest of a list, or none: a guess helps nobody.
#pragma once

#include "tools/compare/explain.h"

#include <string>
#include <vector>

namespace rt::compare {

struct CatalogueImage {
    std::string name;
    EncodedImage picture;
    Image variance; ///< empty: as noisy as the picture that is asked about
};

struct CatalogueMatch {
    std::vector<std::string> names; ///< empty: none; several: they cannot be told apart
    double distance = 0;            ///< mean FLIP; for noisy pictures the root of the mean square of z

    explicit operator bool() const { return !names.empty(); }
};

/// The known pictures with which the test agrees, if they are clearly nearer than the reference. Throws Error
/// with the name of a picture of another size.
CatalogueMatch find_in_catalogue(const EncodedImage& test, const EncodedImage& reference,
                                 const Variances& variances, const std::vector<CatalogueImage>& catalogue);

/// All NAME.hdr and NAME.png of a folder, by name; the .hdr where there are both, and NAME.variance.hdr with
/// it. Throws Error if there is no such folder, no picture in it, or one that cannot be read.
std::vector<CatalogueImage> read_catalogue_images(const std::string& folder);

} // namespace rt::compare
