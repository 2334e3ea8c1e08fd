// Reads an OBJ file in chunks of whole lines, on several threads; their number does not affect the result.
#pragma once

#include "common/model/obj/parse.h"
#include "common/model/obj_file.h"

#include <deque>
#include <string>

namespace rt {

/// Returns the parsed chunks in the file's order: all of them, or those up to the first with an error. Throws
/// Error if the file cannot be read, is empty, or does not begin with text.
std::deque<ParsedChunk> read_chunks(const std::string& path, const ObjReadOptions& reading);

} // namespace rt
