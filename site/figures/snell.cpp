// Light at a boundary: where it goes, and how much of it. Left the rays, right the reflectance of all angles.
#include "04_refraction/dielectric.h"
#include "common/cli/options.h"
#include "site/figures/drawing.h"
#include "site/figures/figures.h"

#include <algorithm>
#include <cmath>

namespace rt {
namespace {

const vec2 boundary(-1.95f, 0), graph(0.55f, -1.5f);
constexpr float graph_size = 3;

/// A ray whose width is its share of the light.
void share(Drawing& drawing, vec2 from, vec2 to, float part) {
    drawing.arrow(from, to, part > 0.5f ? "ray thick" : part > 0.08f ? "ray" : "ray faint");
}

/// The reflectance against the angle, from 0 to 90 degrees.
void draw_graph(Drawing& drawing, float eta, float degrees, float reflectance) {
    std::vector<vec2> points;
    for (float angle = 0; angle <= 90; angle += 0.5f) {
        const float cosine =
            std::max(std::cos(glm::radians(angle)), 1e-6f); // at 90 degrees rounding makes it negative
        points.push_back(graph + graph_size * vec2(angle / 90, fresnel_dielectric(cosine, eta)));
    }
    drawing.line(graph, graph + vec2(graph_size, 0), "ink");
    drawing.line(graph, graph + vec2(0, graph_size), "ink");
    drawing.curve(points, "good thick");
    drawing.dot(graph + graph_size * vec2(degrees / 90, reflectance), "ray");
    drawing.text(graph + vec2(0, -0.22f), "0°", "middle");
    drawing.text(graph + vec2(graph_size, -0.22f), "90°", "middle");
    drawing.text(graph + vec2(-0.08f, graph_size - 0.05f), "1", "end");
    drawing.text(graph + vec2(0.12f, graph_size - 0.05f), "reflectance");
}

} // namespace

void snell(int argc, const char* const* argv) {
    Options options("snell", "Where does light go at a boundary?", {});
    const float& degrees =
        options.option("angle", 50.0f, 0.0f, 89.0f, "angle of the light to the normal, degrees");
    const float& above = options.option("above", 1.0f, 1.0f, 2.5f, "index of refraction above the boundary");
    const float& below = options.option("below", 1.5f, 1.0f, 2.5f, "index of refraction below the boundary");
    options.parse(argc, argv);

    const float angle = glm::radians(degrees), eta = above / below;
    const vec3 direction(std::sin(angle), -std::cos(angle), 0), normal(0, 1, 0);
    const auto bent = refract(direction, normal, eta);
    const float reflectance = fresnel_dielectric(std::cos(angle), eta);

    Drawing drawing({0, 0}, 95);
    drawing.rectangle(boundary - vec2(1.95f, 1.9f), boundary + vec2(1.95f, 0),
                      below > above ? "dense" : "thin");
    drawing.rectangle(boundary - vec2(1.95f, 0), boundary + vec2(1.95f, 1.9f),
                      above > below ? "dense" : "thin");
    drawing.line(boundary - vec2(0, 1.8f), boundary + vec2(0, 1.8f), "soft");
    const auto along = [](vec3 way) { return boundary + 1.7f * vec2(way.x, way.y); };
    drawing.arrow(along(-direction), boundary, "ray thick");
    share(drawing, boundary, along(reflect(direction, normal)), reflectance);
    if (bent) share(drawing, boundary, along(*bent), 1 - reflectance);
    draw_graph(drawing, eta, degrees, reflectance);

    drawing.say("reflected " + number(100 * reflectance) + " %, " +
                (bent ? "transmitted at " + number(glm::degrees(std::asin(bent->x))) + "°"
                      : std::string("nothing gets through: total internal reflection")));
    const std::string brewster = number(glm::degrees(std::atan(1 / eta)));
    drawing.say(
        eta > 1
            ? "critical angle " + number(glm::degrees(std::asin(1 / eta))) + "°, Brewster's " + brewster + "°"
            : "Brewster's angle " + brewster + "°; there is no critical angle into the denser medium");
    show(drawing);
}

} // namespace rt
