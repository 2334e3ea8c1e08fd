// How many cores this program may use, which is often less than the machine has.
#pragma once

#include <string_view>

namespace rt {

/// Returns the number of cores that this process may use, at least 1: those of its affinity mask (which
/// `taskset` sets), and no more than the quota of its control groups (which a container has).
int usable_cores();

/// Returns the number of cores that a control group's cpu.max allows ("quota period" in microseconds),
/// rounded up; 0 if it sets no limit or cannot be parsed.
int cores_of_quota(std::string_view cpu_max);

} // namespace rt
