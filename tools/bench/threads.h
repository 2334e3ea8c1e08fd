// Threads that start together and share out chunks of work, and how long each of them took.
#pragma once

#include <algorithm>
#include <atomic>
#include <barrier>
#include <chrono>
#include <cstddef>
#include <ctime>
#include <functional>
#include <thread>
#include <vector>

namespace rt::bench {

/// Wall-clock time and processor time.
struct Seconds {
    double wall = 0, cpu = 0;
};

/// The processor time of this thread (CLOCK_THREAD_CPUTIME_ID) or of all threads (CLOCK_PROCESS_CPUTIME_ID).
inline double cpu_seconds(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// Calls work(begin, end) for chunks of [0, size) on `count` new threads. Returns the time from the first
/// beginning to the last end, by the threads' own clocks, and the mean processor time of a thread.
inline Seconds run_threads(int count, std::size_t size,
                           const std::function<void(std::size_t, std::size_t)>& work) {
    using Clock = std::chrono::steady_clock;
    struct Interval {
        Clock::time_point begin, end;
    };
    constexpr std::size_t chunk = 1024;
    std::vector<Interval> intervals(static_cast<std::size_t>(count));
    std::atomic<double> cpu = 0;
    std::atomic<std::size_t> next = 0;
    std::barrier start(count);
    const auto run = [&](Interval& own) {
        start.arrive_and_wait();
        own.begin = Clock::now();
        const double cpu_begin = cpu_seconds(CLOCK_THREAD_CPUTIME_ID);
        for (std::size_t i = next.fetch_add(chunk); i < size; i = next.fetch_add(chunk))
            work(i, std::min(size, i + chunk));
        cpu += (cpu_seconds(CLOCK_THREAD_CPUTIME_ID) - cpu_begin) / count;
        own.end = Clock::now();
    };
    std::vector<std::thread> threads;
    for (Interval& interval : intervals) threads.emplace_back(run, std::ref(interval));
    for (std::thread& thread : threads) thread.join();
    const auto first = std::ranges::min(intervals, {}, &Interval::begin).begin;
    const auto last = std::ranges::max(intervals, {}, &Interval::end).end;
    return {std::chrono::duration<double>(last - first).count(), cpu};
}

} // namespace rt::bench
