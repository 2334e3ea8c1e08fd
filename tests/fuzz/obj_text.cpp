// The stages of the OBJ reader in memory: what scan_chunk() accepts parse_chunk() reads, with the counts that were scanned.
#include "common/obj/parse.h"
#include "common/obj/polygon.h"
#include "common/obj/scan.h"
#include "tests/fuzz/fuzz.h"

#include <cmath>
#include <cstdlib>

namespace rt::fuzz {

namespace {

void check_counts(const ParsedChunk& parsed, const ChunkScan& scan) {
    require(parsed.positions.size() == std::size_t(scan.counts[Numbered::position]), "positions are counted");
    require(parsed.uvs.size() == std::size_t(scan.counts[Numbered::uv]), "texture coordinates are counted");
    require(parsed.normals.size() == std::size_t(scan.counts[Numbered::normal]), "normals are counted");
    require(parsed.face_sizes.size() == std::size_t(scan.faces), "faces are counted");
    require(parsed.corners.size() == std::size_t(scan.corners), "corners are counted");
}

void check_polygon(const std::vector<vec3>& corners) {
    const auto triangles = cut_polygon(corners);
    require(triangles.size() == corners.size() - 2, "n corners make n - 2 triangles");
    for (const auto& triangle : triangles)
        for (const int corner : triangle)
            require(corner >= 0 && std::size_t(corner) < corners.size(), "triangles are made of the corners");
}

/// The positions of a face; empty if one is missing.
std::vector<vec3> corners_of(const ParsedChunk& parsed, std::size_t first, std::size_t size) {
    std::vector<vec3> corners;
    for (std::size_t i = first; i < first + size; ++i) {
        const int position = parsed.corners[i].position;
        if (position < 0 || std::size_t(position) >= parsed.positions.size()) return {};
        corners.push_back(vec3(parsed.positions[std::size_t(position)]));
    }
    return corners;
}

} // namespace

void run_obj_text(std::string_view bytes) {
    std::string text(bytes);
    blank_byte_order_mark(text);
    unify_line_ends(text);
    require(text.size() == bytes.size() && text.find('\r') == std::string::npos, "line ends are of one kind");
    const ChunkScan scan = scan_chunk(text, true);
    require(text.size() == bytes.size(), "a text keeps its length");
    if (scan.fault) return;
    const ParsedChunk parsed = parse_chunk("m.obj", text, scan);
    check_counts(parsed, scan);
    std::size_t first = 0;
    for (const std::size_t size : parsed.face_sizes) {
        const std::vector<vec3> corners = corners_of(parsed, first, size);
        if (corners.size() >= 3) check_polygon(corners);
        first += size;
    }
}

/// A word that counts as a number is read as strtod reads it.
void run_numbers(std::string_view bytes) {
    constexpr std::string_view ends_words{" \t\n\r\\#\0", 7};
    if (bytes.size() > 60 || bytes.find_first_of(ends_words) != std::string_view::npos) return;
    if (!number_fault(bytes).empty()) return;
    std::string text = "v " + std::string(bytes) + " 0 0\n";
    const ChunkScan scan = scan_chunk(text, true);
    require(!scan.fault, "a number is accepted where it stands in a line");
    const double expected = std::strtod(std::string(bytes).c_str(), nullptr);
    const double read = parse_chunk("m.obj", text, scan).positions.at(0).x;
    require(std::isfinite(read), "a number is finite");
    require(std::abs(read - expected) <= 1e-6 * std::abs(expected) + 1e-38, "a number is what strtod reads");
}

} // namespace rt::fuzz
