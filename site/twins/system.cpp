// What the trees ask of the operating system: in a browser, nothing.
#include "common/util/system.h"

namespace rt {

void use_huge_pages(void*, std::size_t) noexcept {}

} // namespace rt
