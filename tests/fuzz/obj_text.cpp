// Fuzz target for OBJ text in memory: consistency of parse_chunk(), triangulation, and exact numbers.
#include "common/model/obj/parse.h"
#include "common/model/obj/polygon.h"
#include "common/util/text.h"
#include "tests/fuzz/fuzz.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

namespace rt::fuzz {

namespace {

void check_chunk(const ParsedChunk& chunk, const std::string& text) {
    const std::size_t corners = chunk.corners.size();
    const std::size_t named =
        std::accumulate(chunk.face_sizes.begin(), chunk.face_sizes.end(), std::size_t(0));
    require(named == corners, "every corner belongs to a face");
    // One more if the last line has no line end, or if a '\' at its end continues it.
    const auto ends = std::ranges::count(text, '\n');
    require(chunk.lines == ends || chunk.lines == ends + 1, "lines are counted");
    for (const auto& list : chunk.relative)
        for (const std::size_t corner : list) require(corner < corners, "relative indices belong to corners");
    for (const MaterialLine& line : chunk.material_lines)
        require(line.face <= chunk.face_sizes.size(), "a material line is before a face or at the end");
    for (const dvec3& p : chunk.positions)
        require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "positions are finite");
    require(chunk.colors.size() <= chunk.positions.size(), "a colour belongs to a position");
    for (std::size_t i = 0, before = 1; i < corners; ++i) {
        const int line = line_of_corner(chunk, i);
        require(line >= int(before) && line <= chunk.lines, "faces are in the order of their lines");
        before = std::size_t(line);
    }
}

void check_polygon(const std::vector<vec3>& corners) {
    const auto triangles = triangulate(corners);
    require(triangles.size() == corners.size() - 2, "n corners make n - 2 triangles");
    for (const auto& triangle : triangles)
        for (const int corner : triangle)
            require(corner >= 0 && std::size_t(corner) < corners.size(), "triangles consist of the corners");
}

/// Returns the positions of a face; empty if one is missing or too large for a float.
std::vector<vec3> corners_of(const ParsedChunk& parsed, std::size_t first, std::size_t size) {
    std::vector<vec3> corners;
    for (std::size_t i = first; i < first + size; ++i) {
        const int position = parsed.corners[i].position;
        if (position < 0 || std::size_t(position) >= parsed.positions.size()) return {};
        corners.push_back(vec3(parsed.positions[std::size_t(position)]));
        if (!is_finite(corners.back())) return {};
    }
    return corners;
}

} // namespace

void run_obj_text(std::string_view bytes) {
    if (bytes.empty()) return;
    std::string text(bytes);
    blank_byte_order_mark(text);
    unify_line_ends(text);
    require(text.size() == bytes.size() && text.find('\r') == std::string::npos,
            "there is only one type of line end");
    const std::string before = text;
    const ParsedChunk chunk = parse_chunk(text, true);
    require(text.size() == before.size(), "a text keeps its length");
    if (chunk.fault) return require(chunk.fault->line == chunk.lines + 1, "parsing ends at a fault");
    check_chunk(chunk, before);
    std::size_t first = 0;
    for (const std::size_t size : chunk.face_sizes) {
        const std::vector<vec3> corners = corners_of(chunk, first, size);
        if (corners.size() >= 3) check_polygon(corners);
        first += size;
    }
}

/// Checks that a word that counts as a number has the value of strtod, bit for bit.
void run_numbers(std::string_view bytes) {
    constexpr std::string_view ends_words{" \t\n\0", 4};
    if (bytes.size() > 60 || bytes.find_first_of(ends_words) != std::string_view::npos) return;
    const std::string word(bytes);
    double read = 0;
    const char* const stop = read_number(word.c_str(), word.c_str() + word.size(), read);
    require((stop != nullptr) == number_fault(word, double_exponent).empty(),
            "a number is read or has a fault");
    if (!stop) return;
    const double expected = std::strtod(word.c_str(), nullptr);
    require(stop == word.c_str() + word.size() && std::isfinite(read),
            "a number is finite and ends with its word");
    require(read == expected && std::signbit(read) == std::signbit(expected),
            "a number equals that of strtod");
}

} // namespace rt::fuzz
