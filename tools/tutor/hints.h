// The hints of a step, from exercises/NN_name/hints.md: what to look at, which formula, which line.
#pragma once

#include "tools/tutor/exercises.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rt::tutor {

/// Maps the name of an exercise to its hints, each a single line.
using Hints = std::map<std::string, Words>;

inline constexpr std::size_t hint_count = 3;

/// Parses a file of hints: `## name` begins an exercise, `1. ` a hint, and indented lines continue it. Throws
/// Error, which names the file and the line, for anything else.
Hints parse_hints(const std::string& text, const std::string& path);

/// Returns the hints in ROOT/exercises/STEP/hints.md. Throws Error unless there are exactly three for each
/// exercise and none for anything else.
Hints read_hints(const std::filesystem::path& root, const std::string& step,
                 const std::vector<Exercise>& exercises);

} // namespace rt::tutor
