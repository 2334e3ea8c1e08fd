// An OBJ file read in chunks of whole lines, several threads at a time, the same result for any number of
// them.
#pragma once

#include "common/model/obj/parse.h"
#include "common/model/obj_file.h"

#include <deque>
#include <string>

namespace rt {

/// All of the file, or all up to the first chunk with a fault, in the file's order. Throws Error for a file
/// that cannot be read, is empty, or whose beginning is no text.
std::deque<ParsedChunk> read_chunks(const std::string& path, const ObjReadOptions& reading);

} // namespace rt
