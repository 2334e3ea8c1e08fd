// A point on a small texture: the four texels around it, and the share that each has in its colour.
#include "06_textures/texture.h"
#include "common/cli/options.h"
#include "site/figures/drawing.h"
#include "site/figures/figures.h"

namespace rt {
namespace {

const Texture four_by_four{4,
                           4,
                           {{0.8f, 0.2f, 0.1f},
                            {0.9f, 0.6f, 0.1f},
                            {0.9f, 0.8f, 0.4f},
                            {0.3f, 0.1f, 0.1f},
                            {0.1f, 0.4f, 0.4f},
                            {0.9f, 0.9f, 0.8f},
                            {0.2f, 0.2f, 0.2f},
                            {0.8f, 0.5f, 0.2f},
                            {0.1f, 0.2f, 0.5f},
                            {0.2f, 0.6f, 0.5f},
                            {0.8f, 0.3f, 0.2f},
                            {0.9f, 0.8f, 0.5f},
                            {0.0f, 0.1f, 0.3f},
                            {0.1f, 0.3f, 0.6f},
                            {0.3f, 0.6f, 0.8f},
                            {0.6f, 0.2f, 0.4f}}};
const vec2 corner(-3, -1.6f);
constexpr float side = 0.8f; // metres of a texel in the drawing

} // namespace

void texels(int argc, const char* const* argv) {
    Options options("texels", "Which colour has a point between texels?", {});
    const float& u =
        options.option("u", 0.45f, -0.25f, 1.25f, "to the right; beyond 0 and 1 the image repeats");
    const float& v = options.option("v", 0.55f, 0.0f, 1.0f, "upward");
    options.parse(argc, argv);

    Drawing drawing({0, 0}, 95);
    for (int y = 0; y < 4; ++y)
        for (int x = -1; x <= 4; ++x) {
            const vec2 low = corner + side * vec2(x + 1, y);
            drawing.square(low, low + side, texel(four_by_four, x, y));
            drawing.circle(low + side / 2, 0.03f, "over");
        }
    const vec2 position(u * 4, v * 4), point = corner + side * (position + vec2(1, 0));
    const vec2 nearest = floor(position - 0.5f), weight = position - 0.5f - nearest;
    std::string shares;
    for (const vec2 step : {vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(1, 1)}) {
        const vec2 share = mix(1.0f - weight, weight, step);
        const vec2 center = corner + side * (nearest + step + 0.5f + vec2(1, 0));
        drawing.line(point, center, "over");
        drawing.text(center + vec2(0, 0.1f), number(share.x * share.y), "middle");
        shares += (shares.empty() ? "" : " + ") + number(share.x * share.y);
    }
    drawing.rectangle(point - side / 2, point + side / 2, "over thick");
    drawing.dot(point, "over");
    drawing.square({2.4f, -0.8f}, {3.8f, 0.6f}, bilinear(four_by_four, {u, v}));
    drawing.text({3.1f, 0.75f}, "its colour", "middle");
    drawing.say("The shares are the parts of a texel-sized square around the point: " + shares + " = 1.");
    show(drawing);
}

} // namespace rt
