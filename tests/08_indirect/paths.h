// What the checks of paths share: the radiance along a ray, and the strategies of direct lighting.
#pragma once

#include "08_indirect/radiance.h"
#include "08_indirect/scene.h"
#include "tests/08_indirect/step.h"

#include <array>
#include <string>

namespace rt {

/// Estimates the radiance along a ray, red channel.
inline Mean seen(Scene& scene, const PathSettings& settings, const Ray& ray, int samples = 20'000,
                 std::uint64_t seed = 3) {
    build_bvhs(scene);
    const AreaLights lights = collect_area_lights(scene);
    Random random(seed);
    Mean mean;
    for (int i = 0; i < samples; ++i) mean.add(double(radiance(scene, lights, settings, ray, random).x));
    return mean;
}

inline const std::array all_ways{DirectLighting::mis, DirectLighting::light_sampling,
                                 DirectLighting::bsdf_sampling};

inline std::string words(const PathSettings& settings) {
    return "depth " + std::to_string(settings.depth) + (settings.indirect ? "" : ", no indirect light") +
           (settings.direct == DirectLighting::mis              ? ", MIS"
            : settings.direct == DirectLighting::light_sampling ? ", light sampling"
                                                                : ", BSDF sampling") +
           (settings.hemisphere_sampling == HemisphereSampling::cosine ? "" : ", uniform bounces") +
           (settings.roulette ? ", roulette" : ", no roulette");
}

} // namespace rt
