// Linux, macOS and other POSIX systems. No other file of common includes their headers.
#include "common/util/system.h"

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <unistd.h>

#if defined(__linux__)
#include <sched.h>
#include <sys/mman.h>
#endif

namespace rt {

void prepare_streams() {
    int file = open("/dev/null", O_RDWR);
    while (file >= 0 && file <= 2) file = open("/dev/null", O_RDWR);
    if (file > 2) close(file);
    std::signal(SIGXFSZ, SIG_IGN); // `ulimit -f` then behaves like a full disk
    std::signal(SIGPIPE, SIG_IGN); // `| head -1` must not lose the image
}

bool is_terminal(int stream) {
    return isatty(stream) == 1;
}

int terminal_columns(int stream) {
    winsize size{};
    return is_terminal(stream) && ioctl(stream, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

void print_in_handler(const char* text) noexcept {
    [[maybe_unused]] const auto written = write(2, text, std::strlen(text));
}

int cores_of_affinity() {
#if defined(__linux__)
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return CPU_COUNT(&allowed);
#endif
    return 0;
}

std::int64_t usable_memory() {
    const std::int64_t pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
    const std::int64_t machine = pages > 0 && page > 0 ? pages * page : 0;
    rlimit limit{};
    const bool limited = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur < rlim_t(machine);
    return limited ? std::int64_t(limit.rlim_cur) : machine;
}

void use_huge_pages([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) noexcept {
#if defined(__linux__)
    madvise(memory, bytes, MADV_HUGEPAGE);
#endif
}

void limit_processor_time(int seconds) {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    rlimit limit{};
    getrlimit(RLIMIT_CPU, &limit);
    limit.rlim_cur = rlim_t(used.ru_utime.tv_sec + used.ru_stime.tv_sec + 1 + seconds);
    setrlimit(RLIMIT_CPU, &limit);
}

void set_environment(const std::string& name, const std::string& value) {
    if (value.empty())
        unsetenv(name.c_str());
    else
        setenv(name.c_str(), value.c_str(), 1);
}

} // namespace rt
