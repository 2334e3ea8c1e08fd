// An equirectangular map of an invented planet.
// u runs eastward, v from the south to the north pole. The colour is evaluated on the sphere in space, so
// there is no seam at the date line and no pinching at the poles.
#pragma once

#include "assets/noise.h"
#include "assets/picture.h"

#include <array>
#include <numbers>

namespace rt::assets {

/// A colour at a value; stops are in ascending order, and colours between two stops are blended.
struct Stop {
    double value;
    Colour colour;
};

template <std::size_t count>
Colour ramp(const std::array<Stop, count>& stops, double value) {
    Colour colour = stops[0].colour;
    for (std::size_t i = 1; i < count; ++i) {
        const double share = (value - stops[i - 1].value) / (stops[i].value - stops[i - 1].value);
        colour = mix(colour, stops[i].colour, std::clamp(share, 0.0, 1.0));
    }
    return colour;
}

/// Returns a point on the unit sphere. The north pole is at +y; seen from above it,
/// longitude grows counter-clockwise, eastward.
inline dvec3 on_sphere(double longitude, double latitude) {
    return {std::cos(latitude) * std::cos(longitude), std::sin(latitude),
            -std::cos(latitude) * std::sin(longitude)};
}

/// Returns the height of the terrain; land is above 0. The position is shifted by noise before the noise is
/// read, which gives coasts bays and capes.
inline double terrain(dvec3 place) {
    const dvec3 shift(noise(2.5 * place + 10.0), noise(2.5 * place + 20.0), noise(2.5 * place + 30.0));
    return fractal_noise(1.7 * place + 0.35 * shift + dvec3(4.2, 1.3, 7.7), 7) - 0.07;
}

/// Returns the colour of land: wet at the equator, dry at the horse latitudes (about 28 degrees), wet again
/// beyond. Noise blurs the belts.
inline Colour land_colour(dvec3 place, double height, double latitude) {
    constexpr std::array<Stop, 4> dampness{
        {{-0.5, hex(0xe5c98a)}, {-0.1, hex(0xc9bd6d)}, {0.15, hex(0x7fa650)}, {0.5, hex(0x3c7a3f)}}};
    const double degrees = std::abs(latitude) * 180 / std::numbers::pi;
    const double belt = 0.35 * std::cos(degrees * std::numbers::pi / 28);
    Colour colour = ramp(dampness, belt + 0.9 * fractal_noise(3.0 * place + 50.0, 4));
    colour = mix(colour, hex(0x9a9b7a), glm::smoothstep(48.0, 64.0, degrees + 12 * noise(5.0 * place)));
    colour = mix(colour, hex(0x8a7357), glm::smoothstep(0.16, 0.30, height));
    return mix(colour, hex(0xf5f3ee), glm::smoothstep(0.36, 0.44, height));
}

inline Colour globe_colour(double longitude, double latitude) {
    constexpr std::array<Stop, 4> water{
        {{-0.4, hex(0x12396b)}, {-0.15, hex(0x1f5c96)}, {-0.03, hex(0x3a8fb7)}, {0, hex(0x86cfd0)}}};
    const dvec3 place = on_sphere(longitude, latitude);
    const double height = terrain(place);
    Colour colour = ramp(water, height);
    if (height > 0) {
        const double rise_to_west = height - terrain(on_sphere(longitude - 0.012, latitude + 0.012));
        const double sun = std::clamp(1 + 3.5 * rise_to_west, 0.75, 1.2); // low sun in the north-west
        colour = sun * land_colour(place, height, latitude);
    }
    const double cold =
        std::abs(latitude) * 180 / std::numbers::pi + 14 * fractal_noise(4.0 * place + 70.0, 4);
    return mix(colour, hex(0xf4f8fb), glm::smoothstep(71.0, 74.0, cold));
}

/// Returns 1 on the lines of a 30 degree grid, 0 elsewhere; lines are about a texel wide.
inline double graticule(double u, double v, dvec2 size) {
    const auto line = [](double share, int parts, double texels) {
        const double nearest = std::abs(share * parts - std::round(share * parts)) / parts;
        return std::clamp(1.2 - nearest * texels, 0.0, 1.0);
    };
    return std::max(line(u, 12, size.x), line(v, 6, size.y));
}

inline Picture globe() {
    Picture picture(1024, 512, Colour(0));
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const double u = (x + 0.5) / picture.width;
            const double v = 1 - (y + 0.5) / picture.height;
            const Colour colour =
                globe_colour(2 * std::numbers::pi * (u - 0.5), std::numbers::pi * (v - 0.5));
            picture(x, y) = mix(colour, Colour(255), 0.16 * graticule(u, v, {picture.width, picture.height}));
        }
    return picture;
}

} // namespace rt::assets
