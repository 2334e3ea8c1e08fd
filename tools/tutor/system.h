// What the tutor asks of the operating system: programs, a lock, the terminal. One .cpp file per system
// implements it.
#pragma once

#include "tools/tutor/util.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

namespace rt::tutor {

/// Where the output of a program goes, and what the program may use.
struct ProcessOptions {
    std::filesystem::path log;        ///< a file for stdout and stderr; empty: they go where ours go
    bool append = false;              ///< to the log
    std::string* output = nullptr;    ///< receives stdout instead
    bool echo = false;                ///< also prints what `output` receives, as it comes
    int cpu_seconds = 0, seconds = 0; ///< limits; 0: none
    std::uint64_t memory = 0;         ///< limit in bytes; 0: none
};

struct ProcessResult {
    int code = 0;           ///< the exit code; 128 and more: a signal ended it
    bool timed_out = false; ///< the limits ended it
    double cpu_seconds = 0;
    std::string crash; ///< what kind of crash it was, for a learner; empty if it was none
};

/// Runs a program to its end: `command` is its path, or a name to look for in PATH, and its arguments. It
/// reads no input. Throws Error if it cannot be started, Stop if this program was told to stop meanwhile.
ProcessResult run_process(const Words& command, const ProcessOptions& options = {});

/// Runs a program in place of this one. Throws Error if it cannot be started.
[[noreturn]] void replace_process(const Words& command);

/// Ends this program with an exit code after everything is cleaned up.
struct Stop {
    int code;
};

/// What was asked for did not work: one line, exit code 1.
struct CommandFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// From now on Ctrl-C, TERM and HUP make run_process throw Stop, and a failing write is an error of that
/// write alone.
void handle_signals();

/// Sets a variable for the programs that are started from now on.
void set_environment(const std::string& name, const std::string& value);

bool is_terminal(int stream); ///< 0: stdin, 1: stdout

/// Only one process builds at a time: an exclusive lock on the folder that holds a build, which ./learn takes
/// too. Held until this object or its process ends. Where the disk has no locks, there is none.
class BuildLock {
  public:
    /// Waits until the lock is free, and says so on stderr after a second. `build` is the folder of a build,
    /// as in build/release: the folder above it is locked.
    explicit BuildLock(const std::filesystem::path& build);
    ~BuildLock();
    BuildLock(const BuildLock&) = delete;
    BuildLock& operator=(const BuildLock&) = delete;

  private:
    std::intptr_t folder = -1; ///< an open file
};

/// A terminal that hands over each key at once, for as long as this lives.
class Keys {
  public:
    Keys();
    ~Keys();
    Keys(const Keys&) = delete;
    Keys& operator=(const Keys&) = delete;

    /// Returns the next key within this many milliseconds; 'q' if the input has ended.
    std::optional<char> next(int milliseconds) const;

  private:
    bool changed = false;
};

} // namespace rt::tutor
