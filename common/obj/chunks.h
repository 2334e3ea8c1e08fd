// An OBJ file read in chunks of whole lines, several threads at a time, the same result for any number of
// them.
#pragma once

#include "common/obj/parse.h"
#include "common/obj/scan.h"

#include <deque>
#include <string>

namespace rt {

struct Chunk {
    bool begins_file = false;
    ChunkScan scan;
    ParsedChunk parsed; ///< empty if the scan found a fault
};

/// All of the file, or all up to the first chunk with a fault, in the file's order. Throws Error for a file
/// that cannot be read or is empty.
std::deque<Chunk> read_chunks(const std::string& path, const ObjReading& reading);

} // namespace rt
