// A point light over a surface: what distance and angle leave of its light.
#include "02_shadows/point_light.h"
#include "common/cli/options.h"
#include "site/figures/drawing.h"
#include "site/figures/figures.h"

#include <cmath>

namespace rt {

void lamp(int argc, const char* const* argv) {
    Options options("lamp", "How much light of a lamp arrives?", {});
    const float& height = options.option("lamp-height", 1.5f, 0.2f, 3.0f, "height of the lamp, metres");
    const float& across =
        options.option("across", -1.0f, -3.5f, 3.5f, "where the lamp is, metres to the right");
    const float& watts = options.option("intensity", 5.0f, 1.0f, 20.0f, "intensity of the lamp, W/sr");
    options.parse(argc, argv);

    const PointLight light{{across, height, 0}, vec3(watts)};
    const vec3 point(0), normal(0, 1, 0);
    Drawing drawing({0, 1.5f}, 95);
    std::vector<vec2> arriving;
    for (float x = -4; x <= 4; x += 0.05f)
        arriving.push_back({x, irradiance(light, {x, 0, 0}, normal).x / 5});
    drawing.line({-4, 0}, {4, 0}, "ink");
    drawing.curve(arriving, "good thick");
    drawing.line({across, height}, {0, 0}, "ray");
    drawing.line({across, height}, {across, 0}, "soft");
    drawing.arrow({0, 0}, {0, 1}, "normal");
    drawing.dot({across, height}, "light");
    drawing.text({across + 0.15f, height + 0.1f}, "lamp");
    drawing.dot({0, 0}, "ink");
    drawing.text({0.1f, 0.95f}, "n");

    const vec3 to_light = light.position - point;
    const float distance = length(to_light), cosine = dot(to_light, normal) / distance;
    drawing.say("distance " + number(distance) + " m, cosine " + number(cosine) +
                ": E = I cos θ / r² = " + number(irradiance(light, point, normal).x) + " W/m² at the dot");
    drawing.say("The green curve is the irradiance along the floor, 1 m for 5 W/m².");
    show(drawing);
}

} // namespace rt
