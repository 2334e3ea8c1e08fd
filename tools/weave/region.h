// Finds parts of a source file by name, so that a chapter can show a function instead of a range of lines.
#pragma once

#include <string>

namespace rt::weave {

/// Returns the top-level declaration of `name` with the comment above it: a function, struct, enum, alias,
/// concept or constant. A definition takes precedence over a declaration. Overloads are selected by the
/// beginning of their parameters, exactly as in the source: "intersect(const Quad". Throws Error, which
/// begins with `path`, if there is none or more than one.
std::string region(const std::string& text, const std::string& name, const std::string& path);

} // namespace rt::weave
