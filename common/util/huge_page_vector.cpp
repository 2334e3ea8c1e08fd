// Allocates the memory of a HugePageVector.
#include "common/util/huge_page_vector.h"

#include "common/util/system.h"

namespace rt {
namespace {

constexpr std::size_t widest_alignment = 128;
constexpr std::size_t huge_page = std::size_t(2) << 20;

bool in_huge_pages(std::size_t bytes) {
    return bytes >= huge_page / 2;
}
std::size_t alignment(std::size_t bytes) {
    return in_huge_pages(bytes) ? huge_page : widest_alignment;
}

} // namespace

void* huge_page_allocate(std::size_t bytes) {
    // Whole huge pages only: otherwise the rest of the last page would belong to other data.
    const std::size_t whole = (bytes + huge_page - 1) / huge_page * huge_page;
    void* const memory =
        ::operator new(in_huge_pages(bytes) ? whole : bytes, std::align_val_t(alignment(bytes)));
    if (in_huge_pages(bytes)) use_huge_pages(memory, whole);
    return memory;
}

void huge_page_free(void* memory, std::size_t bytes) noexcept {
    ::operator delete(memory, std::align_val_t(alignment(bytes)));
}

} // namespace rt
