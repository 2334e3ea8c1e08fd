// Counts what operator new hands out, so that a build's memory, and its peak, can be read off.
#pragma once

#include <cstdint>

namespace rt::bench {

/// Bytes that are allocated now.
std::int64_t allocated();

/// The most that were allocated at once since this was last called with `restart`.
std::int64_t peak_allocated(bool restart);

} // namespace rt::bench
