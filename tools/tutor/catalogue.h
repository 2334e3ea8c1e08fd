// The catalogue of mistakes that learners make, and that of right code in another shape than the reference's.
// For each step, exercises/NN_name/mistakes.md describes the mistakes, exercises/NN_name/gallery/ holds the pictures
// that they produce, and exercises/NN_name/variants.md describes the right variants.
#pragma once

#include "tools/compare/catalogue.h"
#include "tools/tutor/exercises.h"
#include "tools/tutor/util.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rt::tutor {

/// A line of a change: ' ' is context, '-' is removed, '+' is inserted.
struct PatchLine {
    char kind;
    std::string text; ///< without the kind
};

/// A described change of the reference.
struct Patch {
    std::string step;  ///< "03_mirror"
    std::string id;    ///< "reflect-plus", unique in the step
    std::string title; ///< "the reflection keeps its normal part"
    std::string file;  ///< "03_mirror/mirror.h", below steps/
    std::vector<PatchLine> lines;
    std::string place; ///< for error messages
};

struct Mistake : Patch {
    Words closer;      ///< options of a view in which the effect is easier to see; usually none
    std::string shows; ///< the visible effect; begins with "nothing" if there is none
    std::string why;
    std::string fix;
};

/// Code that is as right as the reference's: all checks must pass, and the picture must be the reference's.
struct Variant : Patch {
    std::string form; ///< where it is found
};

/// Parse one file of a catalogue; `path` is used in error messages. Throw Error for the first error, as
/// "path:line: what is wrong".
std::vector<Mistake> parse_catalogue(const std::string& text, const std::string& path);
std::vector<Variant> parse_variants(const std::string& text, const std::string& path);

/// Returns the header with the patch applied. Throws Error if it applies nowhere or in two places.
std::string with_patch(const Patch& patch, const std::string& header);

/// Returns the mistakes of a step from `root`/exercises/NN_name/mistakes.md; empty if there is no such file.
/// Checks that each applies to `root`/steps. Throws Error.
std::vector<Mistake> read_catalogue(const std::filesystem::path& root, const std::string& step);

/// The same for the right variants in variants.md.
std::vector<Variant> read_variants(const std::filesystem::path& root, const std::string& step);

/// Returns the function that the patch begins to change; empty if it is in no exercise. Throws Error.
std::string function_of(const std::filesystem::path& root, const Patch& patch);

/// Returns the ids of the mistakes of the exercise's step that are in the exercise's function. Throws Error.
Words mistakes_in(const std::filesystem::path& root, const Exercise& exercise);

/// Returns a path such as `root`/exercises/03_mirror/gallery/far-root.png. The id of the correct
/// picture is "right".
std::filesystem::path gallery_picture(const std::filesystem::path& root, const std::string& step,
                                      const std::string& id);

/// The same for a picture in the view `Mistake::closer` of the mistake `id`: with the mistake, and the correct one.
std::filesystem::path closer_picture(const std::filesystem::path& root, const std::string& step,
                                     const std::string& id);
std::filesystem::path closer_right_picture(const std::filesystem::path& root, const std::string& step,
                                           const std::string& id);

/// Returns the value after `key: ` in assets/reference/NN_name.txt, or an empty string.
std::string reference_fact(const std::filesystem::path& root, const std::string& step,
                           const std::string& key);

/// Returns the flags for a picture of the gallery: the reference's view at 5/12 of its width and height.
Words gallery_flags(const std::filesystem::path& root, const std::string& step);

/// Returns the ids of the mistakes whose gallery picture matches `picture`, which was rendered
/// with those flags.
compare::CatalogueMatch nearest_mistake(const std::filesystem::path& root, const std::string& step,
                                        const std::filesystem::path& picture);

} // namespace rt::tutor
