// A progress bar on a terminal: the finished part and the remaining time. Silent without a terminal.
#pragma once

#include <chrono>

namespace rt {

/// Draws a bar on stderr, unless `quiet` is set or stdout or stderr is not a terminal.
/// The destructor erases it.
class Progress {
  public:
    explicit Progress(bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// Shows the finished part, `share` in [0, 1]. Draws at most ten times per second.
    void show(float share);

  private:
    bool visible;
    std::chrono::steady_clock::time_point start;
    std::chrono::steady_clock::time_point last;
};

} // namespace rt
