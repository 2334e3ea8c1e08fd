// Renders tiles on several threads; the image does not depend on their number.
// The reasons: a pixel belongs to one tile, one thread adds its samples in order, and its random numbers are
// keyed by its position in the whole image.

#include "common/render/render.h"

#include "common/image/image_file.h"
#include "common/render/pixel_sum.h"
#include "common/util/cores.h"
#include "common/util/system.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <exception>
#include <limits>
#include <mutex>
#include <system_error>
#include <thread>
#include <tuple>
#include <vector>

namespace rt {

namespace {

/// Returns the side of a tile in pixels. Small images get small tiles, so that no thread works
/// alone for long at the end.
int tile_side(const Crop& crop, int threads) {
    const std::int64_t pixels = std::int64_t(crop.x1 - crop.x0) * (crop.y1 - crop.y0);
    int side = 16;
    while (side > 1 && pixels < std::int64_t(threads) * 8 * side * side) side /= 2;
    return side;
}

/// The crop divided into square tiles, numbered in reading order.
struct Tiles {
    Crop crop;
    int side;

    std::int64_t columns() const { return (crop.x1 - crop.x0 + side - 1) / side; }
    std::int64_t rows() const { return (crop.y1 - crop.y0 + side - 1) / side; }
    std::int64_t count() const { return columns() * rows(); }
    Crop operator[](std::int64_t i) const {
        const int x = crop.x0 + int(i % columns()) * side;
        const int y = crop.y0 + int(i / columns()) * side;
        return {x, y, std::min(x + side, crop.x1), std::min(y + side, crop.y1)};
    }
};

int requested_threads(const RenderSettings& settings) {
    return settings.threads > 0 ? settings.threads : usable_cores();
}

/// Returns the part to render. An empty crop, the initial value of RenderSettings,
/// stands for the whole image.
Crop crop_window(const RenderSettings& settings) {
    const bool empty = settings.crop.x1 == 0 && settings.crop.y1 == 0;
    return empty ? Crop{0, 0, settings.width, settings.height} : settings.crop;
}

Tiles tiles_of(const RenderSettings& settings) {
    const Crop part = crop_window(settings);
    return {part, tile_side(part, requested_threads(settings))};
}

/// The results of one thread besides the pixels.
struct ThreadResult {
    std::uint64_t invalid_samples = 0;
    int y = std::numeric_limits<int>::max(), x = 0, sample = 0; ///< position of the first invalid sample
    RayStats ray_stats;

    void keep_first(int other_y, int other_x, int other_sample) {
        if (std::tie(other_y, other_x, other_sample) < std::tie(y, x, sample))
            std::tie(y, x, sample) = std::tie(other_y, other_x, other_sample);
    }
    ThreadResult& operator+=(const ThreadResult& other) {
        invalid_samples += other.invalid_samples;
        keep_first(other.y, other.x, other.sample);
        ray_stats += other.ray_stats;
        return *this;
    }
};

class RenderJob {
  public:
    RenderJob(const RenderSettings& wanted, const SampleFunction& function,
              const std::function<void(float)>& report)
        : settings(wanted), tiles(tiles_of(wanted)), radiance(function), progress(report) {
        film.mean = Image(tiles.crop.x1 - tiles.crop.x0, tiles.crop.y1 - tiles.crop.y0);
        film.variance = Image(film.mean.width, film.mean.height);
    }

    Film run(int threads);

  private:
    void render_pixel(int x, int y, ThreadResult& found);
    void render_tile(const Crop& tile, ThreadResult& found);
    void finish_tile();
    void work() noexcept;
    void start(std::vector<std::thread>& workers, int threads);

    const RenderSettings& settings;
    const Tiles tiles;
    const SampleFunction& radiance;
    const std::function<void(float)>& progress;
    Film film; ///< every pixel is written by one thread, so the images need no lock
    std::atomic<std::int64_t> next = 0;
    std::mutex mutex; ///< guards the members below
    std::int64_t finished = 0;
    ThreadResult total;
    std::exception_ptr failure;
};

void RenderJob::render_pixel(int x, int y, ThreadResult& found) {
    PixelSum pixel;
    bool finite = true;
    for (int i = 0; i < settings.samples; ++i) {
        PixelSample sample{x, y, i, settings.samples, Random(x, y, i, settings.seed), settings.seed};
        const vec3 value = radiance(sample);
        if (is_finite(value)) {
            pixel.add(value);
        } else {
            finite = false;
            ++found.invalid_samples;
            found.keep_first(y, x, i);
        }
    }
    const vec3 unknown(std::numeric_limits<float>::quiet_NaN());
    const int column = x - tiles.crop.x0, row = y - tiles.crop.y0;
    film.mean(column, row) = finite ? pixel.mean() : unknown;
    film.variance(column, row) = finite ? vec3(pixel.variance()) : unknown;
}

void RenderJob::render_tile(const Crop& tile, ThreadResult& found) {
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) render_pixel(x, y, found);
}

void RenderJob::finish_tile() {
    const std::lock_guard lock(mutex);
    ++finished;
    if (progress) progress(float(double(finished) / double(tiles.count())));
}

// Renders tiles until none are left; runs on each thread. An exception is kept for the caller and makes the
// other threads stop soon.
void RenderJob::work() noexcept {
    ThreadResult found;
    try {
        for (std::int64_t i = next++; i < tiles.count(); i = next++) {
            render_tile(tiles[i], found);
            finish_tile();
        }
    } catch (...) {
        next = tiles.count();
        const std::lock_guard lock(mutex);
        if (!failure) failure = std::current_exception();
    }
    found.ray_stats = ray_stats; // thread-local, starts at zero in a new thread
    const std::lock_guard lock(mutex);
    total += found;
}

/// Starts the threads. If the system gives fewer than requested, those still finish the image.
void RenderJob::start(std::vector<std::thread>& workers, int threads) {
    workers.reserve(std::size_t(threads));
    try {
        while (int(workers.size()) < threads) workers.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
        if (workers.empty()) throw;
    }
}

Film RenderJob::run(int threads) {
    std::vector<std::thread> workers;
    start(workers, threads);
    for (std::thread& worker : workers) worker.join();
    if (failure) std::rethrow_exception(failure);
    film.invalid_samples = total.invalid_samples;
    if (total.invalid_samples > 0) {
        film.first_invalid.x = total.x;
        film.first_invalid.y = total.y;
        film.first_invalid.sample = total.sample;
    }
    film.ray_stats = total.ray_stats;
    return std::move(film);
}

} // namespace

std::string size_error(const Crop& crop) {
    constexpr double bytes_per_pixel = 24; // for the two images of a Film
    const int width = crop.x1 - crop.x0, height = crop.y1 - crop.y0;
    const double needed = bytes_per_pixel * width * height + double(memory_to_write(width, height));
    const double usable = double(usable_memory());
    if (usable == 0 || needed <= usable) return size_error(width, height);
    std::array<char, 128> text{};
    std::snprintf(text.data(), text.size(), "(%d x %d) needs %.1f GB of memory, and %.1f GB are available",
                  width, height, needed * 1e-9, usable * 1e-9);
    return text.data();
}

int thread_count(const RenderSettings& settings) {
    return int(std::min<std::int64_t>(requested_threads(settings), tiles_of(settings).count()));
}

Film render(const RenderSettings& settings, const SampleFunction& radiance,
            const std::function<void(float)>& progress) {
    return RenderJob(settings, radiance, progress).run(thread_count(settings));
}

} // namespace rt
