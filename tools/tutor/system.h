// What the tutor asks of the operating system beyond common/util/system.h: processes, a lock, keys. Implemented once for
// each system: system_posix.cpp and system_windows.cpp.
#pragma once

#include "common/util/paths.h"
#include "common/util/system.h"

#include "tools/tutor/util.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

namespace rt::tutor {

/// Where the output of a program goes, and its limits.
struct ProcessOptions {
    std::filesystem::path log;     ///< file for stdout and stderr, or /dev/null; empty: those of this process
    bool append = false;           ///< appends to the log
    std::string* output = nullptr; ///< if set, receives stdout instead
    bool echo = false;             ///< also prints what `output` receives, immediately
    int cpu_seconds = 0, seconds = 0; ///< limits; 0: no limit
    std::uint64_t memory = 0;         ///< limit in bytes; 0: no limit
};

struct ProcessResult {
    int code = 0;           ///< the exit code; 128 or more: it crashed or was stopped
    bool timed_out = false; ///< a time limit ended it
    double cpu_seconds = 0;
    std::string crash; ///< describes the crash to a learner; empty if there was none
};

/// Runs a program and waits for its end. `command` is its path, or a name to find in PATH, followed by its
/// arguments. Its stdin is empty. Throws Error if it cannot be started, Stop if this program received a
/// stop signal meanwhile.
ProcessResult run_process(const Words& command, const ProcessOptions& options = {});

/// Replaces this process with another program. Throws Error if it cannot be started.
[[noreturn]] void replace_process(const Words& command);

/// Thrown to exit with a code after all cleanup.
struct Stop {
    int code;
};

/// Thrown if a command fails: prints one line and exits with code 1.
struct CommandFailed : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Makes run_process throw Stop on Ctrl-C, TERM and HUP from now on.
void handle_signals();

/// Thrown by run_process after it has stopped a program because of cancel_if.
struct Cancelled {};

/// From now on run_process asks `question`, from any thread, while a program runs, and stops it if the answer is yes.
/// An empty question ends that.
void cancel_if(std::function<bool()> question);

/// Opens a page in the browser and does not wait for it. Returns false if no program here does that.
bool open_page(const std::filesystem::path& page);

/// Exclusive lock on the folder that contains a build, so that only one process builds at a time; ./learn
/// takes it, too. Held until this object or its process ends. Has no effect on file systems without locks.
class BuildLock {
  public:
    /// Waits until the lock is free, and says so on stderr after a second. `build` is a build folder such as
    /// build/release; its parent folder is locked.
    explicit BuildLock(const std::filesystem::path& build);
    ~BuildLock();
    BuildLock(const BuildLock&) = delete;
    BuildLock& operator=(const BuildLock&) = delete;

  private:
    std::intptr_t folder = -1; ///< a file descriptor or handle
};

/// Puts the terminal into a mode in which each key can be read immediately, for the lifetime of this object.
class Keys {
  public:
    Keys();
    ~Keys();
    Keys(const Keys&) = delete;
    Keys& operator=(const Keys&) = delete;

    /// Returns the next key, or nothing after this many milliseconds; 'q' if the input has ended.
    std::optional<char> next(int milliseconds) const;

  private:
    bool changed = false;
};

} // namespace rt::tutor
