// The chunks of an OBJ file put together: one numbering for all, every index checked, the model moved to
// where floats are fine enough.
#pragma once

#include "common/model/obj/parse.h"

#include <deque>
#include <map>
#include <string>

namespace rt {

/// What a file's lines say as a whole. Lines count from 1 in the file.
struct ObjSummary {
    std::size_t faces = 0, corners = 0;
    std::map<std::string, int> materials; ///< each name after usemtl, and the line of its first use
    bool names_library = false;           ///< there is a mtllib line
    bool has_smoothing = false;           ///< there is an s line
    SkippedLines skipped;
};

/// Moves positions, normals, uvs and colours of all chunks into `file`, and sets its origin. The corners of
/// the chunks are then indices of `file`, in range; -1 also where the file gives no usable normal or uv.
/// Throws Error for the first fault in the file's order, for a file without faces, and for a model of absurd
/// size.
ObjSummary join_chunks(const std::string& path, std::deque<ParsedChunk>& chunks, ObjModel& file);

} // namespace rt
