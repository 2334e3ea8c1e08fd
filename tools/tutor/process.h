// Another program, run to its end: within limits, its output in a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rt {

/// What a program may take; 0: as much as it likes.
struct RunLimits {
    int cpu_seconds = 0;
    int seconds = 0;
    std::uint64_t memory = 0; ///< bytes
};

struct Ended {
    int code = 0;          ///< its exit code; 128 and more: a signal ended it
    bool too_long = false; ///< it was stopped by its limits
};

/// Runs `command`, whose first word is the program's path. What it says goes to `output`, errors too. Throws Error if it
/// cannot be started.
Ended run_process(const std::vector<std::string>& command, const std::filesystem::path& output,
                  const RunLimits& limits = {});

} // namespace rt
