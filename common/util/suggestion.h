// The name that was probably meant where one was mistyped.
#pragma once

#include <string>
#include <vector>

namespace rt {

/// Returns " (did you mean --samples?)" for the candidate that at most two letters inserted, dropped, replaced
/// or swapped with their neighbour make of `typed`, or that begins with it; else "". `dashes` stands before it.
std::string suggestion(const std::string& typed, const std::vector<std::string>& candidates,
                       const std::string& dashes = "");

} // namespace rt
