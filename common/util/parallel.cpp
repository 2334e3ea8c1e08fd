// A pool of threads that wait for work.
// Starting a thread takes 0.1 ms, enough time to build a tree of a thousand triangles.
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

/// The second function of a parallel_invoke() call. The call waits until it is done, so the
/// task lives on its stack.
struct Task {
    const std::function<void()>& work;
    std::exception_ptr failure = nullptr;
    bool done = false;
};

class Pool {
  public:
    ~Pool() { resize(1); }

    /// Ends all workers if their number changes; the next invoke() starts `threads` - 1 new ones.
    void resize(int threads) {
        if (max_workers == threads - 1) return;
        {
            const std::lock_guard lock(mutex);
            ending = true;
            ++changes;
        }
        changed.notify_all();
        for (std::thread& worker : workers) worker.join();
        workers.clear();
        ending = false;
        max_workers = threads - 1;
    }

    bool is_serial() const { return max_workers == 0; }

    /// Runs both functions. While the second one is not done, the calling thread runs queued
    /// tasks, the newest first.
    void invoke(const std::function<void()>& first, const std::function<void()>& second) {
        Task task{second};
        submit(task);
        std::exception_ptr failure;
        try {
            first();
        } catch (...) {
            failure = std::current_exception();
        }
        std::unique_lock lock(mutex);
        while (!task.done) {
            if (queue.empty()) {
                wait(lock);
            } else {
                Task& newest = *queue.back();
                queue.pop_back();
                finish(newest, lock);
            }
        }
        if (!failure) failure = task.failure;
        if (failure) std::rethrow_exception(failure);
    }

  private:
    std::mutex mutex;
    std::condition_variable changed; ///< a task was submitted or is done, or the workers must end
    std::atomic<unsigned> changes = 0;
    std::deque<Task*> queue; ///< submitted but not started
    std::vector<std::thread> workers;
    std::atomic<int> max_workers = usable_cores() - 1;
    bool ending = false;

    void submit(Task& task) {
        {
            const std::lock_guard lock(mutex);
            start_workers();
            queue.push_back(&task);
            ++changes;
        }
        changed.notify_one();
    }

    /// Starts the workers. If the system gives fewer threads, those do all the work.
    void start_workers() {
        try {
            while (int(workers.size()) < max_workers) workers.emplace_back([this] { work(); });
        } catch (const std::system_error&) {
            max_workers = int(workers.size());
        }
    }

    /// The loop of a worker. It takes the oldest task, which is usually the largest.
    void work() {
        std::unique_lock lock(mutex);
        while (true) {
            while (!ending && queue.empty()) wait(lock);
            if (ending) return;
            Task& oldest = *queue.front();
            queue.pop_front();
            finish(oldest, lock);
        }
    }

    /// Spins briefly before blocking: waking a thread takes longer than most tasks.
    void wait(std::unique_lock<std::mutex>& lock) {
        const unsigned seen = changes;
        lock.unlock();
        for (int i = 0; i < 200 && changes == seen; ++i) std::this_thread::yield();
        lock.lock();
        if (changes == seen) changed.wait(lock);
    }

    /// Runs the task without the lock, then marks it as done with the lock held.
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

void set_thread_count(int count) {
    pool.resize(count > 0 ? count : usable_cores());
}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
    if (!pool.is_serial()) return pool.invoke(first, second);
    first();
    second();
}

void parallel_for(std::size_t count, std::size_t grain_size,
                  const std::function<void(std::size_t begin, std::size_t end)>& work) {
    const std::function<void(std::size_t, std::size_t)> halve = [&](std::size_t begin, std::size_t end) {
        if (end - begin < 2 * grain_size || pool.is_serial()) return work(begin, end);
        const std::size_t middle = begin + (end - begin) / 2;
        parallel_invoke([&] { halve(begin, middle); }, [&] { halve(middle, end); });
    };
    if (count > 0) halve(0, count);
}

} // namespace rt
