// Facts about parallel work: all of it is done, on no more threads than allowed, and no exception is lost.
#include "common/util/parallel.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace rt;

namespace {

/// Permits `count` threads until the end of its scope.
struct Allowed {
    explicit Allowed(int count) { set_thread_count(count); }
    ~Allowed() { set_thread_count(0); }
    Allowed(const Allowed&) = delete;
    Allowed& operator=(const Allowed&) = delete;
};

/// Nests parallel_invoke() `depth` levels deep and calls `leaf` at each of the 2^depth ends.
void tree_of_invokes(int depth, const std::function<void()>& leaf) {
    if (depth == 0) return leaf();
    parallel_invoke([&] { tree_of_invokes(depth - 1, leaf); }, [&] { tree_of_invokes(depth - 1, leaf); });
}

/// Waits until `flag` is set, ten seconds at most, and returns whether it is.
bool comes(const std::atomic<bool>& flag) {
    for (int i = 0; i < 10000 && !flag; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return flag;
}

/// Returns whether both functions of parallel_invoke() see that the other one has begun.
bool at_the_same_time() {
    std::atomic<bool> first = false, second = false, met_first = false, met_second = false;
    parallel_invoke(
        [&] {
            first = true;
            met_second = comes(second);
        },
        [&] {
            second = true;
            met_first = comes(first);
        });
    return met_first && met_second;
}

} // namespace

TEST_CASE("parallel_invoke() calls both functions even if nested on any number of threads") {
    for (const int threads : {1, 2, 3, 8, 0}) {
        CAPTURE(threads);
        const Allowed allowed(threads);
        std::atomic<int> leaves = 0;
        tree_of_invokes(7, [&] { ++leaves; });
        CHECK_MESSAGE(leaves == 128, "fewer: one of the two calls is lost if no thread is available");
    }
}

TEST_CASE("parallel_invoke() repeatedly runs on two threads at the same time") {
    const Allowed allowed(2);
    CHECK(at_the_same_time());
    CHECK_MESSAGE(at_the_same_time(), "a thread that has finished must become available again");
}

TEST_CASE("no more threads are at work than set_thread_count() permits") {
    for (const int threads : {1, 2, 3}) {
        CAPTURE(threads);
        const Allowed allowed(threads);
        std::atomic<int> at_work = 0, most = 0;
        tree_of_invokes(6, [&] {
            const int now = ++at_work;
            for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) continue;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            --at_work;
        });
        CHECK(most <= threads);
    }
}

TEST_CASE("with set_thread_count(1), all work is done on the calling thread") {
    const Allowed allowed(1);
    const auto own = std::this_thread::get_id();
    int elsewhere = 0, ranges = 0;
    tree_of_invokes(5, [&] { elsewhere += std::this_thread::get_id() != own; });
    parallel_for(1000, 1, [&](std::size_t begin, std::size_t end) {
        elsewhere += std::this_thread::get_id() != own;
        ranges += begin == 0 && end == 1000;
    });
    CHECK(elsewhere == 0);
    CHECK_MESSAGE(ranges == 1, "a single thread must get a single range");
}

TEST_CASE("an exception from either function leaves parallel_invoke() after both have ended, on one thread "
          "and on two") {
    for (const int threads : {1, 2}) {
        for (const bool first_throws : {true, false}) {
            CAPTURE(threads);
            CAPTURE(first_throws);
            const Allowed allowed(threads);
            std::atomic<int> begun = 0, ended = 0;
            const auto slow = [&] {
                ++begun;
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
                ++ended;
            };
            const auto failing = [] { throw std::runtime_error("no more"); };
            const auto call = [&] {
                first_throws ? parallel_invoke(failing, slow) : parallel_invoke(slow, failing);
            };
            CHECK_THROWS_WITH_AS(call(), "no more", std::runtime_error);
            CHECK_MESSAGE(begun == ended, "the other function still writes to the caller's variables");
            if (threads == 2) CHECK(ended == 1);
        }
    }
}

TEST_CASE(
    "an exception from a thread deep within parallel_invoke() reaches the caller and no thread is lost") {
    const Allowed allowed(2);
    for (int i = 0; i < 5; ++i) {
        std::atomic<int> leaves = 0;
        const auto leaf = [&] {
            if (++leaves == 20) throw std::runtime_error("leaf 20");
        };
        CHECK_THROWS_WITH_AS(tree_of_invokes(6, leaf), "leaf 20", std::runtime_error);
    }
    CHECK(at_the_same_time());
}

TEST_CASE("parallel_for() covers each index once for any count on any number of threads") {
    for (const int threads : {1, 2, 5, 0}) {
        const Allowed allowed(threads);
        for (const std::size_t count : {0, 1, 2, 3, 7, 8, 9, 64, 1000, 1001}) {
            for (const std::size_t grain_size : {1, 2, 3, 8, 333, 5000}) {
                std::vector<std::atomic<int>> times(count);
                std::atomic<int> too_small = 0;
                parallel_for(count, grain_size, [&](std::size_t begin, std::size_t end) {
                    too_small += begin >= end || end - begin < std::min(grain_size, count);
                    for (std::size_t i = begin; i < end; ++i) ++times[i];
                });
                CAPTURE(threads);
                CAPTURE(count);
                CAPTURE(grain_size);
                CHECK(std::ranges::all_of(times, [](const auto& time) { return time == 1; }));
                CHECK_MESSAGE(too_small == 0,
                              "a range has at least `grain_size` indices unless there are fewer");
            }
        }
    }
}

TEST_CASE("parallel_for() distributes its ranges between threads") {
    const Allowed allowed(2);
    std::array<std::atomic<bool>, 2> begun{};
    std::atomic<int> met = 0;
    parallel_for(2, 1, [&](std::size_t begin, std::size_t) {
        begun[begin] = true;
        met += comes(begun[1 - begin]);
    });
    CHECK(met == 2);
}
