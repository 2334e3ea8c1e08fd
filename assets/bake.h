// Bakes a colour function of space into the texture of an unwrapped mesh.
#pragma once

#include "assets/picture.h"

#include <functional>

namespace rt::assets {

using PaintFunction = std::function<Colour(dvec3 point)>;

/// An image, and which of its texels have been painted.
struct Canvas {
    Picture picture;
    std::vector<bool> painted;

    std::size_t index(int x, int y) const {
        return std::size_t(y) * std::size_t(picture.width) + std::size_t(x);
    }
    bool is_painted(int x, int y) const {
        return x >= 0 && y >= 0 && x < picture.width && y < picture.height && painted[index(x, y)];
    }
};

/// Paints every texel whose centre is in the triangle with the colour of the surface point that it shows.
inline void bake_triangle(Canvas& canvas, const Mesh& mesh, const Triangle& triangle,
                          const PaintFunction& paint) {
    const dvec2 size(canvas.picture.width, canvas.picture.height);
    std::array<dvec2, 3> corner;
    for (int k = 0; k < 3; ++k) {
        const dvec2 uv = mesh.uvs[triangle.uv[k]];
        corner[k] = dvec2(uv.x, 1 - uv.y) * size; // v grows upward, rows grow downward
    }
    const auto area = [](dvec2 a, dvec2 b, dvec2 c) {
        return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    };
    const double whole = area(corner[0], corner[1], corner[2]);
    const ivec2 low(glm::floor(min(min(corner[0], corner[1]), corner[2])));
    const ivec2 high(glm::ceil(max(max(corner[0], corner[1]), corner[2])));
    for (int y = low.y; y < high.y; ++y)
        for (int x = low.x; x < high.x; ++x) {
            const dvec2 centre(x + 0.5, y + 0.5);
            const dvec3 share(area(centre, corner[1], corner[2]) / whole,
                              area(centre, corner[2], corner[0]) / whole,
                              area(centre, corner[0], corner[1]) / whole);
            if (share.x < 0 || share.y < 0 || share.z < 0) continue;
            dvec3 point(0);
            for (int k = 0; k < 3; ++k) point += share[k] * mesh.positions[triangle.vertex[k]];
            canvas.picture(x, y) = paint(point);
            canvas.painted[canvas.index(x, y)] = true;
        }
}

/// Extends the painted area by one texel, so that bilinear lookups at a border never read the ground colour.
inline void dilate(Canvas& canvas) {
    const Canvas before = canvas;
    for (int y = 0; y < canvas.picture.height; ++y)
        for (int x = 0; x < canvas.picture.width; ++x) {
            if (before.is_painted(x, y)) continue;
            Colour sum(0);
            int count = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    if (before.is_painted(x + dx, y + dy)) {
                        sum += before.picture.pixels[before.index(x + dx, y + dy)];
                        ++count;
                    }
            if (count == 0) continue;
            canvas.picture(x, y) = sum / double(count);
            canvas.painted[canvas.index(x, y)] = true;
        }
}

inline Picture bake(const Mesh& mesh, int size, Colour ground, const PaintFunction& paint) {
    Canvas canvas{Picture(size, size, ground),
                  std::vector<bool>(std::size_t(size) * std::size_t(size), false)};
    for (const Triangle& triangle : mesh.triangles) bake_triangle(canvas, mesh, triangle, paint);
    for (int pass = 0; pass < 4; ++pass) dilate(canvas);
    return canvas.picture;
}

} // namespace rt::assets
