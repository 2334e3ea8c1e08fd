// A test card that changes under every flip, rotation or swap of axes, and on which texels can be counted.
#pragma once

#include "assets/letters.h"

#include <functional>

namespace rt::assets {

using FlatDistance = std::function<double(dvec2)>;

/// A drawing surface with y growing downward, as pixels are stored. Borders are smoothed over one pixel.
class Card {
  public:
    explicit Card(Picture& sheet) : picture(sheet) {}

    void fill(Colour colour, const FlatDistance& shape) {
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x)
                picture(x, y) = over(picture(x, y), colour, shape({x + 0.5, y + 0.5}), 0.7);
    }

    /// Fills whole pixels, without smoothing.
    void rectangle(Colour colour, ivec2 low, ivec2 size) {
        for (int y = low.y; y < low.y + size.y; ++y)
            for (int x = low.x; x < low.x + size.x; ++x) picture(x, y) = colour;
    }

    void text(Colour colour, const std::string& words, const TextStyle& style) {
        fill(colour, [&](dvec2 point) { return text_distance(point, words, style); });
    }

    void arrow(Colour colour, dvec2 from, dvec2 to, double pen) {
        const dvec2 along = normalize(to - from), across(-along.y, along.x);
        fill(colour, [&](dvec2 point) {
            const double shaft = segment(point, from, to, pen);
            const double one = segment(point, to, to - 14.0 * along + 10.0 * across, pen);
            const double other = segment(point, to, to - 14.0 * along - 10.0 * across, pen);
            return std::min({shaft, one, other});
        });
    }

  private:
    Picture& picture;
};

inline constexpr int card_width = 768, card_height = 512, card_cell = 64, card_corner = 96;
inline constexpr Colour card_paper = hex(0xf7f0e1), card_ink = hex(0x1d2b45), card_line = hex(0xddd3bd);

/// Draws cells of 64 texels, numbered along u at the top and along v (upward) at the left.
inline void draw_grid(Card& card) {
    for (int x = card_cell; x < card_width; x += card_cell)
        card.rectangle(card_line, {x, 0}, {1, card_height});
    for (int y = card_cell; y < card_height; y += card_cell)
        card.rectangle(card_line, {0, y}, {card_width, 1});
    for (int column = 2; column < 10; ++column)
        card.text(card_ink, std::to_string(column), {{column * card_cell + 27, 40}, 16, 1.3});
    for (int row = 2; row < 6; ++row)
        card.text(card_ink, std::to_string(row), {{27, card_height - row * card_cell - 24}, 16, 1.3});
}

inline void draw_corners(Card& card) {
    const auto corner = [&](Colour colour, ivec2 low, const std::string& name) {
        card.rectangle(colour, low, ivec2(card_corner));
        card.text(card_paper, name, {dvec2(low) + dvec2(22, 64), 32, 3.2});
    };
    const int right = card_width - card_corner, bottom = card_height - card_corner;
    corner(hex(0xd8383a), {0, 0}, "TL");
    corner(hex(0x2e9e5b), {right, 0}, "TR");
    corner(hex(0x2f62c4), {0, bottom}, "BL");
    corner(hex(0xeab127), {right, bottom}, "BR");
}

inline void draw_title(Card& card) {
    card.rectangle(card_ink, {112, 128}, {396, 112});
    card.text(card_paper, "RAYSTEPS", {{131, 210}, 50, 4.6});
}

inline void draw_circle(Card& card) {
    const dvec2 centre(600, 180);
    card.fill(hex(0xe8743b), [&](dvec2 point) { return distance(point, centre) - 72; });
    card.fill(card_paper, [&](dvec2 point) { return std::abs(distance(point, centre) - 56) - 2.5; });
    card.fill(card_paper, [&](dvec2 point) { return segment(point, centre, centre + dvec2(0, -50), 2.5); });
    card.fill(card_paper, [&](dvec2 point) { return segment(point, centre, centre + dvec2(34, 0), 2.5); });
}

/// Draws sixteen equal steps of the sRGB value, dark on the left.
inline void draw_grey_ramp(Card& card) {
    for (int step = 0; step < 16; ++step) card.rectangle(Colour(step * 17), {128 + 32 * step, 280}, {32, 40});
}

/// Draws one-texel lines, vertical and horizontal, and a one-texel checker: they blur
/// first when a lookup is off.
inline void draw_texel_patterns(Card& card) {
    for (int i = 0; i < card_cell; ++i) {
        const Colour colour = i % 2 == 0 ? card_ink : card_paper;
        card.rectangle(colour, {400 + i, 352}, {1, card_cell});
        card.rectangle(colour, {480, 352 + i}, {card_cell, 1});
        for (int j = 0; j < card_cell; ++j)
            card.rectangle((i + j) % 2 == 0 ? card_ink : card_paper, {560 + i, 352 + j}, {1, 1});
    }
}

inline void draw_axes(Card& card) {
    card.arrow(hex(0xd8383a), {144, 464}, {330, 464}, 3);
    card.text(hex(0xd8383a), "U", {{344, 476}, 26, 3});
    card.arrow(hex(0x2e9e5b), {144, 464}, {144, 366}, 3);
    card.text(hex(0x2e9e5b), "V", {{164, 382}, 26, 3});
}

inline Picture test_card() {
    Picture picture(card_width, card_height, card_paper);
    Card card(picture);
    draw_grid(card);
    draw_corners(card);
    draw_title(card);
    draw_circle(card);
    draw_grey_ramp(card);
    draw_texel_patterns(card);
    draw_axes(card);
    return picture;
}

} // namespace rt::assets
