// Builds what a command needs, and finds the one line of a compiler's hundred that matters when that fails.
#pragma once

#include "tools/tutor/workshop.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rt::tutor {

struct CompileError {
    std::string file; ///< as the compiler names it
    int line = 0;
    std::string message; ///< "expected ';' before 'return'"
};

/// The first error that GCC or Clang reports in `log`, in a file below `preferred` if there is one there: an
/// error in a learner's file also breaks files that include it.
std::optional<CompileError> first_error(const std::string& log, const std::string& preferred);

struct BuildResult {
    bool succeeded = false;
    int code = 0;
    std::optional<CompileError> error; ///< nothing if it failed in another way
    std::string log;
};

/// Builds the targets in the folder of a configured build, under its lock; `log` receives the output. Calls
/// `on_first`, on this thread, as soon as the program bin/`targets[0]` is new, or at the end if there was
/// nothing to make; not if anything failed before.
BuildResult build_targets(const std::filesystem::path& build, const Words& targets,
                          const std::filesystem::path& log, const std::string& preferred,
                          const std::function<void()>& on_first = {});

/// A build of the project by a preset of CMake: its folder is build/`preset`.
struct Preset {
    std::filesystem::path root;
    std::string name = "release";

    std::filesystem::path folder() const { return root / "build" / name; }
    std::filesystem::path program(const std::string& program) const { return folder() / "bin" / program; }
};

/// Configures the preset: `again` even if it has been configured before. Throws CommandFailed.
void configure(const Preset& preset, bool again = false);

/// Builds the targets, under the lock, and prints how long that took unless it is `quiet`. Prints what went
/// wrong and throws CommandFailed.
void make(const Preset& preset, const Words& targets, bool quiet = false);

/// Waits while another process links `program`, which stands in the folder bin/ of a build: it cannot be
/// started then.
void wait_for_program(const std::filesystem::path& program);

/// Builds a tool of the project and runs it in place of this program.
[[noreturn]] void hand_over(const Preset& preset, const std::string& tool, const Words& arguments);

} // namespace rt::tutor
