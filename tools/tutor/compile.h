// Builds what a check needs, and when that fails finds the one line of a compiler's hundred that matters.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace rt {

struct CompileError {
    std::string file; ///< as the compiler names it
    int line = 0;
    std::string message; ///< "expected ';' before 'return'"
};

/// The first error that GCC or Clang reports in `log`, in a file below `preferred` if there is one there: an
/// error in a learner's file also breaks files that include it.
std::optional<CompileError> first_error(const std::string& log, const std::string& preferred);

struct Built {
    bool well = false;
    std::optional<CompileError> error; ///< nothing if it failed in another way
    std::string log;
};

/// Builds the targets in the folder of a configured build, alone (BuildLock); what is said goes to `said`. Calls `first_is_there`, on this thread, as soon as the program
/// bin/`targets[0]` is made anew, or at the end if there was nothing to make; not if anything failed before.
Built build_targets(const std::filesystem::path& build, const std::vector<std::string>& targets,
                    const std::filesystem::path& said, const std::string& preferred,
                    const std::function<void()>& first_is_there = {});

} // namespace rt
