// Cut-outs: where a picture says that there is no surface.
#pragma once

#include "common/image/image_file.h"

namespace rt {

/// The alpha channel of a picture if it says something, else its grey value as it stands in the file
/// (opacity is no light: no curve is undone). Without a hole, the mask is empty: 0 x 0.
Mask mask_of(const Bitmap& bitmap);

/// The colour of a texel that is less than half opaque is not to be seen, and often black. But filtering
/// blends it into its neighbours: so it takes the mean colour of those around it that can be seen. Pictures
/// repeat.
void fill_hidden_colours(Bitmap& bitmap);

} // namespace rt
