// A thread is started whenever fewer than allowed are at work: for tasks of a millisecond and more that is
// cheap enough, and there is no pool to look after.
#include "common/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <system_error>
#include <thread>

namespace rt {
namespace {

int cores() {
    return std::max(1, int(std::thread::hardware_concurrency()));
}

std::atomic<int> spare = cores() - 1; ///< threads that may still be started

/// Holds one of the spare threads, if there is any, for as long as it lives.
class Place {
  public:
    Place() : taken(spare.fetch_sub(1) > 0) {
        if (!taken) ++spare;
    }
    ~Place() {
        if (taken) ++spare;
    }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    explicit operator bool() const { return taken; }

  private:
    bool taken;
};

/// Starts `task` on a thread of its own; where the system gives none, answers false.
bool start(std::thread& thread, const std::function<void()>& task, std::exception_ptr& failure) {
    try {
        thread = std::thread([&] {
            try {
                task();
            } catch (...) {
                failure = std::current_exception();
            }
        });
        return true;
    } catch (const std::system_error&) {
        return false;
    }
}

} // namespace

void use_threads(int count) {
    spare = (count > 0 ? count : cores()) - 1;
}

void both(const std::function<void()>& first, const std::function<void()>& second) {
    const Place place;
    std::thread other;
    std::exception_ptr failure;
    if (!place || !start(other, second, failure)) {
        first();
        second();
        return;
    }
    try {
        first();
    } catch (...) {
        failure = std::current_exception();
    }
    other.join();
    if (failure) std::rethrow_exception(failure);
}

void in_ranges(std::size_t count, std::size_t least,
               const std::function<void(std::size_t begin, std::size_t end)>& work) {
    const std::function<void(std::size_t, std::size_t)> halve = [&](std::size_t begin, std::size_t end) {
        if (end - begin < 2 * least || spare <= 0) return work(begin, end);
        const std::size_t middle = begin + (end - begin) / 2;
        both([&] { halve(begin, middle); }, [&] { halve(middle, end); });
    };
    if (count > 0) halve(0, count);
}

} // namespace rt
