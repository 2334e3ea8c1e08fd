// What a step's program and the page tell each other: the functions that one side calls and the other has.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#define RT_PAGE_HAS(name) __attribute__((import_module("page"), import_name(#name)))
#define RT_PAGE_CALLS(name) extern "C" __attribute__((export_name(#name), used))

extern "C" {
RT_PAGE_HAS(declare) void page_declare(const char* json, std::size_t size);
/// Ends main(): the scene stays on the stack, and the page asks for tiles of it.
[[noreturn]] RT_PAGE_HAS(ready) void page_ready();
[[noreturn]] RT_PAGE_HAS(fail) void page_fail(const char* message, std::size_t size);
}

namespace rt::page {

/// Returns a file that the page has handed over. Throws Error if it has not.
std::span<const char> file(const std::string& name);

} // namespace rt::page
