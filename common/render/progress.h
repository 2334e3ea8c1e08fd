// The bar on a terminal: how much is done and how long the rest will take. Silent when nobody is watching.
#pragma once

#include <chrono>

namespace rt {

/// Whether what goes to stderr is read as it comes, by a person.
bool stderr_is_terminal();

/// Draws on stderr, and only if that is a terminal and `quiet` is false. The destructor wipes the line.
class Progress {
  public:
    explicit Progress(bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `share` in [0, 1]; draws at most ten times a second.
    void show(float share);

  private:
    bool visible;
    std::chrono::steady_clock::time_point start;
    std::chrono::steady_clock::time_point last;
};

} // namespace rt
