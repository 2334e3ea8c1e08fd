// Builds what a command needs, and finds the first error in a compiler's output if that fails.
#pragma once

#include "common/util/system.h"
#include "tools/tutor/workshop.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rt::tutor {

struct CompileError {
    std::string file; ///< as the compiler names it
    int line = 0;
    std::string message; ///< "expected ';' before 'return'"
};

/// Returns the first error that GCC or Clang reports in `log`. An error in a file below `preferred` takes
/// precedence: an error in a learner's file also shows up in files that include it.
std::optional<CompileError> first_error(const std::string& log, const std::string& preferred);

/// A CMake preset of the project; its build folder is build/`name`.
struct Preset {
    std::filesystem::path root;
    std::string name = "release";

    std::filesystem::path folder() const { return root / "build" / name; }
    std::filesystem::path program(const std::string& program) const {
        return folder() / "bin" / (program + program_ending);
    }
};

/// Configures the preset; `again`: even if it is already configured. Throws CommandFailed.
void configure(const Preset& preset, bool again = false);

/// Builds the targets under the lock and prints the time taken unless `quiet`. On failure prints the build's
/// output and throws CommandFailed.
void make(const Preset& preset, const Words& targets, bool quiet = false);

/// Waits while another process links `program` (a path in the folder bin/ of a build), since it cannot
/// be started then.
void wait_for_program(const std::filesystem::path& program);

/// Builds a tool of the project and replaces this process with it.
[[noreturn]] void hand_over(const Preset& preset, const std::string& tool, const Words& arguments);

} // namespace rt::tutor
