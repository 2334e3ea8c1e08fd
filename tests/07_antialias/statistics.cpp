// Facts about the noise of an average: how fast it decreases, and how a render estimates it.
// These are z-tests with fixed seeds; a correct renderer exceeds |z| = 4 in one run out of 16,000.
#include "07_antialias/filter.h"
#include "07_antialias/sampler.h"
#include "common/render/render.h"
#include "tests/07_antialias/step.h"
#include "tests/check.h"

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

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

/// The same oblique edge in every pixel: the white part is a triangle with legs .4 and .8, so p = .16. Only
/// valid for the box filter, which stays within the pixel.
constexpr double p_white = 0.16;
vec3 oblique_edge(vec2 place) {
    const vec2 p = fract(place);
    return 2 * p.x + p.y < 0.8f ? vec3(1) : vec3(0);
}

} // namespace

TEST_CASE("four times the samples halve the error") {
    // The mean of n samples of 0 or 1 has the variance p (1 - p) / n.
    for (const int samples : {4, 16, 64, 256}) {
        const Film film =
            photograph(picture(60, 60, samples), SamplerKind::random, Filter::box, 1, oblique_edge);
        Mean squared_error;
        for (const vec3 pixel : film.mean.pixels) {
            const double error = double(pixel.x) - p_white;
            squared_error.add(error * error);
        }
        const double want = p_white * (1 - p_white) / samples;
        INFO(samples << " samples, squared error: " << squared_error.against(want));
        INFO("the same for all counts: the generator restarts at every sample; far larger for many samples: "
             "neighbours share their random numbers");
        CHECK(std::abs(squared_error.z(want)) < 4);
    }
}

TEST_CASE("even samples do better than halving because an edge crosses few cells") {
    // The edge crosses about 2 sqrt(n) of n cells, so the variance is proportional to n^-3/2: 4 times the
    // samples reduce it by 8.
    for (const SamplerKind kind : {SamplerKind::stratified, SamplerKind::sobol}) {
        double before = 0;
        for (const int samples : {16, 64, 256}) {
            const Film film = photograph(picture(60, 60, samples), kind, Filter::box, 1, oblique_edge);
            Mean error, squared_error;
            for (const vec3 pixel : film.mean.pixels) {
                error.add(double(pixel.x) - p_white);
                squared_error.add((double(pixel.x) - p_white) * (double(pixel.x) - p_white));
            }
            INFO("sampler " << int(kind) << ", " << samples << " samples, mean error: " << error.against(0));
            CHECK(std::abs(error.z(0)) < 4);
            INFO("squared error " << squared_error.mean() << ", random samples would have "
                                  << p_white * (1 - p_white) / samples);
            CHECK(squared_error.mean() < 0.5 * p_white * (1 - p_white) / samples);
            if (before > 0) CHECK(squared_error.mean() < before / 5);
            before = squared_error.mean();
        }
    }
}

TEST_CASE("a disc covers pi R^2 pixels in total whatever the filter") {
    const float radius = 6.3f;
    const vec2 middle(12.2f, 10.7f);
    const double area = double(pi) * 6.3 * 6.3;
    for (const SamplerKind kind : {SamplerKind::random, SamplerKind::stratified, SamplerKind::sobol})
        for (const Filter filter : {Filter::box, Filter::tent, Filter::gaussian}) {
            Mean sum;
            for (std::uint64_t seed = 1; seed <= 40; ++seed) {
                const Film film = photograph(picture(25, 22, 36, seed), kind, filter, 1, [&](vec2 p) {
                    return distance(p, middle) < radius ? vec3(1) : vec3(0);
                });
                double covered = 0;
                for (const vec3 pixel : film.mean.pixels) covered += double(pixel.x);
                sum.add(covered);
            }
            INFO("filter " << int(filter) << ", sampler " << int(kind) << ": " << sum.against(area)
                           << "; off by a constant factor: the weights of the filter do not add up to 1");
            CHECK(std::abs(sum.z(area)) < 4);
        }
}

TEST_CASE("the estimated variance is the variance of the picture over seeds") {
    // Each of 3,600 equal pixels has its own random numbers, which is equivalent to 3,600 seeds.
    const Film film = photograph(picture(60, 60, 12), SamplerKind::random, Filter::box, 1, oblique_edge);
    Mean value, predicted;
    for (std::size_t i = 0; i < film.mean.pixels.size(); ++i) {
        value.add(double(film.mean.pixels[i].x));
        predicted.add(double(film.variance.pixels[i].x));
    }
    Mean spread;
    for (const vec3 pixel : film.mean.pixels) {
        const double error = double(pixel.x) - value.mean();
        spread.add(error * error * 3600.0 / 3599.0);
    }
    const double z =
        (predicted.mean() - spread.mean()) / std::hypot(predicted.standard_error(), spread.standard_error());
    INFO("predicted " << predicted.mean() << ", found " << spread.mean() << ", z = " << z
                      << "; 12 times too large: the variance of a sample instead of their mean; 11/12 of the "
                         "correct value: divided by n instead of n - 1");
    CHECK(std::abs(z) < 4);
    INFO("compared to p (1 - p) / 12: " << predicted.against(p_white * (1 - p_white) / 12));
    CHECK(std::abs(predicted.z(p_white * (1 - p_white) / 12)) < 4);
}

TEST_CASE("for even samples the estimated variance is conservative") {
    // The estimate treats the samples as independent.
    for (const SamplerKind kind : {SamplerKind::stratified, SamplerKind::sobol}) {
        const Film film = photograph(picture(60, 60, 16), kind, Filter::box, 1, oblique_edge);
        Mean error_squared, predicted;
        for (std::size_t i = 0; i < film.mean.pixels.size(); ++i) {
            const double error = double(film.mean.pixels[i].x) - p_white;
            error_squared.add(error * error);
            predicted.add(double(film.variance.pixels[i].x));
        }
        INFO("sampler " << int(kind) << " predicted " << predicted.mean() << ", found "
                        << error_squared.mean());
        CHECK(predicted.mean() > error_squared.mean());
    }
}
