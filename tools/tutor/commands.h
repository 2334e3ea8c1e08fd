// What the tutor does, one function a command. Each writes what it has to say to `out`, in finished words, and throws
// Error for wrong words and files that cannot be read or written.
#pragma once

#include "tools/tutor/workshop.h"

#include <ostream>
#include <string>

namespace rt {

/// Cuts the stubs of a step into the workshop, and says what to write.
void start_step(const Project& project, const std::string& step, std::ostream& out);

/// Where the learner stands in all steps, and what is next.
void show_status(const Project& project, std::ostream& out);

/// Which of an exercise's hints to show.
enum class HintWish { next, again, all, reset };

/// Without a name: lists the exercises of the step, or forgets (reset) which hints of theirs were shown.
void show_hints(const Project& project, const std::string& step, const std::string& name, HintWish wish,
                std::ostream& out);

/// The reference against the learner's file, or all of the learner's files of the step if `file` is empty.
void show_diff(const Project& project, const std::string& step, const std::string& file, bool colour,
               std::ostream& out);

/// Moves the learner's file out of the way, or all files of the step if `file` is empty.
void undo_files(const Project& project, const std::string& step, const std::string& file, std::ostream& out);

} // namespace rt
