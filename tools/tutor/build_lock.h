// One builds at a time: the lock of a build's folder, which ./learn takes too.
#pragma once

#include <filesystem>

namespace rt {

/// Held for as long as this lives, or until the process ends, however it ends. Where the disk knows no locks there is none.
class BuildLock {
  public:
    /// Waits until it is free; says so on stderr if that takes more than a second. `build` is the folder of a build, as
    /// build/release: the folder over it is locked.
    explicit BuildLock(const std::filesystem::path& build);
    ~BuildLock();
    BuildLock(const BuildLock&) = delete;
    BuildLock& operator=(const BuildLock&) = delete;

  private:
    int folder = -1; ///< an open file
};

/// Waits while another process links `program`, which stands in the folder bin/ of a build: it cannot be started then.
void await_program(const std::filesystem::path& program);

} // namespace rt
