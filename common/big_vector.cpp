// Where big vectors get their memory.
#include "common/big_vector.h"

#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace rt {
namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t huge_page = std::size_t(2) << 20;

std::size_t border(std::size_t bytes) {
    return bytes < 2 * huge_page ? cache_line : huge_page;
}

} // namespace

void* big_allocate(std::size_t bytes) {
    void* const memory = ::operator new(bytes, std::align_val_t(border(bytes)));
#ifdef __linux__
    // Whole pages only: what lies behind belongs to others.
    if (bytes >= 2 * huge_page) madvise(memory, bytes / huge_page * huge_page, MADV_HUGEPAGE);
#endif
    return memory;
}

void big_free(void* memory, std::size_t bytes) noexcept {
    ::operator delete(memory, std::align_val_t(border(bytes)));
}

} // namespace rt
