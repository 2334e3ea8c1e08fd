// The hints of a step, read from exercises/NN_name/hints.md: three tiers an exercise, what to look at, which
// formula, which line.
#pragma once

#include "tools/tutor/exercises.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rt::tutor {

/// By the exercise's name: its tiers, each a line of text without line ends.
using Hints = std::map<std::string, Words>;

inline constexpr std::size_t tiers = 3;

/// `## name` begins an exercise, `1. ` a tier, and lines that are indented go on with it. Throws Error that names
/// file and line for anything else.
Hints parse_hints(const std::string& text, const std::string& path);

/// Those in ROOT/exercises/STEP/hints.md. Throws Error if an exercise lacks its three, or if hints are left
/// over.
Hints read_hints(const std::filesystem::path& root, const std::string& step,
                 const std::vector<Exercise>& exercises);

} // namespace rt::tutor
