// What a watched program is at, and where its time has gone.
#pragma once

#include <atomic>

namespace rt::bench {

/// It makes its scene until the first ray; whatever is not traversal from then on is shading.
enum class Phase { scene, build, traversal, shading };

inline std::atomic<Phase> phase = Phase::scene;

/// The program is at `during` while this lives, and at `after` from then on.
class During {
  public:
    During(Phase during, Phase next) : after(next) { say(during); }
    ~During() { say(after); }
    During(const During&) = delete;
    During& operator=(const During&) = delete;

  private:
    static void say(Phase now) {
        std::atomic_signal_fence(std::memory_order_seq_cst); // the compiler moves no memory access across
        phase.store(now, std::memory_order_relaxed);
        std::atomic_signal_fence(std::memory_order_seq_cst);
    }
    const Phase after;
};

} // namespace rt::bench
