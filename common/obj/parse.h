// A chunk of an OBJ file's text, once it is scanned, as numbers: tinyobjloader reads them.
#pragma once

#include "common/obj/scan.h"
#include "common/obj_file.h"

#include <cstdint>
#include <string>
#include <vector>

namespace rt {

/// A usemtl or mtllib line.
struct MaterialLine {
    std::size_t face; ///< the first face behind it, counted in the chunk
    bool is_library;
    std::string name; ///< with `inner_space` for spaces
};

/// What stands in a chunk. An index that a negative number stands for lacks the positions, uvs and normals of
/// the chunks before this one: `relative` names these corners, one list a kind.
struct ParsedChunk {
    std::vector<vec3> positions, normals;
    std::vector<vec2> uvs;
    std::vector<ObjCorner> corners;        ///< of all faces
    std::vector<std::uint16_t> face_sizes; ///< corners of each face
    std::array<std::vector<std::size_t>, 3> relative;
    std::vector<MaterialLine> material_lines;
};

/// `scan` is what scan_chunk() said about `text`: no fault. Throws Error where tinyobjloader gives up.
ParsedChunk parse_chunk(const std::string& path, std::string& text, const ChunkScan& scan);

} // namespace rt
