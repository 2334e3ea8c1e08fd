// Parts of a source file by name, so that a chapter can show a function and not a range of lines.
#pragma once

#include <string>

namespace rt::weave {

/// The declaration of `name` at the top level of a source, with the comment over it: a function, a struct, an enum, an
/// alias, a concept, a constant. Functions that share a name are told apart by how their parameters begin, as the source
/// writes it: "intersect(const Quad". A definition goes before declarations of the same. Throws Error, which begins with
/// `path`, if there is none or more than one.
std::string region(const std::string& text, const std::string& name, const std::string& path);

} // namespace rt::weave
