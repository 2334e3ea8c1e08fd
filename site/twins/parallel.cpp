// Stands for common/util/parallel.cpp: a page's program has one thread, which does everything in order.
#include "common/util/parallel.h"

namespace rt {

void set_thread_count(int) {}

void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second) {
    first();
    second();
}

void parallel_for(std::size_t count, std::size_t,
                  const std::function<void(std::size_t begin, std::size_t end)>& work) {
    if (count > 0) work(0, count);
}

} // namespace rt
