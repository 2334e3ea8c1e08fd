// Limits the memory that stb_image may allocate, since it trusts the sizes stated in a file.
#pragma once

#include <cstddef>

namespace rt {

/// Memory limits of the current thread. stb_image gets zeroed blocks, so that pixels it does not write are
/// black instead of uninitialised memory, and no block larger than `largest_block`.
struct StbMemory {
    std::size_t largest_block = std::size_t(1) << 17; ///< bytes; enough for reading a header
    bool was_refused = false;                         ///< a larger block was requested
};

inline thread_local StbMemory stb_memory;

} // namespace rt
