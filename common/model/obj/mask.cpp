// Cut-outs: turns the alpha channel of an image, or its grey value, into a mask.
#include "common/model/obj/mask.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rt {
namespace {

constexpr int passes = 2; // filtering reads one texel beyond the visible ones

/// Sets `mean` to the mean of the `known` ones among the eight neighbours; returns false if there are none.
bool mean_of_neighbours(const Bitmap& bitmap, const std::vector<bool>& known, int x, int y,
                        std::array<std::uint16_t, 3>& mean) {
    std::array<unsigned, 3> sum{};
    unsigned count = 0;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const int column = (x + dx + bitmap.width) % bitmap.width;
            const int row = (y + dy + bitmap.height) % bitmap.height;
            const std::size_t i = std::size_t(row) * std::size_t(bitmap.width) + std::size_t(column);
            if (!known[i]) continue;
            for (std::size_t c = 0; c < 3; ++c) sum[c] += bitmap.values[3 * i + c];
            ++count;
        }
    }
    for (std::size_t c = 0; c < 3 && count > 0; ++c) mean[c] = std::uint16_t((sum[c] + count / 2) / count);
    return count > 0;
}

/// Extends the known colours by one texel into the holes.
void grow_colours(Bitmap& bitmap, std::vector<bool>& known) {
    std::vector<std::pair<std::size_t, std::array<std::uint16_t, 3>>> found;
    std::array<std::uint16_t, 3> mean{};
    for (int y = 0; y < bitmap.height; ++y) {
        for (int x = 0; x < bitmap.width; ++x) {
            const std::size_t i = std::size_t(y) * std::size_t(bitmap.width) + std::size_t(x);
            if (!known[i] && mean_of_neighbours(bitmap, known, x, y, mean)) found.emplace_back(i, mean);
        }
    }
    for (const auto& [i, value] : found) {
        std::copy(value.begin(), value.end(), bitmap.values.begin() + std::ptrdiff_t(3 * i));
        known[i] = true;
    }
}

} // namespace

Mask mask_of(const Bitmap& bitmap) {
    Mask mask{bitmap.width, bitmap.height, bitmap.opacity};
    for (std::size_t i = 0; bitmap.opacity.empty() && i < bitmap.values.size(); i += 3) {
        const unsigned sum = unsigned(bitmap.values[i]) + bitmap.values[i + 1] + bitmap.values[i + 2];
        mask.opacity.push_back(std::uint16_t(sum / 3));
    }
    const auto is_hole = [](std::uint16_t opacity) { return opacity < half_opaque; };
    return std::any_of(mask.opacity.begin(), mask.opacity.end(), is_hole) ? mask : Mask{};
}

void fill_hidden_colours(Bitmap& bitmap) {
    if (bitmap.opacity.empty()) return;
    std::vector<bool> known(bitmap.opacity.size());
    for (std::size_t i = 0; i < known.size(); ++i) known[i] = bitmap.opacity[i] >= half_opaque;
    for (int pass = 0; pass < passes; ++pass) grow_colours(bitmap, known);
}

} // namespace rt
