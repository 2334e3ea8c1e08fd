// How much memory stb_image may take: it believes what a file says of itself.
#pragma once

#include <cstddef>

namespace rt {

/// Of this thread. stb_image gets blocks of zeros (so that what it leaves out is black, never what lay in
/// memory before), and none that is larger than this.
struct StbMemory {
    std::size_t largest_block = std::size_t(1) << 17; ///< bytes; as much as reading a header takes
    bool was_refused = false;                         ///< a larger block was asked for
};

inline thread_local StbMemory stb_memory;

} // namespace rt
