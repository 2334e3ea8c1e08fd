// Runs work in parallel. The caller says what is independent and never handles threads.
#pragma once

#include <cstddef>
#include <functional>

namespace rt {

/// Sets the number of threads used by the functions below, including the caller; 0 = usable_cores(). Call
/// once, before any work.
void set_thread_count(int count);

/// Calls both functions, in any order or in parallel. Either may call parallel_invoke() again. An exception
/// of one is rethrown here once neither is running; the other function may then never have started.
void parallel_invoke(const std::function<void()>& first, const std::function<void()>& second);

/// Divides 0 to count - 1 into ranges of at least `grain_size` numbers (1 or more) and calls work(begin, end)
/// for each, in any order or in parallel.
void parallel_for(std::size_t count, std::size_t grain_size,
                  const std::function<void(std::size_t begin, std::size_t end)>& work);

} // namespace rt
