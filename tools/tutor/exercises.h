// The exercises: the regions of the reference between //> and //<, which a learner writes, and stubs cut from
// them.
#pragma once

#include "tools/tutor/util.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rt::tutor {

/// One region. `//> task` opens it, `//< placeholder` closes it.
struct Exercise {
    std::string step;      ///< "03_mirror"
    std::string file;      ///< "mirror.h"
    std::string function;  ///< that the region stands in: "reflected_ray"
    std::string name;      ///< the function's, unless the step has another of that name: unique in the step
    int line = 0;          ///< of //> in the reference, from 1
    int last_line = 0;     ///< of //<
    int function_line = 0; ///< where the function begins, below a template's <...>
    std::string task;
    std::string placeholder; ///< what stands in a stub; may be nothing
    Words reference;         ///< the lines between the two, as they stand
};

/// What stands in a folder, sorted; nothing if it cannot be read, or only what could be.
std::vector<std::filesystem::path> entries_of(const std::filesystem::path& folder);

/// The regions of one file of a step. `path` is named in the Error that a region without end, without task or
/// outside of a function throws.
std::vector<Exercise> find_exercises(const std::string& text, const std::string& path);

/// All exercises of a step, in an order in which they can be written: a file after those that it includes.
/// Where several functions of a step have one name, each is named after its file too: intersect_sphere; a
/// second region of one function is fresnel_2.
std::vector<Exercise> find_step_exercises(const std::filesystem::path& steps, const std::string& step);

/// The file with the regions of these exercises cut: the task as a TODO, and the placeholder. Regions of
/// others stay as they are.
std::string make_stub(const std::string& text, const std::vector<Exercise>& exercises);

/// The file as one reads it: without the lines of the markers.
std::string without_markers(const std::string& text);

/// Where an exercise stands in a learner's file: its TODO, else its function, else the first line.
int place_of(const Exercise& exercise, const std::string& text);

/// Whether the exercise's function still is what the stub says; blanks and comments do not count.
bool is_untouched(const Exercise& exercise, const std::string& text, const std::string& stub);

/// Whether the exercise's function in the learner's file has a loop or calls itself, so that it may not end.
bool may_not_end(const Exercise& exercise, const std::string& text);

/// A header ("03_mirror/mirror.h") and all headers of the steps that it includes, those before it that it
/// needs. A header in the first of `folders` that has it takes the others' place.
Words included_headers(const std::vector<std::filesystem::path>& folders, const std::string& header);

} // namespace rt::tutor
