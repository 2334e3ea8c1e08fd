// The program's own operator new and delete, which count what they hand out: a build's memory, and its peak,
// can be read off. Included by one source file of a program.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace rt::bench {

inline std::atomic<std::int64_t> allocated_bytes = 0, peak_bytes = 0;

inline void* counted(void* memory) {
    if (!memory) throw std::bad_alloc();
    const std::int64_t now = allocated_bytes += std::int64_t(malloc_usable_size(memory));
    std::int64_t peak = peak_bytes;
    while (now > peak && !peak_bytes.compare_exchange_weak(peak, now)) {
    }
    return memory;
}

inline void release(void* memory) {
    allocated_bytes -= std::int64_t(malloc_usable_size(memory));
    std::free(memory);
}

} // namespace rt::bench

void* operator new(std::size_t size) {
    return rt::bench::counted(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    const auto unit = std::size_t(alignment);
    return rt::bench::counted(std::aligned_alloc(unit, (size + unit - 1) / unit * unit));
}
void operator delete(void* memory) noexcept {
    rt::bench::release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    rt::bench::release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    rt::bench::release(memory);
}
