// A drawing as SVG, and how the page gets it.
#include "site/figures/drawing.h"

#include "common/image/image.h"
#include "site/twins/page.h"

#include <array>
#include <cmath>
#include <cstdio>

extern "C" RT_PAGE_HAS(drawn) void page_drawn(const char* svg, std::size_t size, const char* words,
                                              std::size_t length);

namespace rt {
namespace {

std::string pair(const char* x, const char* y, vec2 point) {
    return std::string(x) + "\"" + number(point.x) + "\" " + y + "\"" + number(point.y) + "\" ";
}

std::string styled(const std::string& style) {
    return "class=\"" + style + "\"/>";
}

} // namespace

std::string number(float value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2f", double(value));
    return text.data();
}

vec2 Drawing::on_page(vec2 point) const {
    const vec2 half(float(drawing_width) / 2, float(drawing_height) / 2);
    return half + pixels * vec2(point.x - middle.x, middle.y - point.y);
}

void Drawing::line(vec2 from, vec2 to, const std::string& style) {
    svg += "<line " + pair("x1=", "y1=", on_page(from)) + pair("x2=", "y2=", on_page(to)) + styled(style);
}

void Drawing::arrow(vec2 from, vec2 to, const std::string& style) {
    line(from, to, style);
    const vec2 along = normalize(to - from) * (9 / pixels), across(-along.y / 2, along.x / 2);
    curve({to - along + across, to, to - along - across}, style);
}

void Drawing::curve(const std::vector<vec2>& points, const std::string& style) {
    svg += "<polyline points=\"";
    for (const vec2 point : points) svg += number(on_page(point).x) + "," + number(on_page(point).y) + " ";
    svg += "\" " + styled(style);
}

void Drawing::circle(vec2 center, float radius, const std::string& style) {
    svg += "<circle " + pair("cx=", "cy=", on_page(center)) + "r=\"" + number(radius * pixels) + "\" " +
           styled(style);
}

void Drawing::dot(vec2 center, const std::string& style) {
    circle(center, 5 / pixels, style);
}

void Drawing::rectangle(vec2 low, vec2 high, const std::string& style) {
    const vec2 size = pixels * (high - low);
    svg += "<rect " + pair("x=", "y=", on_page(vec2(low.x, high.y))) + pair("width=", "height=", size) +
           styled(style);
}

void Drawing::square(vec2 low, vec2 high, vec3 colour) {
    std::array<char, 64> fill{};
    const auto percent = [](float linear) { return 100 * double(srgb_from_linear(linear)); };
    std::snprintf(fill.data(), fill.size(), "\" style=\"fill:rgb(%.1f%% %.1f%% %.1f%%)", percent(colour.r),
                  percent(colour.g), percent(colour.b));
    rectangle(low, high, std::string("colour") + fill.data());
}

void Drawing::text(vec2 at, const std::string& words_here, const std::string& anchor) {
    svg +=
        "<text " + pair("x=", "y=", on_page(at)) + "text-anchor=\"" + anchor + "\">" + words_here + "</text>";
}

void Drawing::say(const std::string& more) {
    words += more + "\n";
}

void show(const Drawing& drawing) {
    page_drawn(drawing.svg.data(), drawing.svg.size(), drawing.words.data(), drawing.words.size());
}

} // namespace rt
