// Compares two texts with git.
#pragma once

#include <string>

namespace rt::tutor {

struct NamedText {
    std::string name, text;
};

/// Returns a unified diff with three lines of context, below a header that names both texts; empty if the
/// texts are equal. `colour`: removed lines are red, added ones green. Throws Error if git is not installed.
std::string unified_diff(const NamedText& first, const NamedText& second, bool colour);

} // namespace rt::tutor
