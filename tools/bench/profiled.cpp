// A second thread that samples the phase of a step's program every 50 microseconds. The program must render
// with one thread. At its end it prints a line "shares <scene> <build> <traversal> <shading> <samples>" on
// stdout.
#include "tools/bench/phase.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <numeric>
#include <thread>

namespace rt::bench {
namespace {

class Profiler {
  public:
    Profiler() : thread([this] { sample(); }) {}
    ~Profiler() {
        stop = true;
        thread.join();
        const long total = std::accumulate(counts.begin(), counts.end(), 0L);
        std::printf("shares");
        for (const long count : counts) std::printf(" %.5f", total > 0 ? double(count) / double(total) : 0.0);
        std::printf(" %ld\n", total);
    }

  private:
    /// After the last ray files are written: shading counts only when another ray has followed.
    void sample() {
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

const Profiler profiler;

} // namespace
} // namespace rt::bench
