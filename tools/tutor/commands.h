// The commands of ./learn, one function each.
// They print their output and throw Error for wrong arguments and for files that cannot be read or written,
// CommandFailed if something did not work, and Stop to exit with a code and without a message.
#pragma once

#include "tools/tutor/workshop.h"

#include <filesystem>
#include <ostream>
#include <string>
#include <vector>

namespace rt::tutor {

/// Writes the stubs of a step into the workshop, and lists the functions to write.
void start_step(const Project& project, const std::string& step, std::ostream& out);

/// Merges what has changed in the given parts of the learner's files, since ./learn start, into these files.
void merge_step(const Project& project, const std::string& step, std::ostream& out);

/// Prints the learner's progress in all steps, and what to do next.
void show_status(const Project& project, std::ostream& out);

/// Returns the steps that are not done.
Words open_steps(const Project& project);

/// Renders all steps and one more scene with the learner's programs, and writes workshop/report/course.html, a page to
/// share; opens it if `open`. Throws CommandFailed if a step is not done.
void make_course_page(const Project& project, bool open);

/// Which of the hints of an exercise to show.
enum class HintMode { next, again, all, reset };

/// Shows hints of the exercise `name`. If `name` is empty: lists the exercises of the step, or with `reset`
/// forgets which of their hints were shown.
void show_hints(const Project& project, const std::string& step, const std::string& name, HintMode mode,
                std::ostream& out);

/// Prints the difference between the reference and the learner's file, or all of the learner's files of the
/// step if `file` is empty.
void show_diff(const Project& project, const std::string& step, const std::string& file, bool colour,
               std::ostream& out);

/// Moves the learner's file into workshop/.backup/, or all files of the step if `file` is empty.
void undo_files(const Project& project, const std::string& step, const std::string& file, std::ostream& out);

/// Builds and renders a step, with flags for its program, or all steps if `step` is empty, and compares with
/// the references. Returns the exit code: 1 if a picture differs.
int run_steps(const Project& project, const std::string& step, const Words& flags);

/// Writes workshop/scenes/NAME.cpp, an example of a scene for the program of this step. Throws Error if it exists.
void write_scene(const Project& project, const std::string& name, const std::string& step, std::ostream& out);

/// Returns whether the learner has a scene of that name.
bool has_scene(const Project& project, const std::string& name);

/// Builds the step's program with a scene of the learner's own, renders it to workshop/renders/, and writes a page
/// with all pictures there. Returns the program's exit code.
int run_scene(const Project& project, const std::string& step, const std::string& name, const Words& flags);

/// Builds the learner's program of a step for a debugger, and starts gdb, or lldb, on it, with further flags for the
/// program; `only_build`: for an editor's debugger.
void debug_step(const Project& project, const std::string& step, const Words& flags, bool only_build);

/// Renders the reference of a step, or of all steps if `step` is empty, and their contact sheet.
void make_references(const Project& project, const std::string& step);

/// Makes the pictures and plots of the chapters of these steps, or of all chapters if `steps` is empty.
void make_figures(const Project& project, const Words& steps);

/// Runs the checks of a step or group, or all checks if `word` is empty; writes JUnit XML unless `junit` is
/// empty. Returns the exit code: 1 if a check fails.
int run_tests(const Project& project, const std::string& word, const std::string& junit);

struct Pixel {
    int x = 0, y = 0, sample = 1; ///< x and y from 0 at the top left; samples from 1
};

/// Prints the rays of one sample of a pixel, with flags for the step's program.
void trace_pixel(const Project& project, const std::string& step, const Pixel& pixel, const Words& flags);

struct BenchOptions {
    std::string name; ///< empty or "all": all of them
    std::string json, out;
    bool quick = false;
    Words flags; ///< for the benchmark's program
};

void run_benchmarks(const Project& project, const BenchOptions& options);

struct FuzzOptions {
    std::string target; ///< empty: all
    int seconds = 60, seed = 0;
};

Words fuzz_targets(const Project& project);

/// Runs the fuzz targets. Returns the exit code: 1 if an input breaks a target.
int fuzz(const Project& project, const FuzzOptions& options);

struct CheckOptions {
    std::string step;
    std::filesystem::path build; ///< a configured build folder with the checks of all steps
    bool picture = true;         ///< false: run only the checks
    bool colour = false;
    int width = 100;   ///< columns of the terminal
    bool open = false; ///< opens the report in the browser
};

/// Checks a step. Returns the exit code: 0 if everything passes, 1 if not. Writes workshop/.state and
/// workshop/report/NN_name.html. Throws Error for problems that the learner's code did not cause.
int check_step(const Project& project, const CheckOptions& options, std::ostream& out);

/// Checks a step at each save until q is typed, or until the input ends if it is not a terminal. Returns the
/// exit code of the last check.
int watch_step(const Project& project, const CheckOptions& options, std::ostream& out);

} // namespace rt::tutor
