// The samples of a pixel that an edge crosses: where they are, and how the error of their mean falls with their number.
#include "07_antialias/sampler.h"
#include "common/cli/options.h"
#include "site/figures/drawing.h"
#include "site/figures/figures.h"

#include <array>
#include <cmath>

namespace rt {
namespace {

struct Edge {
    vec2 normal;
    vec2 point = {0.42f, 0.55f};
    bool covers(vec2 place) const { return dot(place - point, normal) > 0; }
};

vec2 sample_point(SamplerKind kind, int index, int count, int pixel) {
    const PixelSample sample{pixel, 0, index, count, Random(pixel, 0, index, 1), 1};
    return Sampler(kind, sample).get_2d();
}

float coverage(const Edge& edge, SamplerKind kind, int count, int pixel) {
    int covered = 0;
    for (int i = 0; i < count; ++i) covered += edge.covers(sample_point(kind, i, count, pixel));
    return float(covered) / float(count);
}

/// The part of the pixel that the edge really covers, by a fine grid.
float true_coverage(const Edge& edge) {
    constexpr int cells = 256;
    int covered = 0;
    for (int i = 0; i < cells * cells; ++i)
        covered += edge.covers((vec2(i % cells, i / cells) + 0.5f) / float(cells));
    return float(covered) / float(cells * cells);
}

/// The typical error of the mean, over many pixels.
float error(const Edge& edge, SamplerKind kind, int count, float truth) {
    constexpr int pixels = 48;
    float squares = 0;
    for (int pixel = 0; pixel < pixels; ++pixel) {
        const float difference = coverage(edge, kind, count, pixel) - truth;
        squares += difference * difference;
    }
    return std::sqrt(squares / pixels);
}

} // namespace

void samples(int argc, const char* const* argv) {
    Options options("samples", "How even are the samples of a pixel?", {});
    const auto kind = options.choice("sampler", {"random", "stratified", "sobol"}, SamplerKind::sobol,
                                     "how the samples are spread");
    const int& root = options.option("root", 4, 1, 16, "samples along a side: 4 stands for 16");
    const float& angle = options.option("angle", 25.0f, 0.0f, 90.0f, "slope of the edge, degrees");
    options.parse(argc, argv);

    const float slope = glm::radians(angle);
    const Edge edge{{-std::sin(slope), std::cos(slope)}};
    const int count = root * root;
    Drawing drawing({0, 0}, 95);
    const vec2 pixel(-3.4f, -1.5f), graph(0.4f, -1.5f);
    drawing.rectangle(pixel, pixel + 3.0f, "ink");
    std::vector<vec2> border;
    for (float t = -1; t <= 1; t += 0.01f) {
        const vec2 place = edge.point + t * vec2(edge.normal.y, -edge.normal.x);
        if (place == clamp(place, 0.0f, 1.0f)) border.push_back(pixel + 3.0f * place);
    }
    drawing.curve(border, "soft");
    for (int i = 0; i < count; ++i) {
        const vec2 point = sample_point(kind, i, count, 0);
        drawing.circle(pixel + 3.0f * point, 0.04f, edge.covers(point) ? "ray" : "good");
    }
    drawing.line(graph, graph + vec2(3, 0), "ink");
    drawing.line(graph, graph + vec2(0, 3), "ink");
    const float truth = true_coverage(edge);
    for (const SamplerKind each : {SamplerKind::random, SamplerKind::stratified, SamplerKind::sobol}) {
        std::vector<vec2> points; // both axes are logarithmic: from 1 to 256 samples, from .5 down to .001
        for (int n = 1; n <= 16; n *= 2)
            points.push_back(graph + vec2(3 * std::log2(float(n)) / 4,
                                          3 + std::log2(2 * error(edge, each, n * n, truth) + 1e-4f) / 3));
        drawing.curve(points, each == kind ? "ray thick" : "soft");
    }
    drawing.text(graph + vec2(0, -0.25f), "1 sample");
    drawing.text(graph + vec2(3, -0.25f), "256", "end");
    drawing.text(graph + vec2(3, 2.85f), "typical error", "end");
    drawing.say(std::to_string(count) + " samples say that " + number(100 * coverage(edge, kind, count, 0)) +
                " % of the pixel is covered; it is " + number(100 * truth) + " %.");
    drawing.say("The thick curve is this sampler's error over many pixels; dashed are the two others. Each "
                "step to the right is four times as many samples.");
    show(drawing);
}

} // namespace rt
