// Suggests the name that was probably meant by a mistyped one.
#pragma once

#include <string>
#include <vector>

namespace rt {

/// Returns " (did you mean --samples?)" for the candidate that begins with `typed` or differs from it by at
/// most two edits (a letter inserted, deleted, replaced, or swapped with its neighbour), or "" if there is
/// none. `dashes` is put before the candidate.
std::string suggestion(const std::string& typed, const std::vector<std::string>& candidates,
                       const std::string& dashes = "");

} // namespace rt
