// Workers that wait until there is something to do: to start a thread takes a tenth of a millisecond, and in
// that time a tree of a thousand triangles is built.
#include "common/util/parallel.h"

#include "common/util/cores.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace rt {
namespace {

/// The second half of a both(). It lives there, until it is done.
struct Task {
    const std::function<void()>& work;
    std::exception_ptr failure = nullptr;
    bool done = false;
};

class Pool {
  public:
    ~Pool() { allow(1); }

    /// Ends all workers if there are not to be one fewer than `threads`, which the next both() starts.
    void allow(int threads) {
        if (allowed == threads - 1) return;
        {
            const std::lock_guard lock(mutex);
            ending = true;
            ++changes;
        }
        changed.notify_all();
        for (std::thread& worker : workers) worker.join();
        workers.clear();
        ending = false;
        allowed = threads - 1;
    }

    bool alone() const { return allowed == 0; }

    /// Whoever waits for a task does others in the meantime, first of all the one it waits for.
    void both(const std::function<void()>& first, const std::function<void()>& second) {
        Task task{second};
        offer(task);
        std::exception_ptr failure;
        try {
            first();
        } catch (...) {
            failure = std::current_exception();
        }
        std::unique_lock lock(mutex);
        while (!task.done) {
            if (offered.empty()) {
                wait(lock);
            } else {
                Task& newest = *offered.back();
                offered.pop_back();
                finish(newest, lock);
            }
        }
        if (!failure) failure = task.failure;
        if (failure) std::rethrow_exception(failure);
    }

  private:
    std::mutex mutex;
    std::condition_variable changed; ///< there is a new task, or one is done, or the workers are to end
    std::atomic<unsigned> changes = 0;
    std::deque<Task*> offered; ///< and not yet begun
    std::vector<std::thread> workers;
    std::atomic<int> allowed = usable_cores() - 1;
    bool ending = false;

    void offer(Task& task) {
        {
            const std::lock_guard lock(mutex);
            start_workers();
            offered.push_back(&task);
            ++changes;
        }
        changed.notify_one();
    }

    /// Where the system gives fewer threads than allowed, these do it all.
    void start_workers() {
        try {
            while (int(workers.size()) < allowed) workers.emplace_back([this] { work(); });
        } catch (const std::system_error&) {
            allowed = int(workers.size());
        }
    }

    /// The oldest task is the largest one, as a rule.
    void work() {
        std::unique_lock lock(mutex);
        while (true) {
            while (!ending && offered.empty()) wait(lock);
            if (ending) return;
            Task& oldest = *offered.front();
            offered.pop_front();
            finish(oldest, lock);
        }
    }

    /// Waits for a change, for a while awake: to wake up takes as long as many a task.
    void wait(std::unique_lock<std::mutex>& lock) {
        const unsigned seen = changes;
        lock.unlock();
        for (int i = 0; i < 200 && changes == seen; ++i) std::this_thread::yield();
        lock.lock();
        if (changes == seen) changed.wait(lock);
    }

    /// Does the task, and everything around it under the lock.
    void finish(Task& task, std::unique_lock<std::mutex>& lock) {
        lock.unlock();
        try {
            task.work();
        } catch (...) {
            task.failure = std::current_exception();
        }
        lock.lock();
        task.done = true;
        ++changes;
        changed.notify_all();
    }
};

Pool pool;

} // namespace

void use_threads(int count) {
    pool.allow(count > 0 ? count : usable_cores());
}

void both(const std::function<void()>& first, const std::function<void()>& second) {
    if (!pool.alone()) return pool.both(first, second);
    first();
    second();
}

void in_ranges(std::size_t count, std::size_t least,
               const std::function<void(std::size_t begin, std::size_t end)>& work) {
    const std::function<void(std::size_t, std::size_t)> halve = [&](std::size_t begin, std::size_t end) {
        if (end - begin < 2 * least || pool.alone()) return work(begin, end);
        const std::size_t middle = begin + (end - begin) / 2;
        both([&] { halve(begin, middle); }, [&] { halve(middle, end); });
    };
    if (count > 0) halve(0, count);
}

} // namespace rt
