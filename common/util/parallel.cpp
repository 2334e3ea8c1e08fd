// A pool of threads that wait for work: to start a thread takes a tenth of a millisecond, and in that time a
// tree of a thousand triangles is built.
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

/// The second function of a parallel_invoke(), which owns it until it is done.
struct Task {
    const std::function<void()>& work;
    std::exception_ptr failure = nullptr;
    bool done = false;
};

class Pool {
  public:
    ~Pool() { resize(1); }

    /// Ends all workers if their number changes; the next invoke() starts new ones, one fewer than `threads`.
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

    /// A thread that waits for its task runs others in the meantime, its own one first.
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
    std::condition_variable changed; ///< a task was submitted or is done, or the workers are to end
    std::atomic<unsigned> changes = 0;
    std::deque<Task*> queue; ///< submitted and not yet begun
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

    /// If the system gives fewer threads, these do all of the work.
    void start_workers() {
        try {
            while (int(workers.size()) < max_workers) workers.emplace_back([this] { work(); });
        } catch (const std::system_error&) {
            max_workers = int(workers.size());
        }
    }

    /// The oldest task is usually the largest one.
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

    /// Runs the task without the lock, and marks it as done with it.
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
