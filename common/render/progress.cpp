// Draws a progress line on a terminal, redrawn after a carriage return; it needs no colour or cursor control.

#include "common/render/progress.h"

#include "common/util/system.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>

namespace rt {

namespace {

/// Returns the usable width of the terminal. The last column stays free: some terminals
/// wrap when it is written.
int columns() {
    const int all = terminal_columns(2);
    return all > 0 ? all - 1 : 79;
}

/// Returns a duration in the form "0:07", "12:30" or "1:02:03".
std::string clock_time(double seconds) {
    const long long whole = (long long)(std::min(seconds, 1e9) + 0.5);
    std::array<char, 32> text{};
    if (whole >= 3600)
        std::snprintf(text.data(), text.size(), "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60,
                      whole % 60);
    else
        std::snprintf(text.data(), text.size(), "%lld:%02lld", whole / 60, whole % 60);
    return text.data();
}

/// Returns as much of bar, percentage and remaining time as fits into `width` characters. The bar is dropped
/// first, the percentage last.
std::string progress_line(float share, double seconds, int width) {
    std::array<char, 8> percent{};
    std::snprintf(percent.data(), percent.size(), "%3d %%", int(share * 100));
    const std::string rest =
        share > 0 ? "  " + clock_time(seconds * (1 - double(share)) / double(share)) + " left" : "";
    std::string line = percent.data();
    if (int(line.size() + rest.size()) <= width) line += rest;
    const int bar = std::min(40, width - 25);
    if (bar >= 10) {
        const int full = int(share * float(bar));
        line = "[" + std::string(std::size_t(full), '#') + std::string(std::size_t(bar - full), '.') + "] " +
               line;
    }
    return int(line.size()) <= width ? line : "";
}

/// Overwrites the current terminal line with `line`.
void draw(std::string line, int width) {
    line.resize(std::size_t(std::max(width, 0)), ' ');
    line = "\r" + line + "\r";
    std::fwrite(line.data(), 1, line.size(), stderr);
    std::fflush(stderr);
}

} // namespace

Progress::Progress(bool quiet)
    : visible(!quiet && is_terminal(1) && is_terminal(2)), start(std::chrono::steady_clock::now()),
      last(start) {}

Progress::~Progress() {
    if (visible) draw("", columns());
}

void Progress::show(float share) {
    const auto now = std::chrono::steady_clock::now();
    if (!visible || now - last < std::chrono::milliseconds(100)) return;
    last = now;
    const int width = columns();
    const double seconds = std::chrono::duration<double>(now - start).count();
    draw(progress_line(std::clamp(share, 0.0f, 1.0f), seconds, width), width);
}

} // namespace rt
