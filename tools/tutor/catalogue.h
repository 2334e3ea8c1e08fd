// The catalogue of mistakes: exercises/NN_name/mistakes.md holds what learners of a step do wrong, and
// gallery/ what that looks like.
#pragma once

#include "tools/compare/catalogue.h"
#include "tools/tutor/util.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rt::tutor {

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

/// The mistakes of a step, from `root`/exercises/NN_name/mistakes.md; none if there is no such file. All
/// apply to `root`/steps. Throws Error.
std::vector<Mistake> read_catalogue(const std::filesystem::path& root, const std::string& step);

/// `root`/exercises/03_mirror/gallery/far-root.png; the right picture is called "right".
std::filesystem::path gallery_picture(const std::filesystem::path& root, const std::string& step,
                                      const std::string& id);

/// What an assets/reference/NN_name.txt says after `key: `; empty if it does not.
std::string reference_fact(const std::filesystem::path& root, const std::string& step,
                           const std::string& key);

/// The flags with which a step's program renders for the gallery: the reference's view on 3/8 of its pixels.
Words gallery_flags(const std::filesystem::path& root, const std::string& step);

/// The ids of the mistakes whose picture this one is, rendered with those flags; none if it is like none of
/// them.
compare::CatalogueMatch nearest_mistake(const std::filesystem::path& root, const std::string& step,
                                        const std::filesystem::path& picture);

} // namespace rt::tutor
