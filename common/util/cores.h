// How many cores this program may use, which is often fewer than the machine has.
#pragma once

#include <string_view>

namespace rt {

/// Returns the number of cores that this process may use, at least 1: those of its affinity mask (which
/// `taskset` sets), and no more than the quota of its control groups (which a container has).
int usable_cores();

/// Returns the cores of a control group's file cpu.max, "quota period" in microseconds, rounded up; 0 if it
/// sets no limit or is not such a file.
int cores_of_quota(std::string_view cpu_max);

} // namespace rt
