// contact_sheet OUT.png A.png B.png ...: draws pictures side by side, with their names below.
#include "assets/letters.h"
#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/version.h"
#include "common/image/image_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

namespace rt {
namespace {

constexpr int columns = 4;
constexpr int cell_width = 480, cell_height = 300;
constexpr int gap = 20;                         // between cells and around them
constexpr int caption = 38;                     // height of the strip below a cell
constexpr double letter = 15;                   // height of a capital letter
const vec3 background(0.0075f, 0.008f, 0.010f); // all colours are linear
const vec3 number_colour(0.95f, 0.50f, 0.12f);
const vec3 name_colour(0.62f, 0.64f, 0.68f);

/// Returns the mean of the picture over the box [x0, x1) x [y0, y1). Pixels at its border are weighted by the
/// part that is inside.
vec3 box_mean(const Image& image, double x0, double y0, double x1, double y1) {
    vec3 sum(0.0f);
    double area = 0;
    for (int y = int(y0); y < image.height && y < y1; ++y)
        for (int x = int(x0); x < image.width && x < x1; ++x) {
            const double part = (std::min(x1, x + 1.0) - std::max(x0, double(x))) *
                                (std::min(y1, y + 1.0) - std::max(y0, double(y)));
            sum += float(part) * image(x, y);
            area += part;
        }
    return area > 0 ? sum / float(area) : sum;
}

/// Draws the picture, scaled to fit and centred, into the cell at (left, top).
void draw_picture(Image& sheet, int left, int top, const Image& image) {
    const double scale = std::max(double(image.width) / cell_width, double(image.height) / cell_height);
    const int width = std::max(1, int(std::lround(image.width / scale)));
    const int height = std::max(1, int(std::lround(image.height / scale)));
    const double dx = double(image.width) / width, dy = double(image.height) / height;
    left += (cell_width - width) / 2;
    top += (cell_height - height) / 2;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            sheet(left + x, top + y) = box_mean(image, x * dx, y * dy, (x + 1) * dx, (y + 1) * dy);
}

/// Returns "03_mirror" for "renders/03_mirror.png".
std::string stem(const std::string& path) {
    const std::size_t begin = path.find_last_of("/\\") + 1; // npos + 1 is 0
    return path.substr(begin, path.rfind('.') - begin);
}

/// Draws the number in its own colour, then the name, cut off at the width of the cell.
void draw_caption(Image& sheet, int left, int top, const std::string& path) {
    const int advance = int(std::lround(letter * 5.6 / 6));
    const std::string name = stem(path).substr(0, std::size_t(cell_width / advance));
    const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
    for (std::size_t i = 0; i < name.size(); ++i, left += advance) {
        const std::string capital(1, char(std::toupper(static_cast<unsigned char>(name[i]))));
        const assets::TextStyle style{{left + 1.5, top + letter + 1}, letter, 1};
        for (int y = top; y < top + int(letter) + 3; ++y)
            for (int x = left; x < left + advance; ++x) {
                const double distance = assets::text_distance({x + 0.5, y + 0.5}, capital, style);
                const float ink = float(glm::smoothstep(0.6, -0.6, distance));
                sheet(x, y) = mix(sheet(x, y), i < digits ? number_colour : name_colour, ink);
            }
    }
}

Image contact_sheet(const std::vector<std::string>& paths) {
    const int across = std::min(columns, int(paths.size()));
    const int down = (int(paths.size()) + columns - 1) / columns;
    Image sheet(gap + across * (cell_width + gap), gap + down * (cell_height + caption));
    std::fill(sheet.pixels.begin(), sheet.pixels.end(), background);
    for (int i = 0; i < int(paths.size()); ++i) {
        const int left = gap + i % columns * (cell_width + gap);
        const int top = gap + i / columns * (cell_height + caption);
        draw_picture(sheet, left, top, read_image(paths[std::size_t(i)]));
        draw_caption(sheet, left, top + cell_height + 8, paths[std::size_t(i)]);
    }
    return sheet;
}

} // namespace
} // namespace rt

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    if (arguments == std::vector<std::string>{"--version"}) {
        std::cout << rt::version() << "\n";
        return 0;
    }
    if (arguments.size() < 2 || arguments[0] == "--help") {
        rt::print_error_line("usage: contact_sheet OUT.png A.png B.png ...");
        return arguments.size() == 1 ? 0 : 2;
    }
    try {
        rt::check_writable(arguments[0]);
        rt::write_image(arguments[0], rt::contact_sheet({arguments.begin() + 1, arguments.end()}));
        std::cout << "wrote " << rt::printable(rt::absolute_path(arguments[0])) << "\n";
    } catch (const std::exception& error) {
        return rt::report_error("contact_sheet", error.what());
    }
}
