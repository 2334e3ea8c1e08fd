// A drawing as SVG, in metres: x to the right, y up. The page gives each style its colour, in light and in dark.
#pragma once

#include "common/math/vec.h"

#include <string>
#include <vector>

namespace rt {

inline constexpr int drawing_width = 760, drawing_height = 380; ///< pixels

class Drawing {
  public:
    /// `center` is the point in the middle of the drawing, `scale` the pixels per metre.
    Drawing(vec2 center, float scale) : middle(center), pixels(scale) {}

    void line(vec2 from, vec2 to, const std::string& style);
    /// A line with a head at its end.
    void arrow(vec2 from, vec2 to, const std::string& style);
    void curve(const std::vector<vec2>& points, const std::string& style);
    /// `radius` in metres.
    void circle(vec2 center, float radius, const std::string& style);
    void dot(vec2 center, const std::string& style);
    void rectangle(vec2 low, vec2 high, const std::string& style);
    /// A filled rectangle in this linear colour.
    void square(vec2 low, vec2 high, vec3 colour);
    /// `anchor`: start, middle or end.
    void text(vec2 at, const std::string& words, const std::string& anchor = "start");
    /// Adds a line to what the drawing says in words below it.
    void say(const std::string& words);

    std::string svg, words;

  private:
    vec2 on_page(vec2 point) const;
    vec2 middle;
    float pixels;
};

/// Returns a number with two digits after the point.
std::string number(float value);

/// Hands a drawing to the page.
void show(const Drawing& drawing);

} // namespace rt
