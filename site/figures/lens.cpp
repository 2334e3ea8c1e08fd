// A thin lens from the side: rays of one pixel from all over the lens, the plane of focus, the disk of a point elsewhere.
#include "07_antialias/thin_lens.h"
#include "common/cli/options.h"
#include "site/figures/drawing.h"
#include "site/figures/figures.h"

#include <cmath>

namespace rt {

void lens(int argc, const char* const* argv) {
    Options options("lens", "What does a lens see sharp?", {});
    const float& aperture = options.option("aperture", 0.8f, 0.0f, 1.6f, "width of the lens, metres");
    const float& focus = options.option("focus", 3.5f, 1.0f, 6.0f, "distance of the plane in focus, metres");
    const float& subject = options.option("distance", 5.0f, 0.5f, 6.5f, "distance of another plane, metres");
    options.parse(argc, argv);

    const Camera camera = make_camera({.from = {0, 0, 0}, .at = {0, 0, -1}, .fov = 40}, 100, 100);
    const ThinLens lens{aperture, focus};
    const auto flat = [](vec3 point) { return vec2(-point.z, point.y); }; // to the right is forward
    Drawing drawing({3.2f, 0.2f}, 100);
    for (int i = 0; i <= 8; ++i) { // from the bottom of the lens to its top
        const Ray ray = thin_lens_ray(camera, lens, {50, 40}, {0.5f, 0.02f + 0.12f * float(i)});
        drawing.line(flat(ray.origin), flat(ray.origin + ray.direction * (6.9f / -ray.direction.z)),
                     "ray faint");
    }
    const auto plane = [&](float distance, const std::string& style, const std::string& name) {
        drawing.line({distance, -1.3f}, {distance, 1.75f}, style);
        drawing.text({distance, 1.82f}, name, "middle");
    };
    plane(focus, "good thick", "in focus");
    plane(subject, "soft", "another plane");
    const float blur = aperture * std::abs(subject - focus) / focus,
                height = 0.2f * 2 * std::tan(glm::radians(20.0f)) / 2;
    drawing.line({subject, height * subject - blur / 2}, {subject, height * subject + blur / 2},
                 "normal thick");
    drawing.line({0, -aperture / 2}, {0, aperture / 2}, "ink thick");
    drawing.text({0, -aperture / 2 - 0.2f}, "lens", "middle");
    drawing.say("On the other plane the pixel gathers light from a disk of " + number(blur) +
                " m; a point there spreads over a disk of " +
                number(aperture * std::abs(subject - focus) / subject) + " m in the plane of focus.");
    show(drawing);
}

} // namespace rt
