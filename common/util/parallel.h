// Work that may be done at the same time: the caller says what is independent, and never sees a thread.
#pragma once

#include <cstddef>
#include <functional>

namespace rt {

/// How many threads all of the calls below may use together, the calling one included; 0: usable_cores().
/// Said once, before any work.
void use_threads(int count);

/// Does both, in any order or at the same time. Either may call both() again. What one of them throws is
/// thrown here, when neither is at work; the other one may then never have begun.
void both(const std::function<void()>& first, const std::function<void()>& second);

/// Cuts 0 to count - 1 into ranges of at least `least` numbers (which is 1 or more) and calls work(begin,
/// end) for each, in any order or at the same time.
void in_ranges(std::size_t count, std::size_t least,
               const std::function<void(std::size_t begin, std::size_t end)>& work);

} // namespace rt
