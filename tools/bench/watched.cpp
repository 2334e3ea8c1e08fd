// A second thread that looks every 50 microseconds at what a step's program is at. The program must render
// with one thread. In the end it prints a line "shares <scene> <build> <traversal> <shading> <samples>" on
// stdout.

#include "tools/bench/phase.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <thread>

namespace rt::bench {

namespace {

class Watcher {
  public:
    Watcher() : thread([this] { watch(); }) {}
    ~Watcher() {
        stop = true;
        thread.join();
        long total = 0;
        for (const long count : counts) total += count;
        const double whole = total > 0 ? double(total) : 1;
        std::printf("shares %.5f %.5f %.5f %.5f %ld\n", double(counts[0]) / whole, double(counts[1]) / whole,
                    double(counts[2]) / whole, double(counts[3]) / whole, total);
    }

  private:
    /// What comes after the last ray is the writing of files: shading counts only once another ray has
    /// followed.
    void watch() {
        long pending = 0;
        while (!stop) {
            std::this_thread::sleep_for(std::chrono::microseconds(50));
            const Phase now = phase.load(std::memory_order_relaxed);
            if (now == Phase::shading) {
                ++pending;
                continue;
            }
            counts[std::size_t(Phase::shading)] += pending;
            pending = 0;
            ++counts[std::size_t(now)];
        }
    }

    std::array<long, 4> counts{};
    std::atomic<bool> stop = false;
    std::thread thread;
};

const Watcher watcher;

} // namespace

} // namespace rt::bench
