// The program's own operator new and delete: malloc, and a count.

#include "tools/bench/memory.h"

#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>

namespace {

std::atomic<std::int64_t> now = 0, most = 0;

void* counted(void* memory) {
    if (!memory) throw std::bad_alloc();
    const std::int64_t held = now += std::int64_t(malloc_usable_size(memory));
    std::int64_t top = most;
    while (held > top && !most.compare_exchange_weak(top, held)) {
    }
    return memory;
}

void release(void* memory) noexcept {
    if (!memory) return;
    now -= std::int64_t(malloc_usable_size(memory));
    std::free(memory);
}

std::size_t rounded(std::size_t size, std::size_t alignment) {
    return (size + alignment - 1) / alignment * alignment;
}

} // namespace

std::int64_t rt::bench::allocated() {
    return now;
}

std::int64_t rt::bench::peak_allocated(bool restart) {
    const std::int64_t top = most;
    if (restart) most = now.load();
    return top;
}

void* operator new(std::size_t size) {
    return counted(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
    return counted(std::aligned_alloc(std::size_t(alignment), rounded(size, std::size_t(alignment))));
}
void operator delete(void* memory) noexcept {
    release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
    release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
    release(memory);
}
