// Stands for the unwinder, which this C++ library lacks: an exception ends the program, and the page gets its message.
#include "site/twins/page.h"

#include <cstdlib>
#include <cstring>
#include <exception>

extern "C" {

void* __cxa_allocate_exception(std::size_t bytes) noexcept {
    return std::malloc(bytes);
}

void __cxa_free_exception(void* memory) noexcept {
    std::free(memory);
}

[[noreturn]] void __cxa_throw(void* thrown, void*, void (*)(void*)) {
    const char* const message = static_cast<std::exception*>(thrown)->what(); // nothing else is thrown
    page_fail(message, std::strlen(message));
}

} // extern "C"
