// Vectors of millions: on whole cache lines and, where the system has them, in huge pages, since a ray that
// looks anywhere in 200 MB otherwise spends its time on finding pages.
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace rt {

/// Memory on a border of 128 bytes; from 1 MB on, of 2 MB, in whole huge pages if the system gives any. Throws
/// std::bad_alloc.
void* big_allocate(std::size_t bytes);
void big_free(void* memory, std::size_t bytes) noexcept;

template <typename T>
struct BigAllocator {
    using value_type = T;
    static_assert(alignof(T) <= 128);
    BigAllocator() = default;
    template <typename U>
    BigAllocator(const BigAllocator<U>&) noexcept {}

    T* allocate(std::size_t count) {
        if (count > std::size_t(-1) / sizeof(T)) throw std::bad_alloc();
        return static_cast<T*>(big_allocate(count * sizeof(T)));
    }
    void deallocate(T* memory, std::size_t count) noexcept { big_free(memory, count * sizeof(T)); }

    /// resize() leaves numbers as they are: whoever asks for millions writes each of them soon.
    template <typename U>
    void construct(U* place) noexcept(std::is_nothrow_default_constructible_v<U>) {
        ::new (static_cast<void*>(place)) U;
    }
    template <typename U, typename... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
    }
    template <typename U>
    bool operator==(const BigAllocator<U>&) const noexcept {
        return true;
    }
};

/// A std::vector whose resize() does not clear what it adds.
template <typename T>
using BigVector = std::vector<T, BigAllocator<T>>;

} // namespace rt
