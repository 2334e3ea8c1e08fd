// Facts about cores and memory: what this process may use, not what the machine has.
#include "common/util/cores.h"

#include "common/render/render.h"
#include "common/util/system.h"
#include "tests/posix.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <thread>

TEST_CASE("a control group's quota is the number of cores rounded up") {
    CHECK(rt::cores_of_quota("200000 100000") == 2);
    CHECK(rt::cores_of_quota("150000 100000") == 2);
    CHECK(rt::cores_of_quota("1000 100000") == 1);
    CHECK(rt::cores_of_quota("9223372036854775807 1") > 0);
}

TEST_CASE("a control group with no quota or an invalid one sets no limit") {
    for (const char* const text :
         {"max 100000", "", "100000", "100000 ", "100000 0", "-1 100000", "0 100000", "x"}) {
        CAPTURE(text);
        CHECK(rt::cores_of_quota(text) == 0);
    }
}

TEST_CASE("at least one core may be used and no more than there are") {
    CHECK(rt::usable_cores() >= 1);
    CHECK(rt::usable_cores() <= std::max(1, int(std::thread::hardware_concurrency())));
}

#if defined(__linux__)
TEST_CASE("a process whose memory is limited may use no more than the limit") {
    const std::int64_t machine = rt::usable_memory();
    CHECK(machine > 0);
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_AS, &before) == 0);
    const rlimit less{rlim_t(machine) - 4096, before.rlim_max};
    REQUIRE(setrlimit(RLIMIT_AS, &less) == 0); // like `ulimit -v`
    const std::int64_t limited = rt::usable_memory();
    setrlimit(RLIMIT_AS, &before);
    CHECK(limited == machine - 4096);
}

TEST_CASE("a process that may use one core renders with one thread") {
    cpu_set_t before, one;
    REQUIRE(sched_getaffinity(0, sizeof before, &before) == 0);
    CPU_ZERO(&one);
    for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++i)
        if (CPU_ISSET(i, &before)) CPU_SET(i, &one);
    REQUIRE(sched_setaffinity(0, sizeof one, &one) == 0); // like `taskset -c 0`
    const int cores = rt::usable_cores();
    const int threads = rt::thread_count({.width = 640, .height = 400});
    sched_setaffinity(0, sizeof before, &before);
    CHECK(cores == 1);
    CHECK(threads == 1);
}
#endif
