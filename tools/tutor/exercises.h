// The exercises: the regions of the reference between //> and //<, which stubs replace by gaps.
#pragma once

#include "tools/tutor/util.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rt::tutor {

/// An exercise: a region that `//> task` opens and `//< placeholder` closes.
struct Exercise {
    std::string step;      ///< "03_mirror"
    std::string file;      ///< "mirror.h"
    std::string function;  ///< that contains the region: "reflected_ray"
    std::string name;      ///< unique in the step: the function's name, with a suffix if it is not unique
    int line = 0;          ///< line of //> in the reference, from 1
    int last_line = 0;     ///< line of //<
    int function_line = 0; ///< where the function begins, after "template <...>"
    std::string task;
    std::string placeholder; ///< the code in a stub; may be empty
    Words reference;         ///< the lines between the two markers, unchanged
};

/// Returns the sorted entries of a folder; empty or incomplete if it cannot be read.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);

/// Returns the regions of one file of a step. Throws Error, which names `path`, for a region without an end
/// or a task, or outside of a function.
std::vector<Exercise> find_exercises(const std::string& text, const std::string& path);

/// Returns all exercises of a step in an order in which they can be written: that of their milestones; without
/// these, a file comes after those that it includes. If several functions of a step have the same name, the file is
/// appended (intersect_sphere); the second region of a function is called fresnel_2.
std::vector<Exercise> find_step_exercises(const std::filesystem::path& steps, const std::string& step);

/// Returns the file with the regions of these exercises replaced by the task as a TODO, and the placeholder.
/// Other regions are kept.
std::string make_stub(const std::string& text, const std::vector<Exercise>& exercises);

/// Returns the file without the marker lines.
std::string without_markers(const std::string& text);

/// Returns the line of an exercise in a learner's file: that of its TODO, else of its function, else 1.
int line_of(const Exercise& exercise, const std::string& text);

/// Lines of a text: [begin, end), from 0.
struct LineRange {
    std::size_t begin = 0, end = 0;
};

/// Returns where the functions of that name are defined, each up to the } in column 0.
std::vector<LineRange> functions_named(const std::string& text, const std::string& name);

/// Returns these lines without whitespace and comments.
std::string bare_code(const std::string& text, const LineRange& range);

/// Returns whether the exercise's function is still the same as in the stub, ignoring
/// whitespace and comments.
bool is_untouched(const Exercise& exercise, const std::string& text, const std::string& stub);

/// Returns whether the exercise's function in the learner's file has a loop or calls itself, so that it
/// may run forever.
bool may_not_end(const Exercise& exercise, const std::string& text);

/// Returns a header ("03_mirror/mirror.h") and all step headers that it includes, dependencies first. If
/// several `folders` have a header, the first one is used.
Words included_headers(const std::vector<std::filesystem::path>& folders, const std::string& header);

} // namespace rt::tutor
