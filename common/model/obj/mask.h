// Cut-outs: masks for surfaces with holes.
#pragma once

#include "common/image/image_file.h"

namespace rt {

/// Returns the alpha channel of an image or, if it has none, its grey value as stored (opacity is not light,
/// so no transfer curve is applied). If there is no hole, the mask is empty: 0 x 0.
Mask mask_of(const Bitmap& bitmap);

/// Replaces the colours of texels below half opacity by the mean colour of the visible texels around
/// them. Such a colour is hidden, and often black, but filtering would blend it into the neighbours.
/// The image wraps around.
void fill_hidden_colours(Bitmap& bitmap);

} // namespace rt
