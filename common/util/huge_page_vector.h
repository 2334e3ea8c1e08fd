// Vectors for millions of elements, aligned to cache lines and in huge pages where the system has them.
// Without huge pages, random reads in 200 MB spend most of their time on TLB misses.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace rt {

/// Returns memory aligned to 128 bytes; blocks of 1 MB or more are aligned to 2 MB and in whole huge pages,
/// if the system provides them. Throws std::bad_alloc.
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

    /// Does not initialise in resize(): callers write all elements soon after.
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
