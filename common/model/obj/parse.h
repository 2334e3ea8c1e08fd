// Parses a chunk of OBJ text: every line is checked and read, independently of other chunks.
#pragma once

#include "common/model/obj_file.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rt {

/// The kinds of elements that a face refers to by index.
struct IndexKind {
    enum Kind { position, uv, normal };
};

struct ParseError {
    int line; ///< line in the chunk, from 1
    std::string message;
};

/// A negative position index that reaches back beyond its own chunk.
struct RelativeIndex {
    int missing;        ///< positions that earlier chunks must contain at least
    int count;          ///< positions before it in its own chunk
    int line;           ///< line in the chunk, from 1
    std::string number; ///< as written in the file
};

/// A usemtl or mtllib line.
struct MaterialLine {
    std::size_t face; ///< the first face behind it, counted in the chunk
    bool is_library;
    std::string name; ///< with `name_space` for spaces; "" is the default material
};

/// An s line.
struct SmoothingLine {
    std::size_t face; ///< the first face behind it, counted in the chunk
    int group;        ///< 0: off
};

/// From face number `face` of the chunk on, faces are on consecutive lines; the first is on `line`.
struct FaceLines {
    std::size_t face;
    int line;
};

/// Lines, or face vertices, that are read only in part.
struct Skipped {
    std::size_t count = 0;
    int line = 0; ///< of the first one

    void add(int line_, std::size_t count_ = 1) {
        line = count == 0 ? line_ : std::min(line, line_);
        count += count_;
    }
};

struct SkippedLines {
    Skipped normals, uvs;               ///< vn and vt with numbers that are not finite
    Skipped materials, libraries;       ///< usemtl and mtllib without a name
    Skipped normal_corners, uv_corners; ///< with an index of a normal or uv that does not exist
};

/// The content of a chunk. Negative indices do not count the positions, uvs and normals of earlier chunks
/// yet: `relative` lists the face vertices with such indices, one list per kind.
struct ParsedChunk {
    std::vector<dvec3> positions;
    std::vector<vec3> normals; ///< NaN where the file's normal is not finite
    std::vector<vec2> uvs;     ///< NaN likewise
    /// sRGB as in the file, per position; `no_color` for none; may be short or empty.
    std::vector<vec3> colors;
    std::vector<vec3> painted;             ///< sRGB of #MRGB lines, in [0, 1]
    std::vector<ObjIndex> corners;         ///< of all faces, in order
    std::vector<std::uint32_t> face_sizes; ///< number of vertices of each face
    std::array<std::vector<std::size_t>, 3> relative;
    std::vector<FaceLines> face_lines;
    std::vector<MaterialLine> material_lines;
    std::vector<SmoothingLine> smoothing_lines;
    std::map<std::string, int> materials; ///< each usemtl name, with the line of its first use
    bool names_library = false;           ///< the chunk has an mtllib line
    SkippedLines skipped;
    std::array<int, 3> largest{};                ///< largest index of each kind in a face
    int largest_position_line = 0;               ///< line of its first use
    std::vector<RelativeIndex> relative_indices; ///< in file order, with increasing `missing`
    int lines = 0;
    std::optional<ParseError> fault; ///< parsing stopped here
};

inline constexpr vec3 no_color{-1.0f};

/// Parses whole lines of a text without '\r'. It overwrites line ends where lines are joined.
ParsedChunk parse_chunk(std::string& text, bool begins_file);

/// Returns the line in the chunk, from 1, of the face that contains face vertex `corner`.
int line_of_corner(const ParsedChunk& chunk, std::size_t corner);

} // namespace rt
