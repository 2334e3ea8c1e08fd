// A chunk of an OBJ file's text as numbers: every line is checked and read, independently of other chunks.
#pragma once

#include "common/model/obj_file.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rt {

/// What faces name by number.
struct IndexKind {
    enum Kind { position, uv, normal };
};

struct ParseError {
    int line; ///< in its chunk, from 1
    std::string message;
};

/// A negative position number that reaches back beyond the chunk that it stands in.
struct RelativeIndex {
    int missing;        ///< at least this many positions must stand in earlier chunks
    int count;          ///< this many stand before it in its own
    int line;           ///< in its chunk, from 1
    std::string number; ///< as written
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

/// From face number `face` of the chunk on, faces stand on consecutive lines, the first of them on `line`.
struct FaceLines {
    std::size_t face;
    int line;
};

/// Lines, or corners of faces, that are read only in part.
struct Skipped {
    std::size_t count = 0;
    int line = 0; ///< of the first

    void add(int line_, std::size_t count_ = 1) {
        line = count == 0 ? line_ : std::min(line, line_);
        count += count_;
    }
};

struct SkippedLines {
    Skipped normals, uvs;               ///< vn and vt with numbers that are not finite
    Skipped materials, libraries;       ///< usemtl and mtllib without a name
    Skipped normal_corners, uv_corners; ///< that name a normal or uv that is not there
};

/// What stands in a chunk. An index that a negative number stands for lacks the positions, uvs and normals of
/// the chunks before this one: `relative` lists these corners, one list per kind.
struct ParsedChunk {
    std::vector<dvec3> positions;
    std::vector<vec3> normals; ///< NaN where the file gives no finite one
    std::vector<vec2> uvs;     ///< NaN likewise
    std::vector<vec3>
        colors; ///< sRGB as written, per position; `no_color` for none; short or empty at the end
    std::vector<vec3> painted;             ///< sRGB of #MRGB lines, in [0, 1]
    std::vector<ObjIndex> corners;         ///< of all faces
    std::vector<std::uint32_t> face_sizes; ///< corners of each face
    std::array<std::vector<std::size_t>, 3> relative;
    std::vector<FaceLines> face_lines;
    std::vector<MaterialLine> material_lines;
    std::vector<SmoothingLine> smoothing_lines;
    std::map<std::string, int> materials; ///< each name after usemtl, and the line of its first use
    bool names_library = false;           ///< there is a mtllib line
    SkippedLines skipped;
    std::array<int, 3> largest{};                ///< number of each kind that a face names
    int largest_position_line = 0;               ///< of its first use
    std::vector<RelativeIndex> relative_indices; ///< in the text's order; each misses more than the last
    int lines = 0;
    std::optional<ParseError> fault; ///< the text is read up to here
};

inline constexpr vec3 no_color{-1.0f};

/// Reads whole lines of a text without '\r', in which joined lines are written over.
ParsedChunk parse_chunk(std::string& text, bool begins_file);

/// The line in the chunk, from 1, of the face with corner number `corner` of all.
int line_of_corner(const ParsedChunk& chunk, std::size_t corner);

} // namespace rt
