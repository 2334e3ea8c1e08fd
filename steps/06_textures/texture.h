// Image textures: decoded to linear light once, looked up bilinearly.
#pragma once

#include "01_spheres/diffuse.h"
#include "common/image/image_file.h"

#include <cmath>
#include <vector>

namespace rt {

/// Converts an sRGB value in [0, 1] to linear light in [0, 1] (IEC 61966-2-1: a linear toe, then a power of
/// 2.4).
inline float linear_from_srgb(float value) {
    //> how much light, from 0 to 1, does a value from a file stand for?
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
    //< return value;
}

/// Linear RGB, row by row from the top. uv (0, 0) is the lower left corner of the image, (1, 1) the upper
/// right.
struct Texture {
    int width = 0;
    int height = 0;
    std::vector<vec3> texels;
};

/// Decodes a file's values, so that everything after it is in linear light.
inline Texture make_texture(const Bitmap& bitmap) {
    Texture texture{bitmap.width, bitmap.height, std::vector<vec3>(bitmap.values.size() / 3)};
    for (std::size_t i = 0; i < bitmap.values.size(); ++i)
        texture.texels[i / 3][int(i % 3)] = linear_from_srgb(float(bitmap.values[i]) / 65535);
    return texture;
}

/// Returns `index` modulo size, in [0, size), also for negative indices: the image repeats.
inline int wrap(int index, int size) {
    //> which texel is this one, if the row is repeated to both sides without end?
    const int remainder = index % size;
    return remainder < 0 ? remainder + size : remainder;
    //< return glm::clamp(index, 0, size - 1);
}

/// Returns the texel in column x from the left and row y from the BOTTOM of the repeated image.
inline vec3 texel(const Texture& texture, int x, int y) {
    const int column = wrap(x, texture.width);
    const int row = texture.height - 1 - wrap(y, texture.height);
    return texture.texels[std::size_t(row) * std::size_t(texture.width) + std::size_t(column)];
}

/// Returns the texture at uv, interpolated between the four nearest texels. A texel's value is that at its
/// center, half a texel from its corner.
inline vec3 bilinear(const Texture& texture, vec2 uv) {
    //> which four texels surround uv, and how much does each of them count?
    const vec2 texel_position = fract(uv) * vec2(texture.width, texture.height) - 0.5f;
    const vec2 lower_left = floor(texel_position);
    const vec2 weight = texel_position - lower_left;
    const int x = int(lower_left.x), y = int(lower_left.y);
    const vec3 lower = mix(texel(texture, x, y), texel(texture, x + 1, y), weight.x);
    const vec3 upper = mix(texel(texture, x, y + 1), texel(texture, x + 1, y + 1), weight.x);
    return mix(lower, upper, weight.y);
    //< return texel(texture, 0, 0);
}

/// A diffuse surface whose albedo is an image, repeated `uv_scale` times in u and in v.
struct ImageTexture {
    int texture;      ///< index into the scene's textures
    vec3 tint{1};     ///< multiplies the picture
    vec3 emission{0}; ///< as in Diffuse
    vec2 uv_scale{1};
};

inline Diffuse evaluate(const ImageTexture& surface, const std::vector<Texture>& textures, vec2 uv) {
    return {surface.tint * bilinear(textures[std::size_t(surface.texture)], surface.uv_scale * uv),
            surface.emission};
}
template <typename S>
Diffuse matte_at(const ImageTexture& surface, const S& scene, const Hit& hit) {
    return evaluate(surface, scene.textures, hit.uv);
}

} // namespace rt
