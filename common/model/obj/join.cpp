// Joins the chunks of an OBJ file into one model.
// The bounding box is known only after joining, and with it the origin that coordinates are moved to
// before they become floats.
#include "common/model/obj/join.h"

#include "common/util/error.h"
#include "common/util/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace rt {
namespace {

constexpr std::array<int ObjIndex::*, 3> index_member{&ObjIndex::position, &ObjIndex::uv, &ObjIndex::normal};
constexpr double smallest_size = 1e-15, largest_size = 1e16; // fourth powers of lengths fit a double

/// What precedes a chunk in the file.
struct Before {
    std::array<int, 3> counts{}; ///< positions, uvs, normals
    int lines = 0;
};

void add_skipped(SkippedLines& all, const SkippedLines& part, int lines_before) {
    for (Skipped SkippedLines::*kind :
         {&SkippedLines::normals, &SkippedLines::uvs, &SkippedLines::materials, &SkippedLines::libraries,
          &SkippedLines::normal_corners, &SkippedLines::uv_corners})
        if ((part.*kind).count > 0) (all.*kind).add(lines_before + (part.*kind).line, (part.*kind).count);
}

/// Adds the counts of the next chunk to the summary. Throws Error for its first error.
void add_facts(const std::string& path, const ParsedChunk& chunk, const Before& before, ObjSummary& summary) {
    const int positions = before.counts[IndexKind::position];
    for (const RelativeIndex& b : chunk.relative_indices) {
        if (b.missing > positions)
            throw Error(at_line(path, before.lines + b.line,
                                "a face names position " + b.number + ", but only " +
                                    std::to_string(positions + b.count) + " precede it"));
    }
    if (chunk.fault) throw Error(at_line(path, before.lines + chunk.fault->line, chunk.fault->message));
    for (const auto& [name, line] : chunk.materials) summary.materials.emplace(name, before.lines + line);
    summary.names_library = summary.names_library || chunk.names_library;
    summary.has_smoothing = summary.has_smoothing || !chunk.smoothing_lines.empty();
    summary.faces += chunk.face_sizes.size();
    summary.corners += chunk.corners.size();
    add_skipped(summary.skipped, chunk.skipped, before.lines);
}

/// Converts relative indices to absolute ones. One that reaches back before the beginning of the file
/// becomes an out-of-range index.
void make_absolute(ParsedChunk& chunk, const Before& before) {
    for (const auto kind : {IndexKind::position, IndexKind::uv, IndexKind::normal}) {
        for (const std::size_t i : chunk.relative[kind]) {
            int& number = chunk.corners[i].*index_member[kind];
            number += before.counts[kind];
            if (number < 0) number = chunk.largest[kind] = std::numeric_limits<int>::max();
        }
    }
}

/// Checks the position indices of all faces. Runs after all chunks are joined, since a face
/// may precede its vertices.
void check_positions(const std::string& path, const std::deque<ParsedChunk>& chunks, std::size_t count) {
    int largest = 0, largest_line = 0, lines = 0;
    for (const ParsedChunk& chunk : chunks) {
        if (chunk.largest[IndexKind::position] > largest) {
            largest = chunk.largest[IndexKind::position];
            largest_line = lines + chunk.largest_position_line;
        }
        lines += chunk.lines;
    }
    if (std::size_t(largest) > count)
        throw Error(at_line(path, largest_line,
                            "a face names position " + std::to_string(largest) + ", but the file has " +
                                std::to_string(count) + " (lines that begin with v)"));
}

/// Appends `rows` to `all` and frees the memory of `rows`.
template <typename Element>
void move_to_end(std::vector<Element>& all, std::vector<Element>& rows) {
    all.insert(all.end(), rows.begin(), rows.end());
    std::vector<Element>().swap(rows);
}

void move_vertices(ParsedChunk& chunk, std::vector<dvec3>& positions, ObjModel& file) {
    if (!chunk.colors.empty()) {
        file.colors.resize(positions.size(), no_color);
        move_to_end(file.colors, chunk.colors);
    }
    move_to_end(positions, chunk.positions);
    move_to_end(file.uvs, chunk.uvs);
    move_to_end(file.normals, chunk.normals);
}

/// Removes uv or normal indices that are out of range from the face vertices.
void drop_missing(ParsedChunk& chunk, IndexKind::Kind kind, int count, int lines_before, Skipped& skipped) {
    if (chunk.largest[kind] <= count) return;
    std::size_t first = 0, dropped = 0;
    for (std::size_t i = 0; i < chunk.corners.size(); ++i) {
        int& number = chunk.corners[i].*index_member[kind];
        if (number < count) continue;
        if (dropped++ == 0) first = i;
        number = -1;
    }
    skipped.add(lines_before + line_of_corner(chunk, first), dropped);
}

/// Removes unusable rows: no face vertex keeps such an index, and the row's value becomes `harmless`.
template <typename Element, typename Usable>
void drop_unusable(std::deque<ParsedChunk>& chunks, IndexKind::Kind kind, std::vector<Element>& rows,
                   Element harmless, const Usable& usable) {
    if (std::ranges::all_of(rows, usable)) return;
    for (ParsedChunk& chunk : chunks) {
        for (ObjIndex& corner : chunk.corners) {
            int& number = corner.*index_member[kind];
            if (number >= 0 && !usable(rows[std::size_t(number)])) number = -1;
        }
    }
    std::ranges::replace_if(
        rows, [&](const Element& row) { return !usable(row); }, harmless);
}

/// Returns whether a float vector can be normalised.
bool is_direction(vec3 v) {
    const float square = dot(v, v);
    return square > 0 && std::isfinite(square);
}

struct Extent {
    dvec3 low{std::numeric_limits<double>::infinity()}, high{-low};

    void grow(const dvec3& p) { low = min(low, p), high = max(high, p); }
    double size() const { return std::hypot(high.x - low.x, high.y - low.y, high.z - low.z); }
    double farthest() const {
        const dvec3 most = max(abs(low), abs(high));
        return std::max({most.x, most.y, most.z});
    }
};

/// Returns the bounding box of the positions used by faces. Files often contain unused vertices as well,
/// typically at the origin.
Extent extent_of(const std::deque<ParsedChunk>& chunks, const std::vector<dvec3>& positions) {
    Extent extent;
    for (const ParsedChunk& chunk : chunks)
        for (const ObjIndex& corner : chunk.corners) extent.grow(positions[std::size_t(corner.position)]);
    return extent;
}

/// Returns the point to move to the origin. A float rounds a coordinate by up to 2^-24 of its value. Beyond 8
/// model sizes from the origin, that is more than 2^-21 of the model's size, which is the error of a hit
/// point. The model's centre then becomes the origin: rounded to whole numbers where that is fine enough, so
/// that decimal coordinates keep their few digits.
dvec3 origin_of(const Extent& extent) {
    const double size = extent.size();
    if (!(extent.farthest() > 8 * size)) return dvec3(0);
    const dvec3 center = 0.5 * extent.low + 0.5 * extent.high;
    return size > 4 ? round(center) : center;
}

/// Returns the 1-based index of a position, used by a face, that has the largest coordinate.
int farthest_position(const std::deque<ParsedChunk>& chunks, const std::vector<dvec3>& positions,
                      const Extent& extent) {
    for (const ParsedChunk& chunk : chunks)
        for (const ObjIndex& corner : chunk.corners) {
            const dvec3 p = abs(positions[std::size_t(corner.position)]);
            if (std::max({p.x, p.y, p.z}) == extent.farthest()) return corner.position + 1;
        }
    return 0;
}

void check_size(const std::string& path, const std::deque<ParsedChunk>& chunks,
                const std::vector<dvec3>& positions, const Extent& extent) {
    const double size = extent.size();
    if (size == 0 || (size >= smallest_size && size <= largest_size)) return;
    char text[160];
    std::snprintf(
        text, sizeof text,
        ": is %.3g across (position %d is the farthest out), but only %g to %g can be shown; scale it", size,
        farthest_position(chunks, positions, extent), smallest_size, largest_size);
    throw Error(path + text);
}

/// Converts positions to floats relative to the origin. Positions that no face uses may not fit
/// a float; they become 0.
void move_to_origin(const std::vector<dvec3>& positions, ObjModel& file) {
    file.positions.reserve(positions.size());
    for (const dvec3& position : positions) {
        const vec3 moved(position - file.origin);
        const bool fits = std::isfinite(moved.x) && std::isfinite(moved.y) && std::isfinite(moved.z);
        file.positions.push_back(fits ? moved : vec3(0));
    }
}

float linear_from_srgb(float value) { // IEC 61966-2-1
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

/// Converts vertex colours to linear RGB. Vertices without a colour become white. Values above 1 mean that
/// the file states bytes.
void finish_colors(const std::deque<ParsedChunk>& chunks, std::size_t count, std::vector<vec3>& colors) {
    if (colors.empty())
        for (const ParsedChunk& chunk : chunks)
            colors.insert(colors.end(), chunk.painted.begin(), chunk.painted.end());
    if (colors.empty()) return;
    colors.resize(count, no_color);
    float most = 0;
    for (const vec3 color : colors) most = std::max({most, color.x, color.y, color.z});
    const float one = most > 1 && most <= 255 ? 255 : 1;
    for (vec3& color : colors) {
        const vec3 srgb = color == no_color ? vec3(1) : min(color / one, vec3(1));
        color = {linear_from_srgb(srgb.x), linear_from_srgb(srgb.y), linear_from_srgb(srgb.z)};
    }
}

/// Reserves memory for all chunks, so that nothing is copied twice.
void reserve(const std::deque<ParsedChunk>& chunks, std::vector<dvec3>& positions, ObjModel& file) {
    std::size_t all_positions = 0, all_uvs = 0, all_normals = 0;
    for (const ParsedChunk& chunk : chunks) {
        all_positions += chunk.positions.size();
        all_uvs += chunk.uvs.size();
        all_normals += chunk.normals.size();
    }
    positions.reserve(all_positions);
    file.uvs.reserve(all_uvs);
    file.normals.reserve(all_normals);
}

/// Moves the uvs, normals and colours of all chunks into `file` and returns the positions
/// as stated in the file.
std::vector<dvec3> join(const std::string& path, std::deque<ParsedChunk>& chunks, ObjModel& file,
                        ObjSummary& summary) {
    std::vector<dvec3> positions;
    reserve(chunks, positions, file);
    std::vector<Before> before(chunks.size() + 1);
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        add_facts(path, chunks[i], before[i], summary);
        make_absolute(chunks[i], before[i]);
        move_vertices(chunks[i], positions, file);
        before[i + 1] = {{int(positions.size()), int(file.uvs.size()), int(file.normals.size())},
                         before[i].lines + chunks[i].lines};
    }
    check_positions(path, chunks, positions.size());
    for (std::size_t i = 0; i < chunks.size(); ++i) {
        drop_missing(chunks[i], IndexKind::uv, int(file.uvs.size()), before[i].lines,
                     summary.skipped.uv_corners);
        drop_missing(chunks[i], IndexKind::normal, int(file.normals.size()), before[i].lines,
                     summary.skipped.normal_corners);
    }
    return positions;
}

} // namespace

ObjSummary join_chunks(const std::string& path, std::deque<ParsedChunk>& chunks, ObjModel& file) {
    ObjSummary summary;
    const std::vector<dvec3> positions = join(path, chunks, file, summary);
    if (summary.faces == 0)
        throw Error(path + ": has no faces (lines such as \"f 1 2 3\"); is it an OBJ file?");
    drop_unusable(chunks, IndexKind::normal, file.normals, vec3(0, 0, 1), is_direction);
    drop_unusable(chunks, IndexKind::uv, file.uvs, vec2(0), [](vec2 uv) { return std::isfinite(uv.x); });
    const Extent extent = extent_of(chunks, positions);
    check_size(path, chunks, positions, extent);
    file.origin = origin_of(extent);
    move_to_origin(positions, file);
    finish_colors(chunks, positions.size(), file.colors);
    return summary;
}

} // namespace rt
