// Summarises a difference: in which part of the picture, in which direction, and by how much.
#include "tools/compare/locate.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

namespace rt::compare {
namespace {

/// Sums over all pixels that differ.
struct Sum {
    std::vector<double> columns, rows; ///< how much each column or row contributes
    std::size_t pixels = 0;
    double brighter = 0, darker = 0;  ///< sums of the changes of luminance
    vec3 test{0.0f}, reference{0.0f}; ///< sums; float is precise enough
    Sum(int width, int height) : columns(std::size_t(width)), rows(std::size_t(height)) {}

    void add(int x, int y, vec3 t, vec3 r) {
        columns[std::size_t(x)] += 1;
        rows[std::size_t(y)] += 1;
        ++pixels;
        if (!is_finite(t) || !is_finite(r)) return;
        const double change = double(luminance(t)) - double(luminance(r));
        (change > 0 ? brighter : darker) += std::abs(change);
        test += t;
        reference += r;
    }
};

/// Finds the range of indices that leaves out 5 % of the sum at each end.
void middle_of(const std::vector<double>& amounts, int& begin, int& end) {
    double whole = 0, sum = 0;
    for (const double amount : amounts) whole += amount;
    end = int(amounts.size());
    for (int i = 0; i < int(amounts.size()); ++i) {
        if (sum <= whole * 0.05) begin = i;
        sum += amounts[std::size_t(i)];
        if (sum < whole * 0.95) continue;
        end = i + 1;
        return;
    }
}

std::string percent(double share) {
    std::ostringstream words;
    words.precision(share < 0.1 ? 1 : 0);
    words << std::fixed << 100 * share << " %";
    return words.str();
}

/// Returns which channel is too strong or too weak.
std::string colour_in_words(vec3 test, vec3 reference) {
    const char* const names[] = {"red", "green", "blue"};
    const vec3 d = test - reference;
    int channel = 0;
    for (int i = 1; i < 3; ++i)
        if (std::abs(d[i]) > std::abs(d[channel])) channel = i;
    return std::string("in a different colour (too ") + (d[channel] > 0 ? "much " : "little ") +
           names[channel] + ")";
}

std::string how(const Sum& sum) {
    const double test = double(luminance(sum.test)), reference = double(luminance(sum.reference));
    const vec3 moved = abs(sum.test - sum.reference);
    if (sum.brighter + sum.darker == 0 && moved == vec3(0.0f)) return "not a number";
    const double colour = double(std::max({moved.x, moved.y, moved.z}));
    if (std::max(sum.brighter, sum.darker) < 0.1 * colour) return colour_in_words(sum.test, sum.reference);
    if (std::min(sum.brighter, sum.darker) > 0.3 * std::max(sum.brighter, sum.darker))
        return "too bright in places and too dark in others";
    const std::string words = change_in_words(test, reference); // "brighter by 12 %"
    const std::size_t end = words.find(' ');
    if (words.rfind("brighter", 0) == 0) return "too bright" + words.substr(end);
    if (words.rfind("darker", 0) == 0) return "too dark" + words.substr(end);
    return colour_in_words(sum.test, sum.reference);
}

Location summed_up(const Sum& sum, std::size_t count, const Image& image) {
    Location result;
    if (sum.pixels == 0) return result;
    middle_of(sum.columns, result.box.x0, result.box.x1);
    middle_of(sum.rows, result.box.y0, result.box.y1);
    result.share = double(sum.pixels) / double(count);
    const Region& box = result.box;
    std::ostringstream words;
    words << how(sum) << " " << place_in_words(box, image.width, image.height) << " ("
          << percent(result.share) << " of the picture, most of it at x " << box.x0 << " to " << box.x1 - 1
          << ", y " << box.y0 << " to " << box.y1 - 1 << ")";
    result.words = words.str();
    return result;
}

bool is_marked(vec3 pixel) {
    return !is_finite(pixel) || pixel == vec3(1, 0, 1);
}

} // namespace

std::string place_in_words(const Region& box, int width, int height) {
    // Returns the third that contains the middle of [begin, end): -1, 0 or 1; 2 if the range is too long.
    const auto third = [](int begin, int end, int size) {
        if (end - begin > 0.6 * size) return 2;
        const double middle = 0.5 * (begin + end) / size;
        return middle < 1 / 3.0 ? -1 : middle < 2 / 3.0 ? 0 : 1;
    };
    const int x = third(box.x0, box.x1, width), y = third(box.y0, box.y1, height);
    const std::string side = x < 0 ? "left" : "right";
    if (x == 2 && y == 2) return "all over the picture";
    if (x == 2 || (x == 0 && y != 0 && y != 2))
        return y < 0 ? "at the top" : y > 0 ? "at the bottom" : "across the middle";
    if (y == 2 || y == 0) return x == 0 ? "in the middle" : "on the " + side;
    return std::string("in the ") + (y < 0 ? "upper " : "lower ") + side;
}

Location locate_difference(const Image& test, const Image& reference) {
    check_same_size(test, reference);
    Sum sum(test.width, test.height);
    for (int y = 0; y < test.height; ++y)
        for (int x = 0; x < test.width; ++x)
            if (!agrees(test(x, y), reference(x, y))) sum.add(x, y, test(x, y), reference(x, y));
    return summed_up(sum, test.pixels.size(), test);
}

Location locate_difference(const TileDifference& tiles, const Image& test, const Image& reference) {
    Sum sum(test.width, test.height);
    for (int y = 0; y < test.height; ++y)
        for (int x = 0; x < test.width; ++x) {
            const int tile = y / tile_side * tiles.columns + x / tile_side;
            if (std::abs(tiles.scores[std::size_t(tile)].z) > limits.outlier_z)
                sum.add(x, y, test(x, y), reference(x, y));
        }
    return summed_up(sum, test.pixels.size(), test);
}

NotANumber not_a_number(const Image& test, const Image& reference) {
    NotANumber found;
    for (std::size_t i = 0; i < test.pixels.size(); ++i) {
        if (!is_marked(test.pixels[i]) || is_marked(reference.pixels[i])) continue;
        if (found.pixels++ > 0) continue;
        found.x = int(i % std::size_t(test.width));
        found.y = int(i / std::size_t(test.width));
    }
    return found;
}

} // namespace rt::compare
