// Milestones: a step's functions in groups, in an order in which each group changes the picture.
// For each step, exercises/NN_name/milestones.md lists them and exercises/NN_name/milestones/ holds their pictures.
#pragma once

#include "tools/tutor/exercises.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rt::tutor {

struct Milestone {
    std::string id;    ///< "normals", unique in the step
    std::string title; ///< "the balls have normals"
    Words functions;   ///< the names of the exercises that lead to it: {"make_hit", "surface_hit"}
    Words options;     ///< of the program, to see it: {"--view", "normal"}
    std::string shows; ///< begins with "the same picture" if it changes only how the picture is made
};

/// Parses one file of milestones; `path` is used in error messages. Throws Error for the first error, as
/// "path:line: what is wrong".
std::vector<Milestone> parse_milestones(const std::string& text, const std::string& path);

/// Returns the milestones of a step from `root`/exercises/NN_name/milestones.md; empty if there is no such file. Throws
/// Error.
std::vector<Milestone> read_milestones(const std::filesystem::path& root, const std::string& step);

/// Sorts the step's exercises by their milestones. Throws Error if an exercise is in none or in two of them, or if a
/// milestone names a function that the step does not ask for.
void sort_by_milestones(const std::filesystem::path& root, const std::string& step,
                        std::vector<Exercise>& exercises);

/// Returns how many milestones are complete: all functions of these and of those before are in `written`.
std::size_t milestones_reached(const std::vector<Milestone>& milestones, const Words& written);

/// Returns "2 of 6: rays hit the balls" for these written functions; empty if no milestone is complete.
std::string milestone_text(const std::vector<Milestone>& milestones, const Words& written);

/// Returns "exercises/03_mirror/milestones/mirrors.png", below the project's folder.
std::filesystem::path milestone_picture(const std::string& step, const std::string& id);

} // namespace rt::tutor
