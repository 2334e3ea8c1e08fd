// The learner's folder beside the reference: which step is meant, which files there are, and what is
// remembered.
#pragma once

#include "tools/tutor/exercises.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rt::tutor {

/// Where all stands.
struct Project {
    std::filesystem::path root;     ///< of the project: steps/, exercises/ and docs/ are in it
    std::filesystem::path workshop; ///< the learner's files, NN_name/file.h
};

std::filesystem::path steps_folder(const Project& project);

/// "01_spheres", "02_shadows", ... Throws Error if the root has no steps.
Words all_steps(const Project& project);

/// The full name of what 3, 03 or 03_mirror means. Throws Error with one line that names the steps.
std::string find_step(const Project& project, const std::string& word);

/// "03" of "03_mirror".
std::string number_of(const std::string& step);

/// The question that a step's main.cpp asks in its first line: "what does the mirror see?"
std::string question_of(const Project& project, const std::string& step);

std::vector<Exercise> exercises_of(const Project& project, const std::string& step);

/// The exercise of that name. Throws Error with one line that names those of the step.
Exercise find_exercise(const Project& project, const std::string& step, const std::string& name);

/// The files that hold exercises of the step, in the order of the exercises, each once.
Words files_to_write(const std::vector<Exercise>& exercises);

/// The learner's headers in workshop/NN_name/, sorted, without what editors leave there; none if there is no
/// such folder.
Words own_files(const Project& project, const std::string& step);

/// Which of the learner's files `word` means: "mirror.h", with or without folders before it. Throws Error.
std::string find_own_file(const Project& project, const std::string& step, const std::string& word);

/// A path as one types it here: without the current folder.
std::string display_path(const std::filesystem::path& path);

/// "workshop/03_mirror/mirror.h:33", which terminals and editors open.
std::string display_path(const std::filesystem::path& path, int line);

/// As fs::create_directories. Throws Error.
void make_folder(const std::filesystem::path& folder);

/// What ./learn check found when it last ran; workshop/.state keeps one line a step:
/// NN_name<TAB>passed<TAB>failed<TAB>verdict<TAB>fingerprint.
struct LastCheck {
    int passed = 0;
    int failed = 0;
    std::string verdict;     ///< on the picture: same, noise, look, different; or a word of why there is none
    std::string fingerprint; ///< of the learner's files at that time
};

/// By step. Lines that cannot be understood are left out: the next check writes them anew.
std::map<std::string, LastCheck> read_checks(const Project& project);

void write_check(const Project& project, const std::string& step, const LastCheck& check);

/// Whether a check found nothing wrong.
bool all_well(const LastCheck& check);

/// 16 hexadecimal digits that differ if any of the learner's files of this step or an earlier one does.
std::string fingerprint(const Project& project, const std::string& step);

/// How many tiers of an exercise's hints have been shown: by "NN_name<TAB>exercise", from workshop/.hints.
using ShownHints = std::map<std::string, int>;
ShownHints read_shown_hints(const Project& project);
void write_shown_hints(const Project& project, const ShownHints& hints);

/// As in "05_mesh_bvh_box": tests/05_mesh_bvh/box.cpp holds the checks, test_05_mesh_bvh_box runs them. First
/// come those of headers with exercises, in an order in which these can be written; slow statistics come
/// last.
Words check_files(const std::filesystem::path& root, const std::string& step);

/// "tests/05_mesh_bvh/box.cpp" for "05_mesh_bvh_box".
std::string check_source(const std::string& step, const std::string& file);

/// Statistics take longer than anybody likes to wait for.
bool is_slow(const std::string& file);

/// The one that has the checks of a header: "05_mesh_bvh_box" for box.h. Not every header has one.
std::string check_file_of(const std::string& step, const std::string& header);

} // namespace rt::tutor
