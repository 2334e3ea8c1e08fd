// Facts about pixels: the average of light that they show for edges, lines, lamps and slopes.
// Statistical checks are z-tests with fixed seeds; a correct renderer exceeds |z| =
// 4 in one run out of 16,000.
#include "07_antialias/filter.h"
#include "07_antialias/sampler.h"
#include "common/image/image.h"
#include "common/render/render.h"
#include "tests/07_antialias/step.h"
#include "tests/07_antialias/filters.h"
#include "tests/check.h"

#include <array>
#include <cmath>
#include <functional>

using namespace rt;

namespace {

/// Renders a world that is a function of the point on the film, in the same way as step 07 renders its scene.
Film photograph(const RenderSettings& wanted, SamplerKind kind, Filter filter, float width,
                const std::function<vec3(vec2)>& world) {
    return render(wanted, [&](const PixelSample& sample) {
        Sampler sampler(kind, sample);
        return world(film_point(sample, sampler, filter, width));
    });
}

/// Returns a function that is white on the inner side of the line through `through`, and black elsewhere.
std::function<vec3(vec2)> edge(vec2 through, vec2 outward) {
    return [=](vec2 p) { return dot(p - through, outward) < 0 ? vec3(1) : vec3(0); };
}

/// Returns the code that a program writes into an 8-bit image.
int byte_of(float linear) {
    return int(std::lround(255 * srgb_from_linear(linear)));
}

} // namespace

TEST_CASE("x and y of a sample are independent") {
    for (const SamplerKind kind : kinds)
        for (const Filter filter : filters) {
            Mean xy, squares;
            const double variance = filter == Filter::box    ? 1.0 / 12
                                    : filter == Filter::tent ? 1.0 / 6
                                                             : 0.25;
            for (int i = 0; i < 40'000; ++i) {
                const vec2 p = sample_filter(filter, first_point(kind, i % 16, 16, i / 16, 13), 1);
                xy.add(double(p.x * p.y));
                squares.add((double(p.x * p.x) - variance) * (double(p.y * p.y) - variance));
            }
            INFO(name(kind) << ", " << name(filter)
                            << ": the mean of x y must be 0; if it equals the mean of x^2, all samples are "
                               "on a diagonal (Box-Muller with the cosine twice)");
            INFO(xy.against(0));
            CHECK(std::abs(xy.z(0)) < 4);
            INFO("x^2 and y^2 must be uncorrelated too: " << squares.against(0));
            CHECK(std::abs(squares.z(0)) < 4);
        }
}

TEST_CASE("a pixel beside an edge sees as much of it as its filter reaches across") {
    // The edge is .3 to the right of the centre: box .8, tent 1 - .7^2 / 2 = .755,
    // Gaussian Phi(.6) = .7257469.
    const std::array want{0.8, 0.755, 0.7257469};
    for (const SamplerKind kind : kinds)
        for (const Filter filter : filters)
            for (const vec2 axis : {vec2(1, 0), vec2(0, 1), vec2(-1, 0), vec2(0, -1)}) {
                Mean mean;
                for (int i = 0; i < 64 * 400; ++i) {
                    const vec2 p = sample_filter(filter, first_point(kind, i % 64, 64, i / 64, 31), 1);
                    mean.add(dot(p, axis) < 0.3f ? 1 : 0);
                }
                INFO(name(kind) << ", " << name(filter) << ": " << mean.against(want[std::size_t(filter)]));
                CHECK(std::abs(mean.z(want[std::size_t(filter)])) < 4);
            }
}

TEST_CASE("an edge that covers half a pixel shows 188 of 255") {
    for (const Filter filter : filters)
        for (const vec2 outward : {vec2(1, 0), vec2(0, -1)}) {
            const Film film =
                photograph(picture(3, 3, 256), SamplerKind::stratified, filter, 1, edge(vec2(1.5f), outward));
            const int shown = byte_of(film.mean(1, 1).x);
            INFO(name(filter) << ": got " << shown
                              << ". 128: averaged after the sRGB curve, but average light and then encode; "
                                 "255 or 0: all samples are at one point");
            CHECK(shown == 188);
        }
}

TEST_CASE("light far above 1 is averaged as light") {
    // A lamp of radiance 40 that covers the left tenth of a pixel.
    const Film film = photograph(picture(1, 1, 400), SamplerKind::stratified, Filter::box, 1,
                                 [](vec2 p) { return p.x < 0.1f ? vec3(40, 20, 4) : vec3(0); });
    INFO("a mean of .1 in all channels: clamped to 1 before averaging");
    CHECK(film.mean(0, 0) == approx(vec3(4, 2, 0.4f), 1e-4f));
}

TEST_CASE("a constant stays constant") {
    for (const SamplerKind kind : kinds)
        for (const Filter filter : filters)
            for (const int samples : {1, 2, 3, 7, 16, 61}) {
                const Film film = photograph(picture(3, 2, samples), kind, filter, 1.5f,
                                             [](vec2) { return vec3(4, 0.001f, 0.7f); });
                const vec3 got = film.mean(2, 1);
                INFO(samples << " samples, " << name(kind) << ", " << name(filter) << ": got " << to_text(got)
                             << "; a multiple: the sum was not divided, or the weights do not add up to 1; 0 "
                                "in green: the sum is in 8 bits");
                CHECK(got.x == 4.0f);
                CHECK(got == approx(vec3(4, 0.001f, 0.7f), 1e-7f));
                CHECK(film.variance(2, 1).x == 0);
            }
}

TEST_CASE("the mean of a ramp is its value at the centre of the pixel") {
    // f = 3 x - 2 y + 5, pixel (2, 1) of 4 x 3.
    const double want = 3 * 2.5 - 2 * 1.5 + 5;
    for (const SamplerKind kind : kinds)
        for (const Filter filter : filters) {
            Mean mean;
            for (std::uint64_t seed = 0; seed < 300; ++seed) {
                const Film film = photograph(picture(4, 3, 25, seed), kind, filter, 1.2f,
                                             [](vec2 p) { return vec3(3 * p.x - 2 * p.y + 5); });
                mean.add(double(film.mean(2, 1).x));
            }
            INFO(name(kind)
                 << ", " << name(filter) << ": " << mean.against(want)
                 << "; off by half a slope: samples around the corner of the pixel instead of its centre");
            CHECK(std::abs(mean.z(want)) < 4);
        }
}

TEST_CASE("a line thinner than a pixel is as bright as its share of the pixel") {
    // An oblique wire of width .1 across the whole picture covers .1 sqrt(1 + .2^2)
    // of every column of pixels.
    const Film film = photograph(picture(20, 12, 100), SamplerKind::stratified, Filter::box, 1, [](vec2 p) {
        return std::abs(p.y - 5 - 0.2f * (p.x - 8)) < 0.05f * std::sqrt(1.04f) ? vec3(1) : vec3(0);
    });
    Mean column;
    for (int x = 0; x < 20; ++x) {
        double sum = 0;
        for (int y = 0; y < 12; ++y) sum += double(film.mean(x, y).x);
        column.add(sum);
    }
    INFO(column.against(0.1 * std::sqrt(1.04)));
    CHECK(std::abs(column.z(0.1 * std::sqrt(1.04))) < 4);
}
