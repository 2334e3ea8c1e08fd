// Windows. No other file of common includes its headers.
#include "common/util/system.h"

#define WIN32_LEAN_AND_MEAN
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>

#include <atomic>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <io.h>
#include <thread>

namespace rt {
namespace {

HANDLE output(int stream) {
    return GetStdHandle(stream == 1 ? STD_OUTPUT_HANDLE : STD_ERROR_HANDLE);
}

/// Returns the processor time of this process in units of 100 ns.
std::uint64_t processor_time() {
    FILETIME begin, end, kernel, user;
    if (!GetProcessTimes(GetCurrentProcess(), &begin, &end, &kernel, &user)) return 0;
    const auto number = [](const FILETIME& time) {
        return std::uint64_t(time.dwHighDateTime) << 32 | time.dwLowDateTime;
    };
    return number(kernel) + number(user);
}

} // namespace

void prepare_streams() {
    SetConsoleOutputCP(CP_UTF8);
    SetConsoleCP(CP_UTF8);
    for (const int stream : {1, 2}) {
        _setmode(stream, _O_BINARY);
        DWORD mode = 0;
        if (GetConsoleMode(output(stream), &mode))
            SetConsoleMode(output(stream), mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING); // colours
    }
}

bool is_terminal(int stream) {
    return _isatty(stream) != 0;
}

int terminal_columns(int stream) {
    CONSOLE_SCREEN_BUFFER_INFO info{};
    return GetConsoleScreenBufferInfo(output(stream), &info) ? info.srWindow.Right - info.srWindow.Left + 1
                                                             : 0;
}

void print_in_handler(const char* text) noexcept {
    _write(2, text, unsigned(std::strlen(text)));
}

int cores_of_affinity() {
    DWORD_PTR process = 0, machine = 0;
    const bool known = GetProcessAffinityMask(GetCurrentProcess(), &process, &machine) != 0;
    return known ? std::popcount(std::uint64_t(process)) : 0;
}

std::int64_t usable_memory() {
    MEMORYSTATUSEX status{};
    status.dwLength = sizeof status;
    return GlobalMemoryStatusEx(&status) ? std::int64_t(status.ullTotalPhys) : 0;
}

void use_huge_pages(void*, std::size_t) noexcept {} // only for processes with a privilege

// Windows limits jobs, not single processes, so a thread looks at the clock.
void limit_processor_time(int seconds) {
    static std::atomic<std::uint64_t> limit;
    limit = processor_time() + std::uint64_t(1 + seconds) * 10'000'000;
    [[maybe_unused]] static const bool watched = [] {
        std::thread([] {
            while (processor_time() < limit) Sleep(100);
            TerminateProcess(GetCurrentProcess(), 0xc0000044); // STATUS_QUOTA_EXCEEDED
        }).detach();
        return true;
    }();
}

void set_environment(const std::string& name, const std::string& value) {
    _putenv_s(name.c_str(), value.c_str());
}

} // namespace rt
