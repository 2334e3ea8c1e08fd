// The camera: the rays of a column of pixels from the side, and the picture that the field of view frames.
#include "01_spheres/camera.h"
#include "common/cli/options.h"
#include "site/figures/drawing.h"
#include "site/figures/figures.h"

namespace rt {

void camera(int argc, const char* const* argv) {
    Options options("camera", "Which rays leave the eye?", {});
    const float& fov = options.option("fov", 40.0f, 10.0f, 110.0f,
                                      "field of view, from the lower edge to the upper, degrees");
    const int& columns = options.option("columns", 8, 2, 16, "columns of the picture");
    const int& rows = options.option("rows", 5, 2, 10, "rows of the picture");
    options.parse(argc, argv);

    const Camera camera = make_camera({.from = {0, 0, 0}, .at = {0, 0, -1}, .fov = fov}, columns, rows);
    const float width = camera.half_width.x, height = camera.half_height.y;
    Drawing drawing({1.15f, 0}, 118);
    const vec2 eye(-1.6f, 0);
    for (int row = 0; row < rows; ++row) { // seen from the side: to the right is forward
        const vec3 way = camera_ray(camera, {float(columns) / 2, float(row) + 0.5f}).direction;
        drawing.arrow(eye, eye + 1.9f / -way.z * vec2(-way.z, way.y) * (way.z < -0.6f ? 1.0f : 0.7f), "ray");
    }
    drawing.line(eye + vec2(1, -height), eye + vec2(1, height), "ink thick");
    drawing.line(eye, eye + vec2(1, 0), "soft");
    drawing.dot(eye, "ink");
    drawing.text(eye + vec2(-0.05f, -0.2f), "eye", "end");
    drawing.text(eye + vec2(1, -height - 0.2f), "distance 1", "middle");

    const vec2 middle(2.7f, 0); // the picture from the front, as wide and high as it is at distance 1
    const float shrink = glm::min(1.0f, 1.3f / glm::max(width, height));
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const vec2 low(-1 + 2 * float(column) / float(columns), -1 + 2 * float(row) / float(rows));
            const vec2 cell(2 / float(columns), 2 / float(rows)), size = shrink * vec2(width, height);
            drawing.rectangle(middle + size * low, middle + size * (low + cell), "ink faint");
        }
    drawing.say("At distance 1 the picture is " + number(2 * width) + " wide and " + number(2 * height) +
                " high: 2 tan(fov/2) high, and " + std::to_string(columns) + "/" + std::to_string(rows) +
                " times as wide, so its pixels are squares.");
    show(drawing);
}

} // namespace rt
