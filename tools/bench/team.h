// Threads that live on between rounds, start together, and share out chunks of work.
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

/// What one round took: by the clock on the wall, and of a processor's time, the mean over the threads.
struct Seconds {
    double wall = 0;
    double cpu = 0;
};

inline double thread_cpu_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

class Team {
  public:
    using Work = std::function<void(std::size_t begin, std::size_t end)>;

    explicit Team(int count)
        : begin_barrier(count + 1), end_barrier(count + 1), stretches(std::size_t(count)) {
        for (int i = 0; i < count; ++i) threads.emplace_back([this, i] { live(std::size_t(i)); });
    }
    ~Team() {
        work = nullptr;
        begin_barrier.arrive_and_wait();
        for (std::thread& thread : threads) thread.join();
    }
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;

    /// Calls work(begin, end) for chunks of [0, size), on all threads at once.
    Seconds run(std::size_t size, const Work& what) {
        work = &what;
        total = size;
        next = 0;
        begin_barrier.arrive_and_wait();
        end_barrier.arrive_and_wait();
        Clock::time_point first = stretches[0].begin, last = stretches[0].end;
        Seconds seconds;
        for (const Stretch& stretch : stretches) {
            first = std::min(first, stretch.begin);
            last = std::max(last, stretch.end);
            seconds.cpu += stretch.cpu / double(stretches.size());
        }
        seconds.wall = std::chrono::duration<double>(last - first).count();
        return seconds;
    }

  private:
    using Clock = std::chrono::steady_clock;

    /// What a thread did in a round, by its own clock: the caller may wake late.
    struct Stretch {
        Clock::time_point begin, end;
        double cpu = 0;
    };

    void live(std::size_t number) {
        while (true) {
            begin_barrier.arrive_and_wait();
            if (!work) return;
            Stretch& own = stretches[number];
            own.begin = Clock::now();
            own.cpu = -thread_cpu_seconds();
            for (std::size_t i = next.fetch_add(chunk); i < total; i = next.fetch_add(chunk))
                (*work)(i, std::min(total, i + chunk));
            own.cpu += thread_cpu_seconds();
            own.end = Clock::now();
            end_barrier.arrive_and_wait();
        }
    }

    static constexpr std::size_t chunk = 1024;
    std::barrier<> begin_barrier, end_barrier;
    const Work* work = nullptr;
    std::size_t total = 0;
    std::atomic<std::size_t> next = 0;
    std::vector<Stretch> stretches;
    std::vector<std::thread> threads;
};

} // namespace rt::bench
