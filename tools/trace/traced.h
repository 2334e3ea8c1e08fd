// Included before a step's main.cpp: overloads that print what every ray of one sample hits and returns.
//
// The program is not changed. Its scene is a Counted<Scene>, and functions for that very type are better matches than
// templates. RT_SCENE and RT_RADIANCE are the headers that the program uses, RT_STEP is its number. Run it with one
// thread, on a crop of one pixel; the environment variable RAYSTEPS_TRACE_SAMPLE says which sample to print (default 1).
#pragma once

#include RT_SCENE
#include RT_RADIANCE
#include "01_spheres/program/counted.h"

#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace rt {

using TracedScene = Counted<Scene>;

namespace trace {

inline int depth = 0;   ///< depth of the recursion of radiance()
inline int samples = 0; ///< samples begun so far

inline bool wanted() {
    static const char* const chosen = std::getenv("RAYSTEPS_TRACE_SAMPLE");
    static const int number = chosen ? std::atoi(chosen) : 1;
    return samples == number;
}

/// What a ray met. A program that draws rays sets `draw`; it is called before the lines about the ray are printed.
enum class Met { nothing, surface, occluder, light };
inline void (*draw)(vec3 from, vec3 to, Met met) = nullptr;

inline void draw_ray(vec3 from, vec3 to, Met met) {
    if (draw && wanted()) draw(from, to, met);
}

template <typename... Values>
void say(const char* pattern, Values... values) {
    if (!wanted()) return;
    std::printf("%*s", 2 * depth, "");
    std::printf(pattern, values...);
    std::printf("\n");
}

inline std::string text(vec3 v) {
    char text[80];
    std::snprintf(text, sizeof text, "(%.4g %.4g %.4g)", double(v.x), double(v.y), double(v.z));
    return text;
}

/// Returns "Mirror" for a rt::Mirror: the name of this function, as the compiler writes it, ends
/// with the type.
template <typename Material>
std::string name_of(const Material&) {
    std::string_view own = __PRETTY_FUNCTION__;
    own = own.substr(own.find("Material = ") + 11);
    own = own.substr(0, own.find_first_of(";]"));
    return std::string(own.substr(own.rfind(':') + 1));
}

/// Formats a point in the coordinates of the model's file, whose origin may be far from that of the scene.
inline std::string place([[maybe_unused]] const Scene& scene, vec3 point) {
#if RT_STEP >= 5
    if (const dvec3 origin = scene.mesh.origin; origin != dvec3(0)) {
        const dvec3 p = origin + dvec3(point);
        char text[120];
        std::snprintf(text, sizeof text, "(%.10g %.10g %.10g)", p.x, p.y, p.z);
        return text;
    }
#endif
    return text(point);
}

inline void say_hit(const Scene& scene, const Ray& ray, const std::optional<Hit>& hit) {
    if (hit)
        draw_ray(ray.origin, hit->position, Met::surface);
    else
        draw_ray(ray.origin, ray.origin + 100.0f * normalize(ray.direction), Met::nothing);
    say("ray from %s, direction %s", place(scene, ray.origin).c_str(), text(ray.direction).c_str());
    if (!hit) return say("  hits %s", "nothing");
    const auto& material = scene.materials[std::size_t(hit->material)];
    const std::string name = std::visit([](const auto& arm) { return name_of(arm); }, material);
    say("  hits material %d, %s %s, at t = %.6g%s", hit->material,
        name.find_first_of("AEIOU") == 0 ? "an" : "a", name.c_str(), double(hit->t),
        hit->back_face ? ", from inside" : "");
    say("  point %s, normal %s, uv (%.4g %.4g)", place(scene, hit->position).c_str(),
        text(hit->shading_normal).c_str(), double(hit->uv.x), double(hit->uv.y));
}

/// Calls radiance(), one level deeper.
template <typename Radiance>
vec3 below(const Radiance& radiance) {
    if (depth == 0) ++samples;
    ++depth;
    const vec3 back = radiance();
    say("returns %s", text(back).c_str());
    --depth;
    return back;
}

} // namespace trace

inline std::optional<Hit> intersect(const TracedScene& scene, const Ray& ray) {
    const std::optional<Hit> hit = intersect<Scene>(scene, ray);
    trace::say_hit(scene, ray, hit);
    return hit;
}

#if RT_STEP >= 2
inline bool occluded(const TracedScene& scene, const Ray& ray) {
    const bool dark = occluded<Scene>(scene, ray);
    trace::draw_ray(ray.origin, at(ray, ray.t_max), dark ? trace::Met::occluder : trace::Met::light);
    trace::say("shadow ray from %s to %s: %s", trace::place(scene, ray.origin).c_str(),
               trace::place(scene, at(ray, ray.t_max)).c_str(), dark ? "occluded" : "unoccluded");
    return dark;
}
#endif

// The recursion in radiance.h calls these: a function that is not a template is preferred.
#if RT_STEP <= 2
inline vec3 radiance(const TracedScene& scene, const Ray& ray) {
    return trace::below([&] { return radiance<TracedScene>(scene, ray); });
}
#elif RT_STEP == 3
inline vec3 radiance(const TracedScene& scene, const Ray& ray, int bounces_left) {
    return trace::below([&] { return radiance<TracedScene>(scene, ray, bounces_left); });
}
#elif RT_STEP <= 7
inline vec3 radiance(const TracedScene& scene, const Ray& ray, int bounces_left, vec3 absorption = vec3(0)) {
    return trace::below([&] { return radiance<TracedScene>(scene, ray, bounces_left, absorption); });
}
#else
template <RandomSource Source>
vec3 radiance(const TracedScene& scene, const AreaLights& lights, const PathSettings& settings,
              const Ray& ray, Source& source) {
    return trace::below([&] { return radiance<TracedScene, Source>(scene, lights, settings, ray, source); });
}
#endif

} // namespace rt
