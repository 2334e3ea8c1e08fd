// The workshop, the learner's folder: finds its steps and files, and stores progress.
#pragma once

#include "tools/tutor/exercises.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rt::tutor {

/// The folders of the project.
struct Project {
    std::filesystem::path root;     ///< the project's folder, which contains steps/, exercises/ and docs/
    std::filesystem::path workshop; ///< the learner's files, NN_name/file.h
};

std::filesystem::path steps_folder(const Project& project);

/// Returns "01_spheres", "02_shadows", ... Throws Error if the root has no steps.
Words all_steps(const Project& project);

/// Returns the full name of the step that 3, 03 or 03_mirror means. Throws Error, which lists the steps.
std::string find_step(const Project& project, const std::string& word);

/// Returns the step in which the learner saved a file last; without files, the first one. Throws Error.
std::string current_step(const Project& project);

/// Returns "03" for "03_mirror".
std::string number_of(const std::string& step);

/// Returns the question in the first line of a step's main.cpp: "what does the mirror see?"
std::string question_of(const Project& project, const std::string& step);

std::vector<Exercise> exercises_of(const Project& project, const std::string& step);

/// Returns the exercise of that name. Throws Error, which lists those of the step.
Exercise find_exercise(const Project& project, const std::string& step, const std::string& name);

/// Returns the files that contain the exercises, in their order, without duplicates.
Words files_to_write(const std::vector<Exercise>& exercises);

/// Returns the learner's headers in workshop/NN_name/, sorted, without editors' temporary files; empty if
/// there is no such folder.
Words own_files(const Project& project, const std::string& step);

/// Returns the files of the reference's step, "steps/03_mirror/mirror.h", that differ from what was committed.
Words edited_references(const Project& project, const std::string& step);

/// Returns the learner's files whose given part has changed in the reference, but for comments, since ./learn start.
Words outdated_files(const Project& project, const std::string& step);

/// Returns the learner's file that `word` means: "mirror.h", with or without leading folders. Throws Error.
std::string find_own_file(const Project& project, const std::string& step, const std::string& word);

/// Returns a path relative to the current folder if it is inside it.
std::string display_path(const std::filesystem::path& path);

/// Returns a text such as "workshop/03_mirror/mirror.h:33", which terminals and editors can open.
std::string display_path(const std::filesystem::path& path, int line);

/// Creates a folder and its parents. Throws Error.
void make_folder(const std::filesystem::path& folder);

/// The result of the last ./learn check. workshop/.state has one line per step:
/// NN_name<TAB>passed<TAB>failed<TAB>verdict<TAB>fingerprint.
struct LastCheck {
    int passed = 0;
    int failed = 0;
    std::string verdict;     ///< of the picture: same, noise, look, different; or why there is none
    std::string fingerprint; ///< of the learner's files at the time of the check
};

/// Returns the last check of each step. Ignores malformed lines, which the next check overwrites.
std::map<std::string, LastCheck> read_checks(const Project& project);

void write_check(const Project& project, const std::string& step, const LastCheck& check);

/// Returns whether a check found nothing wrong.
bool all_well(const LastCheck& check);

/// Returns 16 hexadecimal digits that change if any of the learner's files of this step or an
/// earlier one does.
std::string fingerprint(const Project& project, const std::string& step);

/// How many hints of each exercise have been shown; the key is "NN_name<TAB>exercise".
/// Stored in workshop/.hints.
using ShownHints = std::map<std::string, int>;
ShownHints read_shown_hints(const Project& project);
void write_shown_hints(const Project& project, const ShownHints& hints);

/// Returns the names of the files of checks of a step: "05_mesh_bvh_box" for tests/05_mesh_bvh/box.cpp, whose
/// program is test_05_mesh_bvh_box. Headers with exercises come first, in an order in which they can be
/// written; slow statistics come last.
Words check_files(const std::filesystem::path& root, const std::string& step);

/// Returns "tests/05_mesh_bvh/box.cpp" for "05_mesh_bvh_box".
std::string check_source(const std::string& step, const std::string& file);

/// Returns whether a file of checks is slow: those of statistics are.
bool is_slow(const std::string& file);

/// Returns the name of the file of checks of a header: "05_mesh_bvh_box" for box.h. Not every header has one.
std::string check_file_of(const std::string& step, const std::string& header);

} // namespace rt::tutor
