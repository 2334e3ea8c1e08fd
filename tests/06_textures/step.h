// What the checks of step 06 share: small textures.
#pragma once

#include "06_textures/texture.h"

#include <cstdint>
#include <vector>

namespace rt {

/// Returns an sRGB code from 0 to 255 as a Bitmap stores it.
inline std::uint16_t code(int value) {
    return std::uint16_t(value * 257);
}

/// Builds a texture from linear colours, row by row from the top.
inline Texture texture_of(int width, int height, const std::vector<vec3>& texels) {
    return {width, height, texels};
}

/// 3 x 2 texels, all different and without symmetry:
///     red   green  blue
///     grey  cyan   orange
inline const vec3 red{0.9f, 0.1f, 0.05f}, green{0.1f, 0.8f, 0.2f}, blue{0.05f, 0.1f, 0.7f};
inline const vec3 grey{0.3f, 0.3f, 0.3f}, cyan{0.1f, 0.6f, 0.65f}, orange{0.95f, 0.5f, 0.1f};
inline Texture card() {
    return texture_of(3, 2, {red, green, blue, grey, cyan, orange});
}

} // namespace rt
