// A ray and a sphere: the two points where they meet, the foot between them, and the discriminant.
#include "01_spheres/sphere.h"
#include "common/cli/options.h"
#include "site/figures/drawing.h"
#include "site/figures/figures.h"

#include <cmath>

namespace rt {
namespace {

vec2 flat(vec3 point) {
    return {point.x, point.y};
}

/// Marks the hit of step 01's intersect(), if the ray's interval contains one, and returns its t.
std::optional<float> mark(Drawing& drawing, const Sphere& sphere, const Ray& ray, const std::string& name) {
    const auto t = intersect(sphere, ray);
    if (!t) return t;
    const vec3 point = at(ray, *t), normal = normalize(point - sphere.center);
    drawing.arrow(flat(point), flat(point + 0.6f * normal), "normal");
    drawing.dot(flat(point), "good");
    drawing.text(flat(point + 0.75f * normal), name + " t = " + number(*t), normal.x < 0 ? "end" : "start");
    return t;
}

} // namespace

void sphere_roots(int argc, const char* const* argv) {
    Options options("sphere_roots", "Where does a ray meet a sphere?", {});
    const float& height = options.option("ray-height", 0.3f, -1.8f, 1.8f, "how high the ray starts, metres");
    const float& angle = options.option("angle", 3.0f, -30.0f, 30.0f, "slope of the ray, degrees");
    const float& speed =
        options.option("length", 1.0f, 0.25f, 2.0f, "length of D: t counts in multiples of it");
    const float& start =
        options.option("start", -3.2f, -3.2f, 3.0f, "where the ray starts, metres to the right");
    options.parse(argc, argv);

    const Sphere sphere{{0, 0, 0}, 1.2f, 0};
    const float slope = glm::radians(angle);
    const Ray ray{{start, height, 0}, speed * vec3(std::cos(slope), std::sin(slope), 0)};
    const vec3 center = sphere.center - ray.origin;
    const float a = dot(ray.direction, ray.direction), h = dot(ray.direction, center);
    const float discriminant = h * h - a * (dot(center, center) - sphere.radius * sphere.radius);

    Drawing drawing({0, 0}, 95);
    drawing.circle(flat(sphere.center), sphere.radius, "shape");
    drawing.line(flat(ray.origin), flat(at(ray, 8 / speed)), "ray");
    drawing.line(flat(sphere.center), flat(at(ray, h / a)), "soft");
    drawing.arrow(flat(ray.origin), flat(at(ray, 1)), "ray thick");
    drawing.dot(flat(ray.origin), "ray");
    drawing.text(flat(ray.origin) + vec2(0, -0.25f), "O");
    drawing.dot(flat(sphere.center), "ink");
    drawing.text(flat(sphere.center) + vec2(0.08f, -0.25f), "C");

    const auto first = mark(drawing, sphere, ray, "first");
    if (first) mark(drawing, sphere, {ray.origin, ray.direction, *first}, "second");
    drawing.say("h = D·(C - O) = " + number(h) + "    discriminant = h² - a c = " + number(discriminant));
    drawing.say(discriminant < 0 ? "The discriminant is negative: the ray passes the sphere by."
                : !first         ? "Both roots are negative: the sphere is behind the ray."
                         : "intersect() answers the first t that the ray contains: " + number(*first) + ".");
    show(drawing);
}

} // namespace rt
