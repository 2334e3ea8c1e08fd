// Linux: sched_getaffinity(2) and the CPU quota of control groups, version 2. Other systems: all cores.
#include "common/util/cores.h"

#include "common/util/system.h"
#include "common/util/paths.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace rt {
namespace {

std::string first_line(const std::filesystem::path& path) {
    std::string line;
    std::ifstream stream(path);
    std::getline(stream, line);
    return line;
}

/// Returns the smallest quota, in cores, of this process's control group and its ancestors,
/// or 0 if there is none.
int cores_of_groups() {
    std::string own;
    std::ifstream groups("/proc/self/cgroup");
    while (std::getline(groups, own) && own.rfind("0::/", 0) != 0) {
    } // "0::/outer/inner" is the line of version 2
    if (!groups) return 0;
    const std::filesystem::path root = "/sys/fs/cgroup";
    int least = 0;
    for (std::filesystem::path group = path_of(own.substr(4));; group = group.parent_path()) {
        const int cores = cores_of_quota(first_line(root / group / "cpu.max"));
        if (cores > 0 && (least == 0 || cores < least)) least = cores;
        if (group.empty()) return least;
    }
}

} // namespace

int cores_of_quota(std::string_view cpu_max) {
    long long quota = 0, period = 0;
    const char* const end = cpu_max.data() + cpu_max.size();
    const auto [blank, problem] = std::from_chars(cpu_max.data(), end, quota); // "max" means no limit
    if (problem != std::errc() || blank == end || *blank != ' ') return 0;
    if (std::from_chars(blank + 1, end, period).ec != std::errc() || quota <= 0 || period <= 0) return 0;
    return int(std::min<long long>((quota - 1) / period + 1, 1 << 20));
}

int usable_cores() {
    const int affinity = cores_of_affinity(), quota = cores_of_groups();
    const int allowed = std::max(1, affinity > 0 ? affinity : int(std::thread::hardware_concurrency()));
    return quota > 0 ? std::min(allowed, quota) : allowed;
}

} // namespace rt
