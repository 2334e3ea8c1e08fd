// Alpha cut-outs: leaves, fences, feathers; a mask says where the triangles have holes.
#pragma once

#include "05_mesh_bvh/shapes.h"
#include "06_textures/texture.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace rt {

/// Shapes, some of whose materials have holes.
struct CutOutShapes : Shapes {
    std::vector<Texture> masks; ///< opacity in [0, 1], the same in all three channels
    std::vector<int> mask_of; ///< per material: index into `masks`, or -1; may be shorter than the materials
};

/// Makes a texture of a mask. Opacity is a fraction, not a colour: no sRGB decoding.
inline Texture make_mask(const Mask& mask) {
    Texture texture{mask.width, mask.height, {}};
    for (const std::uint16_t opacity : mask.opacity) texture.texels.emplace_back(float(opacity) / 65535);
    return texture;
}

/// Sets the mask of a material.
inline void cut_out(CutOutShapes& shapes, int material, int mask) {
    if (shapes.mask_of.size() <= std::size_t(material)) shapes.mask_of.resize(std::size_t(material) + 1, -1);
    shapes.mask_of[std::size_t(material)] = mask;
}

/// Returns whether the mask is below one half at the hit. Bilinear lookups give a smooth outline.
inline bool is_hole(const CutOutShapes& shapes, const Hit& hit) {
    const auto material = std::size_t(hit.material);
    const int mask = material < shapes.mask_of.size() ? shapes.mask_of[material] : -1;
    return mask >= 0 && bilinear(shapes.masks[std::size_t(mask)], hit.uv).x < 0.5f;
}

/// Returns the closest hit that is not in a hole. From a hole the ray continues.
inline std::optional<Hit> intersect(const CutOutShapes& shapes, Ray ray) {
    const Shapes& all = shapes;
    auto hit = intersect(all, ray);
    while (hit && is_hole(shapes, *hit)) {
        ray.t_min = hit->t;
        hit = intersect(all, ray);
    }
    return hit;
}

/// Returns whether anything but a hole is hit in the ray's interval.
inline bool occluded(const CutOutShapes& shapes, const Ray& ray) {
    const Shapes& all = shapes;
    return shapes.mask_of.empty() ? occluded(all, ray) : intersect(shapes, ray).has_value();
}

} // namespace rt
