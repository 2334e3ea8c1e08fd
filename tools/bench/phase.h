// What a profiled program is doing.
#pragma once

#include <atomic>

namespace rt::bench {

/// The program makes its scene until the first ray; from then on, all that is not traversal is shading.
enum class Phase { scene, build, traversal, shading };

inline std::atomic<Phase> phase = Phase::scene;

/// Sets the phase to `during` while this object lives, and to `next` at its end.
class PhaseScope {
  public:
    PhaseScope(Phase during, Phase next_) : next(next_) { set(during); }
    ~PhaseScope() { set(next); }
    PhaseScope(const PhaseScope&) = delete;
    PhaseScope& operator=(const PhaseScope&) = delete;

  private:
    static void set(Phase now) {
        std::atomic_signal_fence(std::memory_order_seq_cst); // the compiler moves no memory access across
        phase.store(now, std::memory_order_relaxed);
        std::atomic_signal_fence(std::memory_order_seq_cst);
    }
    const Phase next;
};

} // namespace rt::bench
