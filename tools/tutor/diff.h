// The difference between two texts, as git shows it.
#pragma once

#include <string>

namespace rt::tutor {

struct NamedText {
    std::string name, text;
};

/// Returns a unified diff: the changes with three lines around them, below a head that names both texts;
/// empty if there are no changes. In colour: red what goes, green what comes. Throws Error if there is no
/// git.
std::string unified_diff(const NamedText& first, const NamedText& second, bool colour);

} // namespace rt::tutor
