// Facts about stratified samples: their cells tile the square evenly, in a random permutation.
// Seeds are fixed: correct samples exceed the limits of chi-square in one run out of 31,000 or more.
#include "07_antialias/stratified.h"
#include "tests/07_antialias/step.h"
#include "tests/check.h"

#include <algorithm>
#include <array>
#include <vector>

using namespace rt;

namespace {

/// The bounding rectangle of many points of one sample.
struct Cell {
    vec2 low{2}, high{-2};
    float area() const { return (high.x - low.x) * (high.y - low.y); }
    bool meets(const Cell& other) const {
        return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y && other.low.y < high.y;
    }
};

std::vector<Cell> cells_of(int count) {
    std::vector<Cell> cells(static_cast<std::size_t>(count));
    Random random(static_cast<std::uint64_t>(count));
    for (int i = 0; i < count; ++i) {
        Cell& cell = cells[std::size_t(i)];
        for (int repeat = 0; repeat < 300; ++repeat) {
            const vec2 p = stratified_2d(i, count, random);
            cell.low = min(cell.low, p);
            cell.high = max(cell.high, p);
        }
    }
    return cells;
}

} // namespace

// ---- cells

TEST_CASE("each of 1 to 100 stratified samples has its own cell, and all cells have the same area") {
    for (int count = 1; count <= 100; ++count) {
        const std::vector<Cell> cells = cells_of(count);
        float smallest = 2, largest = 0;
        int overlaps = 0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            smallest = std::min(smallest, cells[i].area() * float(count));
            largest = std::max(largest, cells[i].area() * float(count));
            for (std::size_t j = 0; j < i; ++j) overlaps += cells[i].meets(cells[j]);
        }
        INFO("of " << count << " samples, in units of 1 / " << count << ", the smallest cell has area "
                   << smallest << " and the largest " << largest);
        INFO("all areas equal "
             << count
             << ": these are plain random samples, not stratified ones; area 0: no jitter within the cell; "
                "other areas: the cells of this count do not tile the square evenly");
        CHECK(overlaps == 0);
        CHECK(smallest > 0.9f); // 300 points span 1 - 4/301 of a cell on average
        CHECK(largest < 1.001f);
    }
}

TEST_CASE("stratified cells are about as wide as high") {
    for (const int count : {4, 7, 16, 37, 64, 97}) {
        for (const Cell& cell : cells_of(count)) {
            const float shape = (cell.high.x - cell.low.x) / (cell.high.y - cell.low.y);
            INFO("of " << count << " samples one has a cell with width : height = " << shape
                       << ": long thin cells do not resolve edges in one direction");
            CHECK(shape > 1 / 2.6f);
            CHECK(shape < 2.6f);
        }
    }
}

TEST_CASE("no stratified point reaches 1 however many samples a pixel has") {
    // In the last column, the float sum of the column index and the jitter rounds up to the next integer with
    // a probability of 1/32,768 here, and of one in four million at 64 samples.
    const int count = 1 << 20;
    Random random(5);
    int outside = 0;
    for (int repeat = 0; repeat < 400'000; ++repeat) {
        const vec2 p = stratified_2d(count - 1, count, random);
        outside += !(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
    }
    CHECK_MESSAGE(
        outside == 0,
        "for a coordinate of 1, box_muller() takes the logarithm of 0: an infinite offset and a NaN ray");
}

TEST_CASE("the points of every sampler are spread evenly over the square") {
    // Pearson's chi-square of 8 x 8 bins with 63 degrees of freedom exceeds 120.6 once in 50,000 runs.
    for (const SamplerKind kind : kinds) {
        std::array<double, 64> bins{};
        const int count = 15, repeats = 4000;
        for (int repeat = 0; repeat < repeats; ++repeat)
            for (int i = 0; i < count; ++i) {
                const vec2 p = first_point(kind, i, count, repeat, 11);
                const int column = std::min(int(p.x * 8), 7), row = std::min(int(p.y * 8), 7);
                bins[std::size_t(row * 8 + column)] += 1;
            }
        const double expected = double(count * repeats) / 64;
        double chi_square = 0;
        for (const double found : bins) chi_square += (found - expected) * (found - expected) / expected;
        INFO(name(kind) << ": beyond the limit, one part of the pixel is sampled more often than another");
        CHECK(chi_square < 120.6);
    }
}

// ---- permutations

TEST_CASE("a permutation reaches every element once for any count and key") {
    for (int count = 1; count <= 200; ++count)
        for (std::uint64_t key = 1; key <= 20; ++key) {
            std::vector<int> visits(std::size_t(count), 0);
            for (int i = 0; i < count; ++i) {
                const int place = permutation_element(i, count, mix64(key));
                REQUIRE(place >= 0);
                REQUIRE(place < count);
                ++visits[std::size_t(place)];
            }
            INFO(count << " places, key " << key
                       << ": two samples share an element and another one is never reached");
            CHECK(*std::max_element(visits.begin(), visits.end()) == 1);
        }
}

TEST_CASE("over the keys, any two samples are sent to any two elements equally often") {
    for (const int count : {2, 3, 4, 5, 7, 8, 12, 16, 30, 64}) {
        const auto n = std::size_t(count);
        std::vector<int> found(n * n, 0);
        const auto first = int(mix64(std::uint64_t(count)) % n);
        const int second = (first + 1) % count;
        for (int key = 0; key < 40 * count * count; ++key) {
            const std::uint64_t bits = mix64(std::uint64_t(key) << 8 | n);
            const auto place = std::size_t(permutation_element(first, count, bits));
            ++found[place * n + std::size_t(permutation_element(second, count, bits))];
        }
        std::vector<int> off_diagonal;
        for (std::size_t i = 0; i < n * n; ++i)
            if (i / n != i % n) off_diagonal.push_back(found[i]);
        INFO(count << " places: z = " << unevenness(off_diagonal)
                   << "; there are too few different permutations");
        CHECK(unevenness(off_diagonal) < 4);
    }
}
