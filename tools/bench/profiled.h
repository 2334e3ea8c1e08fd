// Profiles a step's program: this header is forced in front of its main.cpp, which is not changed. Queries of its
// scene note what the program is doing, and a second thread samples that every 50 microseconds.
// The program must render with one thread. At its end it prints a line "shares" with the shares of making the
// scene, building, traversal and shading. RT_SCENE is the scene.h that it uses, RT_STEP its number.
#pragma once

#include RT_SCENE

#include "01_spheres/program/counted.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <optional>
#include <thread>
#include <utility>

namespace rt {
namespace bench {

/// The program makes its scene until the first ray; from then on, all that is not traversal is shading.
enum Phase { making_scene, building, traversing, shading };

inline std::atomic<Phase> phase = making_scene;

inline void set_phase(Phase now) {
    std::atomic_signal_fence(std::memory_order_seq_cst); // the compiler moves no memory access across
    phase.store(now, std::memory_order_relaxed);
    std::atomic_signal_fence(std::memory_order_seq_cst);
}

/// Calls `work` in the phase `during`, and sets the phase to `next` after it.
auto in_phase(Phase during, Phase next, const auto& work) {
    set_phase(during);
    const auto result = work();
    set_phase(next);
    return result;
}

class Profiler {
  public:
    ~Profiler() {
        stop = true;
        thread.join();
        double total = 0;
        for (const double count : counts) total += count;
        std::printf("shares");
        for (const double count : counts) std::printf(" %.5f", count / std::max(total, 1.0));
        std::printf("\n");
    }

  private:
    /// Counts shading only when another ray has followed: after the last one, files are written.
    void sample() {
        double pending = 0;
        while (!stop) {
            std::this_thread::sleep_for(std::chrono::microseconds(50));
            const Phase now = phase.load(std::memory_order_relaxed);
            ++(now == shading ? pending : counts[now]);
            if (now != shading) counts[shading] += std::exchange(pending, 0);
        }
    }

    std::array<double, 4> counts{}; ///< by phase
    std::atomic<bool> stop = false;
    std::thread thread{[this] { sample(); }};
};

inline Profiler profiler;

} // namespace bench

// The program's scene is a Counted<Scene>: functions for that very type are better matches than templates.

inline std::optional<Hit> intersect(const Counted<Scene>& scene, const Ray& ray) {
    return bench::in_phase(bench::traversing, bench::shading, [&] { return intersect<Scene>(scene, ray); });
}

#if RT_STEP >= 2
inline bool occluded(const Counted<Scene>& scene, const Ray& ray) {
    return bench::in_phase(bench::traversing, bench::shading, [&] { return occluded<Scene>(scene, ray); });
}
#endif

#if RT_STEP >= 5
inline void build_bvhs(Counted<Scene>& scene) {
    bench::set_phase(bench::building);
    build_bvhs(static_cast<Scene&>(scene));
    bench::set_phase(bench::making_scene);
}
#endif

} // namespace rt
