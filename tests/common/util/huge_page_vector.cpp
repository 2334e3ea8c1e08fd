// Facts about HugePageVector: its alignment, and that it otherwise behaves like std::vector.
#include "common/util/huge_page_vector.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <new>
#include <utility>
#include <vector>

using namespace rt;

namespace {

constexpr std::size_t mega = std::size_t(1) << 20;

std::size_t beyond(const void* memory, std::size_t alignment) {
    return reinterpret_cast<std::uintptr_t>(memory) % alignment;
}

/// Returns a value that identifies its index.
std::uint32_t mark(std::size_t i) {
    return std::uint32_t(i) * 2654435761u;
}

std::ptrdiff_t count_wrong(const HugePageVector<std::uint32_t>& numbers, std::size_t end) {
    std::ptrdiff_t wrong = 0;
    for (std::size_t i = 0; i < end; ++i) wrong += numbers[i] != mark(i);
    return wrong;
}

} // namespace

TEST_CASE("a HugePageVector is aligned to 64 bytes and from 1 MB on to 2 MB") {
    std::vector<HugePageVector<char>> alive; // all alive, so that each has its own memory
    for (const std::size_t bytes : {std::size_t(1), std::size_t(63), std::size_t(64), std::size_t(65),
                                    std::size_t(1000), std::size_t(4096), mega - 1, mega, 2 * mega,
                                    4 * mega - 1, 4 * mega, 4 * mega + 1, 5 * mega, 8 * mega}) {
        CAPTURE(bytes);
        for (int i = 0; i < 3; ++i) {
            alive.emplace_back(bytes);
            CHECK(beyond(alive.back().data(), 64) == 0);
            if (bytes >= mega) CHECK(beyond(alive.back().data(), 2 * mega) == 0);
        }
    }
}

TEST_CASE("all of a HugePageVector can be written up to its last byte") {
    for (const std::size_t bytes :
         {std::size_t(1), std::size_t(100), mega - 1, mega, 4 * mega - 1, 4 * mega, 7 * mega + 5}) {
        CAPTURE(bytes);
        HugePageVector<unsigned char> bytes_of(bytes);
        std::memset(bytes_of.data(), 0xa5, bytes);
        CHECK(std::ranges::count(bytes_of, 0xa5) == std::ptrdiff_t(bytes));
    }
}

TEST_CASE("resize() of a HugePageVector keeps old elements and does not clear new ones") {
    HugePageVector<std::uint32_t> numbers;
    numbers.resize(1000);
    for (std::size_t i = 0; i < 1000; ++i) numbers[i] = mark(i);
    numbers.resize(10);
    numbers.resize(1000);
    CHECK_MESSAGE(count_wrong(numbers, 1000) == 0,
                  "cleared: a resize to millions of elements costs a second pass");
    numbers.resize(2 * mega); // reallocates: from one alignment to the other
    CHECK(count_wrong(numbers, 1000) == 0);
    numbers.resize(100);
    numbers.shrink_to_fit();
    CHECK(count_wrong(numbers, 100) == 0);
}

TEST_CASE("resize() of a HugePageVector applies the default member initialisers of a type") {
    struct Initial {
        int number = 3;
        float other = -0.5f;
    };
    HugePageVector<Initial> items;
    items.resize(1000);
    CHECK(std::ranges::all_of(items, [](const Initial& i) { return i.number == 3 && i.other == -0.5f; }));
    const HugePageVector<int> sevens(1000, 7);
    CHECK(std::ranges::count(sevens, 7) == 1000);
}

TEST_CASE("push_back() keeps the elements of a HugePageVector while it grows beyond 4 MB") {
    HugePageVector<std::uint32_t> numbers;
    for (std::size_t i = 0; i < 3 * mega; ++i) numbers.push_back(mark(i));
    CHECK(numbers.size() == 3 * mega);
    CHECK(count_wrong(numbers, numbers.size()) == 0);
    const HugePageVector<std::uint32_t> copy = numbers;
    const std::uint32_t* const place = numbers.data();
    const HugePageVector<std::uint32_t> moved = std::move(numbers);
    CHECK(copy == moved);
    CHECK_MESSAGE(moved.data() == place, "a move of 12 MB must not copy them");
}

TEST_CASE("an empty HugePageVector behaves like any other vector") {
    HugePageVector<double> none;
    none.resize(0);
    none.shrink_to_fit();
    CHECK(none.empty());
    CHECK(none.begin() == none.end());
    const HugePageVector<double> copy = none, given(std::size_t(0));
    CHECK(copy == given);
    none.push_back(1.5);
    none.pop_back();
    CHECK(none == copy);
    huge_page_free(huge_page_allocate(0), 0);
}

TEST_CASE("a HugePageVector that exceeds the memory throws std::bad_alloc") {
    HugePageAllocator<double> allocator;
    CHECK_THROWS_AS(allocator.allocate(std::size_t(-1) / sizeof(double) + 1), std::bad_alloc);
}
