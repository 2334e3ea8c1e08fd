// Twelve small shapes and four large ones, and a split between them: what the surface area heuristic says that it costs.
#include "05_mesh_bvh/aabb.h"
#include "common/cli/options.h"
#include "site/figures/drawing.h"
#include "site/figures/figures.h"

#include <array>

namespace rt {
namespace {

/// The shapes from left to right, as boxes of unit depth.
std::array<Aabb, 16> shapes() {
    std::array<Aabb, 16> boxes;
    for (int i = 0; i < 12; ++i) {
        const vec3 low(-3.4f + 0.3f * float(i % 4), -1 + 0.7f * float(i / 4), 0);
        boxes[std::size_t(i)] = {low, low + vec3(0.18f, 0.4f, 1)};
    }
    for (int i = 0; i < 4; ++i) {
        const vec3 low(-0.6f + 1.05f * float(i), -1.1f + 0.2f * float(i % 2), 0);
        boxes[std::size_t(12 + i)] = {low, low + vec3(0.85f, 1.9f, 1)};
    }
    return boxes;
}

struct Side {
    Aabb box;
    int count = 0;
};

} // namespace

void split(int argc, const char* const* argv) {
    Options options("split", "Where should a box be divided?", {});
    const float& plane =
        options.option("plane", 0.3f, -3.3f, 3.2f, "where the split is, metres to the right");
    options.parse(argc, argv);

    Drawing drawing({0, 0.1f}, 100);
    Side left, right;
    Aabb whole;
    for (const Aabb& box : shapes()) {
        Side& side = centroid(box).x < plane ? left : right;
        extend(side.box, box);
        extend(whole, box);
        ++side.count;
        drawing.rectangle({box.min.x, box.min.y}, {box.max.x, box.max.y}, &side == &left ? "shape" : "dense");
    }
    float cost = 0;
    for (const Side* side : {&left, &right}) {
        if (side->count == 0) continue;
        const vec2 low(side->box.min.x - 0.06f, side->box.min.y - 0.06f),
            high(side->box.max.x + 0.06f, side->box.max.y + 0.06f);
        drawing.rectangle(low, high, side == &left ? "ray" : "good");
        const float chance = half_area(side->box) / half_area(whole);
        drawing.text({(low.x + high.x) / 2, high.y + 0.12f},
                     number(chance) + " × " + std::to_string(side->count), "middle");
        cost += chance * float(side->count);
    }
    drawing.line({plane, -1.5f}, {plane, 1.6f}, "soft");
    drawing.say("A ray that meets the whole box meets a part with the chance written above it, and then "
                "tests its shapes: " +
                number(cost) + " tests; without a split, 16.");
    show(drawing);
}

} // namespace rt
