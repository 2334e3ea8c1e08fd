// Joins the chunks of an OBJ file: one numbering, checked indices, and coordinates moved near the origin.
#pragma once

#include "common/model/obj/parse.h"

#include <deque>
#include <map>
#include <string>

namespace rt {

/// Facts about the whole file. Line numbers count from 1 in the file.
struct ObjSummary {
    std::size_t faces = 0, corners = 0;
    std::map<std::string, int> materials; ///< each usemtl name, with the line of its first use
    bool names_library = false;           ///< the file has an mtllib line
    bool has_smoothing = false;           ///< the file has an s line
    SkippedLines skipped;
};

/// Moves positions, normals, uvs and colours of all chunks into `file`, and sets its origin. Afterwards
/// the face vertices of the chunks hold indices into `file`, in range, and -1 where the file gives no
/// usable normal or uv. Throws Error for the first error in the file's order, for a file without faces,
/// and for a model of absurd size.
ObjSummary join_chunks(const std::string& path, std::deque<ParsedChunk>& chunks, ObjModel& file);

} // namespace rt
