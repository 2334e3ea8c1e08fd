// Facts about the squares of a checkerboard.
#include "tests/check.h"

#include "01_spheres/checkerboard.h"

#include "tests/01_spheres/step.h"

#include <string>

using namespace rt;

TEST_CASE("the squares of a checkerboard alternate on both sides of zero") {
    const Checkerboard checkerboard{{0.8f, 0, 0}, {0, 0.3f, 0}, 0.5f};
    for (int row = -4; row < 4; ++row)
        for (int column = -4; column < 4; ++column) {
            const bool even = (row + column) % 2 == 0;
            for (const float inset : {0.02f, 0.25f, 0.48f}) {
                const vec2 uv = 0.5f * vec2(column, row) + vec2(inset, 0.5f - inset);
                INFO("square (" << column << ", " << row << ") at uv = " << to_text(uv));
                CHECK_MESSAGE(evaluate(checkerboard, uv).albedo ==
                                  approx(even ? checkerboard.even : checkerboard.odd),
                              "a cast to int merges the two squares beside zero: use floor");
            }
        }
}

TEST_CASE("along a row of squares and along a column the colour changes at each border, and along a diagonal "
          "never") {
    const Checkerboard checkerboard{{1, 1, 1}, {0, 0, 0}, 0.5f};
    const auto colours = [&](vec2 step) { // eight samples, two in each square, from (-1, -1)
        std::string text;
        for (int i = 0; i < 8; ++i)
            text += evaluate(checkerboard, vec2(-0.9f) + float(i) * step).albedo.x > 0 ? 'e' : 'o';
        return text;
    };
    CHECK(colours({0.25f, 0}) == "eeooeeoo");
    CHECK(colours({0, 0.25f}) == "eeooeeoo");
    CHECK(colours({0.25f, 0.25f}) == "eeeeeeee");
}
