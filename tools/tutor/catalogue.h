// The catalogue of mistakes: exercises/NN_name/mistakes.md holds what learners of a step do wrong, each as the smallest change to
// the reference, with what the picture shows then, why, and what to do.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rt {

/// One line of a change: ' ' must be there, '-' must be there and goes, '+' comes in its place.
struct PatchLine {
    char kind;
    std::string text; ///< without the kind
};

struct Mistake {
    std::string step;  ///< "03_mirror"
    std::string id;    ///< "reflect-plus", unique in the step
    std::string title; ///< "the reflection keeps its normal part"
    std::string file;  ///< "03_mirror/mirror.h", below steps/
    std::vector<PatchLine> patch;
    std::string shows; ///< what one sees in the picture; begins with "nothing" if that is nothing
    std::string why;
    std::string fix;
    std::string place; ///< "exercises/03_mirror/mistakes.md:3", for complaints
};

/// Reads one file of the catalogue; `path` is what complaints name. Throws Error with the first fault, as
/// "path:line: what is wrong".
std::vector<Mistake> parse_catalogue(const std::string& text, const std::string& path);

/// The header with the mistake in it. Throws Error if the patch does not apply, or applies in two places.
std::string with_mistake(const Mistake& mistake, const std::string& header);

/// The mistakes of a step, from `root`/exercises/NN_name/mistakes.md; none if there is no such file. All apply to
/// `root`/steps. Throws Error.
std::vector<Mistake> read_catalogue(const std::filesystem::path& root, const std::string& step);

} // namespace rt
