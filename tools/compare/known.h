// Which known wrong picture is this? The nearest of a list, or none: a guess helps nobody.
#pragma once

#include "tools/compare/explain.h"

#include <string>
#include <vector>

namespace rt {

struct KnownPicture {
    std::string name;
    StoredImage picture;
    Image variance; ///< empty: as noisy as the picture that is asked about
};

struct Nearest {
    std::vector<std::string> names; ///< empty: none; several: they cannot be told apart
    double distance = 0;            ///< mean FLIP; for noisy pictures the root of the mean square of z

    explicit operator bool() const { return !names.empty(); }
};

/// The known pictures with which the test agrees, if they are clearly nearer than the reference. Throws Error
/// with the name of a picture of another size.
Nearest nearest_known(const StoredImage& test, const StoredImage& reference, const Variances& variances,
                      const std::vector<KnownPicture>& known);

/// All NAME.hdr and NAME.png of a folder, by name; the .hdr where there are both, and NAME.variance.hdr with
/// it. Throws Error if there is no such folder, no picture in it, or one that cannot be read.
std::vector<KnownPicture> read_known(const std::string& folder);

} // namespace rt
