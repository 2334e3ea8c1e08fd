// Vectors of millions: on whole cache lines and, where the system has them, in huge pages, since a ray that
// reads anywhere in 200 MB otherwise spends its time on page table misses.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace rt {

/// Returns memory aligned to 128 bytes; from 1 MB on to 2 MB, in whole huge pages if the system gives any.
/// Throws std::bad_alloc.
void* huge_page_allocate(std::size_t bytes);
void huge_page_free(void* memory, std::size_t bytes) noexcept;

template <typename T>
struct HugePageAllocator {
    using value_type = T;
    static_assert(alignof(T) <= 128);
    HugePageAllocator() = default;
    template <typename U>
    HugePageAllocator(const HugePageAllocator<U>&) noexcept {}

    T* allocate(std::size_t count) {
        if (count > std::size_t(-1) / sizeof(T)) throw std::bad_alloc();
        return static_cast<T*>(huge_page_allocate(count * sizeof(T)));
    }
    void deallocate(T* memory, std::size_t count) noexcept { huge_page_free(memory, count * sizeof(T)); }

    /// resize() does not initialise: who asks for millions of numbers writes each of them soon.
    template <typename U>
    void construct(U* address) noexcept(std::is_nothrow_default_constructible_v<U>) {
        ::new (static_cast<void*>(address)) U;
    }
    template <typename U, typename... Arguments>
    void construct(U* address, Arguments&&... arguments) {
        ::new (static_cast<void*>(address)) U(std::forward<Arguments>(arguments)...);
    }
    template <typename U>
    bool operator==(const HugePageAllocator<U>&) const noexcept {
        return true;
    }
};

/// A std::vector whose resize() does not initialise the elements that it adds.
template <typename T>
using HugePageVector = std::vector<T, HugePageAllocator<T>>;

} // namespace rt
