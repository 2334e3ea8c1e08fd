// Facts about pixels: where their samples lie, how a filter weighs them, and what an average of light is.
// Noisy facts are z-tests with a fixed seed: a right renderer is beyond |z| = 4 in one run of 16,000.
#include "07_antialias/filter.h"
#include "07_antialias/sampler.h"
#include "common/image.h"
#include "common/render.h"
#include "tests/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace rt;

namespace {

Picture picture(int width, int height, int samples, std::uint64_t seed = 7) {
    Picture wanted;
    wanted.width = width;
    wanted.height = height;
    wanted.samples = samples;
    wanted.seed = seed;
    return wanted;
}

/// A world that is a function of the place in the picture alone, seen as step 07 sees its scene.
Film photograph(const Picture& wanted, SamplerKind kind, Filter filter, float width,
                const std::function<vec3(vec2)>& world) {
    return render(wanted, [&](const Sample& sample) {
        Sampler sampler(kind, sample);
        return world(picture_point(sample, sampler, filter, width));
    });
}

/// The first point that sample `index` of `count` of a pixel asks for.
vec2 first_point(SamplerKind kind, int index, int count, int pixel, std::uint64_t seed) {
    return Sampler(kind, Sample{pixel, 0, index, count, Random(pixel, 0, index, seed), seed}).uniform2();
}

/// White where p lies on the inner side of the line through `through`, else black.
std::function<vec3(vec2)> edge(vec2 through, vec2 outward) {
    return [=](vec2 p) { return dot(p - through, outward) < 0 ? vec3(1) : vec3(0); };
}

/// What a program writes into an 8-bit picture.
int byte_of(float linear) {
    return int(std::lround(255 * srgb_from_linear(linear)));
}

const std::array kinds{SamplerKind::random, SamplerKind::stratified, SamplerKind::sobol};
const std::array filters{Filter::box, Filter::tent, Filter::gaussian};

std::string name(SamplerKind kind) {
    return std::array{"random", "stratified", "Sobol"}[std::size_t(kind)];
}
std::string name(Filter filter) {
    return filter == Filter::box ? "box" : filter == Filter::tent ? "tent" : "gaussian";
}

/// The rectangle that many points of one sample span.
struct Cell {
    vec2 low{2}, high{-2};
    float area() const { return (high.x - low.x) * (high.y - low.y); }
    bool meets(const Cell& other) const {
        return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
    }
};

std::vector<Cell> cells_of(int count) {
    std::vector<Cell> cells(static_cast<std::size_t>(count));
    Random random(static_cast<std::uint64_t>(count));
    for (int i = 0; i < count; ++i) {
        Cell& cell = cells[std::size_t(i)];
        for (int repeat = 0; repeat < 300; ++repeat) {
            const vec2 p = stratified_point(i, count, random);
            cell.low = min(cell.low, p);
            cell.high = max(cell.high, p);
        }
    }
    return cells;
}

} // namespace

// ---- where the samples lie

TEST_CASE("each of 1 to 100 stratified samples has a cell of its own, and all cells have the same area") {
    for (int count = 1; count <= 100; ++count) {
        const std::vector<Cell> cells = cells_of(count);
        float smallest = 2, largest = 0;
        int overlaps = 0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            smallest = std::min(smallest, cells[i].area() * float(count));
            largest = std::max(largest, cells[i].area() * float(count));
            for (std::size_t j = 0; j < i; ++j) overlaps += cells[i].meets(cells[j]);
        }
        INFO("of " << count << " samples, in units of 1 / " << count << ", the smallest cell has area "
                   << smallest << " and the largest " << largest);
        INFO(
            "all areas equal "
            << count
            << ": these are plain random samples, not stratified ones; area 0: no "
               "jitter within the cell; other areas: the cells of this count do not share the square evenly");
        CHECK(overlaps == 0);
        CHECK(smallest > 0.9f); // 300 points span 1 - 4/301 of a cell on average
        CHECK(largest < 1.001f);
    }
}

TEST_CASE("stratified cells are about as wide as high") {
    for (const int count : {4, 7, 16, 37, 64, 97}) {
        for (const Cell& cell : cells_of(count)) {
            const float shape = (cell.high.x - cell.low.x) / (cell.high.y - cell.low.y);
            INFO("of " << count << " samples one has a cell with width : height = " << shape
                       << ": long thin cells tell an edge in one direction from nothing");
            CHECK(shape > 1 / 2.6f);
            CHECK(shape < 2.6f);
        }
    }
}

TEST_CASE("no stratified point reaches 1, however many samples a pixel has") {
    // In the last column the float sum of a column's number and the jitter rounds up to the next whole number
    // with a chance of one in 32,768 here, and of one in four million at 64 samples.
    const int count = 1 << 20;
    Random random(5);
    int outside = 0;
    for (int repeat = 0; repeat < 400'000; ++repeat) {
        const vec2 p = stratified_point(count - 1, count, random);
        outside += !(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
    }
    CHECK_MESSAGE(outside == 0,
                  "a coordinate of 1 gives box_muller() the logarithm of 0, an infinite offset and a "
                  "ray that is not a number");
}

TEST_CASE("the points of every sampler are spread evenly over the square") {
    // Pearson's chi-square of 8 x 8 bins, 63 degrees of freedom: above 120.6 once in 50,000.
    for (const SamplerKind kind : kinds) {
        std::array<double, 64> bins{};
        const int count = 15, repeats = 4000;
        for (int repeat = 0; repeat < repeats; ++repeat)
            for (int i = 0; i < count; ++i) {
                const vec2 p = first_point(kind, i, count, repeat, 11);
                const int column = std::min(int(p.x * 8), 7), row = std::min(int(p.y * 8), 7);
                bins[std::size_t(row * 8 + column)] += 1;
            }
        const double expected = double(count * repeats) / 64;
        double chi_square = 0;
        for (const double found : bins) chi_square += (found - expected) * (found - expected) / expected;
        INFO(name(kind) << ": beyond the limit some part of the pixel is sampled more often than another");
        CHECK(chi_square < 120.6);
    }
}

TEST_CASE("x and y of a sample know nothing of each other") {
    for (const SamplerKind kind : kinds)
        for (const Filter filter : filters) {
            Mean xy, squares;
            const double variance = filter == Filter::box    ? 1.0 / 12
                                    : filter == Filter::tent ? 1.0 / 6
                                                             : 0.25;
            for (int i = 0; i < 40'000; ++i) {
                const vec2 p = filter_offset(filter, first_point(kind, i % 16, 16, i / 16, 13), 1);
                xy.add(double(p.x * p.y));
                squares.add((double(p.x * p.x) - variance) * (double(p.y * p.y) - variance));
            }
            INFO(name(kind) << ", " << name(filter)
                            << ": the mean of x y is to be 0; as large as the mean of x^2, "
                               "all samples lie on a diagonal (Box-Muller with the cosine twice)");
            INFO(xy.against(0));
            CHECK(std::abs(xy.z(0)) < 4);
            INFO("x^2 and y^2 are to be uncorrelated too: " << squares.against(0));
            CHECK(std::abs(squares.z(0)) < 4);
        }
}

TEST_CASE("every sample of every pixel has its own place") {
    const auto first = [](SamplerKind kind, int x, int y, int index, std::uint64_t seed) {
        return Sampler(kind, Sample{x, y, index, 16, Random(x, y, index, seed), seed}).uniform2();
    };
    for (const SamplerKind kind : kinds) {
        INFO(name(kind) << ": equal places mean one seed for all pixels (a fixed dirt over the picture)");
        const vec2 here = first(kind, 0, 0, 0, 1);
        CHECK(here != first(kind, 1, 0, 0, 1));
        CHECK(here != first(kind, 0, 1, 0, 1));
        CHECK(first(kind, 1, 0, 0, 1) != first(kind, 0, 1, 0, 1));
        CHECK(here != first(kind, 0, 0, 0, 2));
        CHECK_MESSAGE(here != first(kind, 0, 0, 1, 1), "the generator starts again at every sample");
    }
}

TEST_CASE("render gives neighbouring pixels and samples different places") {
    std::array<vec2, 6> places{};
    Picture wanted = picture(2, 2, 2);
    wanted.threads = 1;
    render(wanted, [&](const Sample& sample) {
        const vec2 u = Sampler(SamplerKind::random, sample).uniform2();
        const int pixel = sample.y * 2 + sample.x;
        if (pixel < 3) places[std::size_t(pixel * 2 + sample.index)] = u;
        return vec3(0);
    });
    for (std::size_t i = 0; i < places.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            INFO("sample " << i % 2 << " of pixel " << i / 2 << " and sample " << j % 2 << " of pixel "
                           << j / 2);
            CHECK(places[i] != places[j]);
        }
}

// ---- filters

TEST_CASE("the tent has the density 1 - |x|") {
    std::array<double, 20> bins{};
    const int count = 200'000;
    for (int i = 0; i < count; ++i) {
        const float x = tent((float(i) + 0.5f) / float(count));
        REQUIRE(x >= -1);
        REQUIRE(x <= 1);
        bins[std::size_t(std::min(int((x + 1) * 10), 19))] += 1.0 / count;
    }
    for (int bin = 0; bin < 20; ++bin) {
        const float middle = (float(bin) + 0.5f) / 10 - 1;
        const float expected = (1 - std::abs(middle)) / 10;
        INFO("between " << middle - 0.05f << " and " << middle + 0.05f
                        << ": an even .05 is a box two wide, zero beyond .5 is a box one wide");
        CHECK(float(bins[std::size_t(bin)]) == approx(expected, 2e-4f));
    }
}

TEST_CASE("Box-Muller makes two independent standard normal numbers") {
    std::array<Mean, 2> mean, square, fourth, beyond;
    Mean product, product_of_squares, quadrant;
    Random random(17);
    for (int i = 0; i < 100'000; ++i) {
        const vec2 p = box_muller(random.uniform2());
        for (int k = 0; k < 2; ++k) {
            const double x = double(p[k]);
            mean[std::size_t(k)].add(x);
            square[std::size_t(k)].add(x * x);
            fourth[std::size_t(k)].add(x * x * x * x);
            beyond[std::size_t(k)].add(std::abs(x) > 1 ? 1 : 0);
        }
        product.add(double(p.x) * double(p.y));
        product_of_squares.add(double(p.x) * double(p.x) * double(p.y) * double(p.y));
        quadrant.add(p.x > 0 && p.y > 0 ? 1 : 0);
    }
    for (int k = 0; k < 2; ++k) {
        INFO(std::string(k == 0 ? "x" : "y"));
        INFO("mean: " << mean[std::size_t(k)].against(0));
        CHECK(std::abs(mean[std::size_t(k)].z(0)) < 4);
        INFO("variance, 2 without the root of the logarithm's factor halved, 1/2 without the factor 2: "
             << square[std::size_t(k)].against(1));
        CHECK(std::abs(square[std::size_t(k)].z(1)) < 4);
        INFO("fourth moment, 3 for a normal number: " << fourth[std::size_t(k)].against(3));
        CHECK(std::abs(fourth[std::size_t(k)].z(3)) < 4);
        INFO("share beyond one deviation: " << beyond[std::size_t(k)].against(0.3173105));
        CHECK(std::abs(beyond[std::size_t(k)].z(0.3173105)) < 4);
    }
    INFO("mean of x y, 1 if the cosine is taken twice: " << product.against(0));
    CHECK(std::abs(product.z(0)) < 4);
    INFO("mean of x^2 y^2, 3 if both are the same number, less than 1 if the radius does not vary: "
         << product_of_squares.against(1));
    CHECK(std::abs(product_of_squares.z(1)) < 4);
    INFO("share of the first quadrant, 1/2 if the cosine is taken twice, else for half an angle: "
         << quadrant.against(0.25));
    CHECK(std::abs(quadrant.z(0.25)) < 4);
}

TEST_CASE("Box-Muller is finite at the corners of the unit square") {
    const float most = 1 - 0x1p-24f;
    for (const vec2 u : {vec2(0, 0), vec2(0, most), vec2(most, 0), vec2(most, most), vec2(0.3f, 0)}) {
        const vec2 p = box_muller(u);
        INFO("from " << to_text(u) << " came " << to_text(p)
                     << ": the logarithm of 0 is infinite, take 1 - u");
        CHECK(std::isfinite(p.x));
        CHECK(std::isfinite(p.y));
        CHECK(length(p) < 6); // sqrt(-2 ln 2^-24) = 5.77
    }
}

TEST_CASE("a box covers the pixel, a tent reaches to the next middles, a Gaussian deviates by half a pixel") {
    // Means of x^2: 1/12 of a box, 1/6 of a tent, 1/4 of the Gaussian, times the square of the width.
    const std::array variances{1.0 / 12, 1.0 / 6, 1.0 / 4};
    const std::array reach{0.5f, 1.0f, 3.0f};
    for (const float width : {1.0f, 2.5f})
        for (const Filter filter : filters) {
            const double want = variances[std::size_t(filter)] * double(width) * double(width);
            std::array<Mean, 2> mean, square;
            float farthest = 0;
            Random random(19);
            for (int i = 0; i < 40'000; ++i) {
                const vec2 p = filter_offset(filter, random.uniform2(), width);
                for (int k = 0; k < 2; ++k) {
                    mean[std::size_t(k)].add(double(p[k]));
                    square[std::size_t(k)].add(double(p[k]) * double(p[k]));
                    farthest = std::max(farthest, std::abs(p[k]));
                }
            }
            for (std::size_t k = 0; k < 2; ++k) {
                INFO(name(filter) << " of width " << width << ", " << std::string(k == 0 ? "x" : "y"));
                INFO("mean: " << mean[k].against(0));
                CHECK(std::abs(mean[k].z(0)) < 4);
                INFO("mean square, 4 times too large: the filter is twice too wide: "
                     << square[k].against(want));
                CHECK(std::abs(square[k].z(want)) < 4);
            }
            INFO(name(filter) << " of width " << width << " reaches " << farthest);
            CHECK(farthest <= reach[std::size_t(filter)] * width);
            CHECK(farthest > 0.95f * reach[std::size_t(std::min(filter, Filter::tent))] * width);
        }
}

TEST_CASE("a filter of width 0 asks the middle of the pixel alone") {
    for (const Filter filter : filters) {
        Random random(23);
        for (int i = 0; i < 100; ++i) CHECK(filter_offset(filter, random.uniform2(), 0) == approx(vec2(0)));
    }
}

TEST_CASE("the Gaussian weighs an edge the same from every side") {
    // An edge at distance d from the middle of the pixel leaves Phi(d / sigma) of it white: sigma = 1/2, d =
    // .4.
    const double want = 0.5 * (1 + std::erf(0.4 / 0.5 / std::sqrt(2.0)));
    for (const float degrees : {0.0f, 30.0f, 45.0f, 90.0f, 135.0f, 200.0f, 315.0f}) {
        const vec2 outward(std::cos(glm::radians(degrees)), std::sin(glm::radians(degrees)));
        Mean white;
        Random random(29);
        for (int i = 0; i < 40'000; ++i)
            white.add(dot(filter_offset(Filter::gaussian, random.uniform2(), 1), outward) < 0.4f ? 1 : 0);
        INFO("edge towards " << degrees << " degrees: " << white.against(want)
                             << "; right along the axes only: x and y are not independent");
        CHECK(std::abs(white.z(want)) < 4);
    }
}

TEST_CASE("a pixel beside an edge sees what its filter reaches across it") {
    // The edge stands .3 to the right of the middle: box .8, tent 1 - .7^2 / 2 = .755, Gaussian Phi(.6) =
    // .7257469.
    const std::array want{0.8, 0.755, 0.7257469};
    for (const SamplerKind kind : kinds)
        for (const Filter filter : filters)
            for (const vec2 axis : {vec2(1, 0), vec2(0, 1), vec2(-1, 0), vec2(0, -1)}) {
                Mean mean;
                for (int i = 0; i < 64 * 400; ++i) {
                    const vec2 p = filter_offset(filter, first_point(kind, i % 64, 64, i / 64, 31), 1);
                    mean.add(dot(p, axis) < 0.3f ? 1 : 0);
                }
                INFO(name(kind) << ", " << name(filter) << ": " << mean.against(want[std::size_t(filter)]));
                CHECK(std::abs(mean.z(want[std::size_t(filter)])) < 4);
            }
}

// ---- averages

TEST_CASE("an edge that covers half a pixel shows 188 of 255") {
    for (const Filter filter : filters)
        for (const vec2 outward : {vec2(1, 0), vec2(0, -1)}) {
            const Film film =
                photograph(picture(3, 3, 256), SamplerKind::stratified, filter, 1, edge(vec2(1.5f), outward));
            const int shown = byte_of(film.mean(1, 1).x);
            INFO(name(filter) << ": got " << shown
                              << ". 128 is an average after the sRGB curve: average light, then "
                                 "encode; 255 or 0: the samples all lie in one place");
            CHECK(shown == 188);
        }
}

TEST_CASE("light far above 1 is averaged as light") {
    // A lamp of 40 that covers the left tenth of a pixel.
    const Film film = photograph(picture(1, 1, 400), SamplerKind::stratified, Filter::box, 1,
                                 [](vec2 p) { return p.x < 0.1f ? vec3(40, 20, 4) : vec3(0); });
    INFO("a mean of .1 in all channels: clamped to 1 before it was averaged");
    CHECK(film.mean(0, 0) == approx(vec3(4, 2, 0.4f), 1e-4f));
}

TEST_CASE("a constant stays what it is") {
    for (const SamplerKind kind : kinds)
        for (const Filter filter : filters)
            for (const int samples : {1, 2, 3, 7, 16, 61}) {
                const Film film = photograph(picture(3, 2, samples), kind, filter, 1.5f,
                                             [](vec2) { return vec3(4, 0.001f, 0.7f); });
                const vec3 got = film.mean(2, 1);
                INFO(
                    samples
                    << " samples, " << name(kind) << ", " << name(filter) << ": got " << to_text(got)
                    << "; a multiple of it is a sum that was not divided or weights that do not add up to 1, "
                       "0 in green is a sum in 8 bit");
                CHECK(got.x == 4.0f);
                CHECK(got == approx(vec3(4, 0.001f, 0.7f), 1e-7f));
                CHECK(film.variance(2, 1).x == 0);
            }
}

TEST_CASE("the mean of a ramp is its value in the middle of the pixel") {
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
            INFO(
                name(kind) << ", " << name(filter) << ": " << mean.against(want)
                           << "; half a slope too much or too little: samples around the corner of the pixel "
                              "in place of its middle");
            CHECK(std::abs(mean.z(want)) < 4);
        }
}

TEST_CASE("a line too thin for one sample is as bright as its share of the pixel") {
    // A slanted wire .1 wide that crosses the whole picture covers .1 sqrt(1 + .2^2) of every column of
    // pixels.
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

TEST_CASE("16 even samples leave less than half of the variance of an edge that 16 random ones leave") {
    // The line passes through pixels at all angles and distances; p is the share that lies on its inner side.
    std::array<Mean, 3> variance;
    Random shapes(37);
    for (int trial = 0; trial < 60; ++trial) {
        const float angle = 2 * pi * shapes.uniform();
        const vec2 outward(std::cos(angle), std::sin(angle));
        const vec2 through = vec2(0.5f) + (shapes.uniform() - 0.5f) * 0.6f * outward;
        for (const SamplerKind kind : kinds) {
            double share = 0, squares = 0;
            std::array<double, 100> got{};
            for (int pixel = 0; pixel < 100; ++pixel) {
                int inside = 0;
                for (int i = 0; i < 16; ++i)
                    inside += dot(first_point(kind, i, 16, trial * 100 + pixel, 41) - through, outward) < 0;
                got[std::size_t(pixel)] = inside / 16.0;
                share += inside / 1600.0;
            }
            for (const double value : got) squares += (value - share) * (value - share) / 99;
            if (share > 0.05 && share < 0.95)
                variance[std::size_t(kind)].add(squares / (share * (1 - share) / 16));
        }
    }
    const Mean &random = variance[0], &stratified = variance[1], &sobol = variance[2];
    INFO("in units of p (1 - p) / 16, random samples left "
         << random.mean() << ", stratified ones " << stratified.mean() << ", Sobol ones " << sobol.mean());
    CHECK_MESSAGE(stratified.mean() < 0.5, "as much as random ones: the samples are not held in their cells");
    CHECK_MESSAGE(sobol.mean() < 0.5, "as much as random ones: the points are not those of Sobol");
    CHECK_MESSAGE(std::abs(random.z(1)) < 4, "random samples are to be random: " << random.against(1));
}
