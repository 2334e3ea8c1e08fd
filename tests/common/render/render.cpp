// Facts about render(): results independent of the threads, correct averages, and reported errors.
#include "common/render/render.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>

namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

rt::RenderSettings picture(int width, int height, int samples, int threads) {
    rt::RenderSettings wanted;
    wanted.width = width;
    wanted.height = height;
    wanted.samples = samples;
    wanted.threads = threads;
    wanted.crop = {0, 0, width, height};
    return wanted;
}

/// Noise that depends on all fields of a sample, with sums that round.
rt::vec3 noise(rt::PixelSample& sample) {
    const float u = sample.random.get_1d();
    const float v = sample.random.get_1d();
    return {u * float(sample.x) + 0.1f, v / float(sample.y + 1), u * v * float(sample.index)};
}

bool same_bits(const rt::Image& a, const rt::Image& b) {
    return a.width == b.width && a.height == b.height && a.pixels.size() == b.pixels.size() &&
           std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(rt::vec3)) == 0;
}

rt::Image part(const rt::Image& whole, rt::Crop crop) {
    rt::Image piece(crop.x1 - crop.x0, crop.y1 - crop.y0);
    for (int y = crop.y0; y < crop.y1; ++y)
        for (int x = crop.x0; x < crop.x1; ++x) piece(x - crop.x0, y - crop.y0) = whole(x, y);
    return piece;
}

rt::SampleFunction values_by_index(const std::vector<rt::vec3>& values) {
    return [values](rt::PixelSample& sample) { return values[std::size_t(sample.index)]; };
}

/// Renders one pixel with these sample values.
rt::Film film_of(const std::vector<rt::vec3>& values) {
    return rt::render(picture(1, 1, int(values.size()), 1), values_by_index(values));
}

} // namespace

TEST_CASE("a picture has the same bits for 1, 2, 3 and 7 threads") {
    const rt::Film one = rt::render(picture(83, 49, 5, 1), noise);
    for (const int threads : {2, 3, 7, 0}) {
        CAPTURE(threads);
        const rt::Film many = rt::render(picture(83, 49, 5, threads), noise);
        CHECK(same_bits(one.mean, many.mean));
        CHECK(same_bits(one.variance, many.variance));
    }
}

TEST_CASE("a crop has the same bits as that part of the whole, for any threads") {
    rt::RenderSettings wanted = picture(83, 49, 5, 2);
    const rt::Film whole = rt::render(wanted, noise);
    for (const rt::Crop crop : {rt::Crop{13, 7, 60, 41}, {82, 48, 83, 49}, {0, 0, 83, 1}, {5, 0, 6, 49}}) {
        CAPTURE(crop.x0);
        CAPTURE(crop.y0);
        wanted.crop = crop;
        const rt::Film piece = rt::render(wanted, noise);
        CHECK(same_bits(piece.mean, part(whole.mean, crop)));
        CHECK(same_bits(piece.variance, part(whole.variance, crop)));
    }
}

TEST_CASE("another seed gives another picture and the same seed the same picture") {
    rt::RenderSettings wanted = picture(20, 10, 2, 2);
    const rt::Film first = rt::render(wanted, noise);
    CHECK(same_bits(first.mean, rt::render(wanted, noise).mean));
    wanted.seed = 2;
    CHECK_FALSE(same_bits(first.mean, rt::render(wanted, noise).mean));
}

TEST_CASE("every pixel is evaluated once per sample with its coordinates in the whole picture") {
    rt::RenderSettings wanted = picture(40, 30, 3, 2);
    wanted.crop = {17, 11, 38, 29};
    const rt::Film film = rt::render(wanted, [](rt::PixelSample& sample) {
        CHECK(sample.count == 3);
        const rt::Random expected(sample.x, sample.y, sample.index, 1);
        CHECK(rt::Random(expected).bits() == rt::Random(sample.random).bits());
        return rt::vec3(float(sample.x), float(sample.y), float(1 << (4 * sample.index)));
    });
    REQUIRE(film.mean.width == 21);
    REQUIRE(film.mean.height == 18);
    for (int y = 0; y < 18; ++y)
        for (int x = 0; x < 21; ++x)
            CHECK(film.mean(x, y) == rt::vec3(float(x + 17), float(y + 11), (1 + 16 + 256) / 3.0f));
}

TEST_CASE("a picture without a crop is rendered completely") {
    rt::RenderSettings wanted = picture(6, 4, 1, 1);
    wanted.crop = {};
    const rt::Film film = rt::render(wanted, noise);
    CHECK(film.mean.width == 6);
    CHECK(film.mean.height == 4);
}

TEST_CASE("the mean of known samples is their mean") {
    const rt::Film film = film_of({rt::vec3(1, 0, 0.25f), rt::vec3(2, 0, 0.5f), rt::vec3(6, 3, 0)});
    CHECK(film.mean(0, 0) == rt::vec3(3, 1, 0.25f));
}

TEST_CASE("a constant is unchanged to the last bit without variance for any number of samples") {
    const rt::vec3 constant(0.1f, 1 / 3.0f, 12345.678f);
    for (const int samples : {1, 2, 3, 7, 100000}) {
        CAPTURE(samples);
        const rt::Film film =
            rt::render(picture(1, 1, samples, 1), [&](rt::PixelSample&) { return constant; });
        CHECK(film.mean(0, 0) == constant);
        CHECK(film.variance(0, 0) == rt::vec3(0));
    }
}

TEST_CASE("the variance of known samples is the variance of their mean computed by hand") {
    // 1, 2, 4, 9: mean 4, mean of squares 25.5; (25.5 - 16) / 3.
    const rt::Film grey = film_of({rt::vec3(1), rt::vec3(2), rt::vec3(4), rt::vec3(9)});
    CHECK(grey.variance(0, 0).x == doctest::Approx(9.5 / 3).epsilon(1e-6));
    CHECK(grey.variance(0, 0).y == grey.variance(0, 0).x);
    CHECK(grey.variance(0, 0).z == grey.variance(0, 0).x);
    // For luminance: 0.2126 and 0.7152 differ by 0.5026; (0.5026 / 2)^2 / 1.
    const rt::Film colour = film_of({rt::vec3(1, 0, 0), rt::vec3(0, 1, 0)});
    CHECK(colour.variance(0, 0).x == doctest::Approx(0.2513 * 0.2513).epsilon(1e-6));
}

TEST_CASE("the variance is accurate even if the mean is much larger") {
    // Alternately 10000 and 10001: (1/2)^2 / 999. A difference of squares in floats
    // would be lost in rounding.
    const rt::Film film = rt::render(picture(1, 1, 1000, 1), [](rt::PixelSample& sample) {
        return rt::vec3(float(10000 + sample.index % 2));
    });
    CHECK(film.variance(0, 0).x == doctest::Approx(0.25 / 999).epsilon(0.01));
}

TEST_CASE("the variance predicts how much the mean of another seed differs") {
    // The mean of (mean - 1/2)^2 / (variance of the mean) over 4096 pixels: for 16 samples its expectation
    // is 15/13 (Student's t with 15 degrees of freedom) and its deviation about sqrt(2.7 + ...) / 64 <
    // 0.04; 0.2 is 5 deviations.
    const rt::Film film = rt::render(
        picture(64, 64, 16, 2), [](rt::PixelSample& sample) { return rt::vec3(sample.random.get_1d()); });
    double sum = 0;
    for (std::size_t i = 0; i < film.mean.pixels.size(); ++i) {
        const double off = double(film.mean.pixels[i].x) - 0.5;
        sum += off * off / double(film.variance.pixels[i].x);
    }
    CHECK(std::abs(sum / 4096 - 15 / 13.0) < 0.2);
}

TEST_CASE("samples that are not finite are counted and the first is the same for all threads") {
    const auto sick = [](rt::PixelSample& sample) {
        if (sample.x == 70 && sample.y == 5 && sample.index >= 2) return rt::vec3(0, not_a_number, 0);
        if (sample.x == 3 && sample.y == 30) return rt::vec3(rt::infinity, 0, 0);
        if (sample.x == 4 && sample.y == 5 && sample.index == 3) return rt::vec3(0, 0, -rt::infinity);
        return noise(sample);
    };
    const rt::Film healthy = rt::render(picture(83, 49, 4, 1), noise);
    for (const int threads : {1, 2, 3, 7}) {
        CAPTURE(threads);
        const rt::Film film = rt::render(picture(83, 49, 4, threads), sick);
        CHECK(film.invalid_samples == 2 + 4 + 1);
        CHECK(film.first_invalid.x == 4); // row 5 before row 30, column 4 before column 70
        CHECK(film.first_invalid.y == 5);
        CHECK(film.first_invalid.sample == 3);
        for (const rt::vec3 mean : {film.mean(4, 5), film.mean(70, 5), film.mean(3, 30)})
            CHECK((std::isnan(mean.x) && std::isnan(mean.y) && std::isnan(mean.z)));
        CHECK(std::isnan(film.variance(4, 5).x));
        CHECK(film.mean(5, 5) == healthy.mean(5, 5)); // neighbours are unaffected
        CHECK(film.mean(69, 5) == healthy.mean(69, 5));
    }
}

TEST_CASE("a crop reports the first sample that is not finite with its coordinates in the whole picture") {
    rt::RenderSettings wanted = picture(40, 30, 1, 1);
    wanted.crop = {10, 20, 40, 30};
    const rt::Film film = rt::render(wanted, [](rt::PixelSample& sample) {
        return rt::vec3(sample.x == 25 && sample.y > 20 ? not_a_number : 0.0f);
    });
    CHECK(film.invalid_samples == 9);
    CHECK(film.first_invalid.x == 25);
    CHECK(film.first_invalid.y == 21);
    CHECK(film.first_invalid.sample == 0);
}

TEST_CASE("an exception in one of the threads reaches the caller") {
    for (const int threads : {1, 3}) {
        CAPTURE(threads);
        const auto failing = [](rt::PixelSample& sample) -> rt::vec3 {
            if (sample.x == 60 && sample.y == 33) throw std::runtime_error("pixel 60,33");
            return rt::vec3(0);
        };
        CHECK_THROWS_WITH_AS(rt::render(picture(83, 49, 1, threads), failing), "pixel 60,33",
                             std::runtime_error);
    }
}

TEST_CASE("an exception soon ends the work of the other threads") {
    std::atomic<int> asked = 0;
    const auto failing = [&asked](rt::PixelSample& sample) -> rt::vec3 {
        ++asked;
        if (sample.x == 0 && sample.y == 0) throw std::runtime_error("immediately");
        std::this_thread::sleep_for(std::chrono::microseconds(100));
        return rt::vec3(0);
    };
    CHECK_THROWS(rt::render(picture(128, 64, 1, 2), failing));
    CHECK(asked < 128 * 64 / 4);
}

TEST_CASE("the ray statistics are the sum over all threads without earlier counts") {
    rt::ray_stats.rays = 1000; // counted earlier by the calling thread
    for (const int threads : {1, 3}) {
        CAPTURE(threads);
        const rt::Film film = rt::render(picture(83, 49, 2, threads), [](rt::PixelSample& sample) {
            rt::ray_stats.rays += 1;
            rt::ray_stats.box_tests += 3;
            rt::ray_stats.triangle_tests += std::uint64_t(sample.x);
            return rt::vec3(0);
        });
        CHECK(film.ray_stats.rays == 83 * 49 * 2);
        CHECK(film.ray_stats.box_tests == 83 * 49 * 2 * 3);
        CHECK(film.ray_stats.triangle_tests == 82 * 83 / 2 * 49 * 2);
    }
}

TEST_CASE("two threads work at the same time") {
    std::mutex mutex;
    std::set<std::thread::id> seen;
    const auto count = [&] {
        const std::lock_guard lock(mutex);
        seen.insert(std::this_thread::get_id());
        return seen.size();
    };
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    rt::render(picture(64, 64, 1, 2), [&](rt::PixelSample&) { // the first sample waits for the other thread
        while (count() < 2 && std::chrono::steady_clock::now() < end)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return rt::vec3(0);
    });
    CHECK(seen.size() == 2);
}

TEST_CASE("no more threads are started than there are pixels and 0 selects a number") {
    CHECK(rt::thread_count(picture(1, 1, 1, 8)) == 1);
    CHECK(rt::thread_count(picture(3, 1, 1, 8)) == 3);
    CHECK(rt::thread_count(picture(640, 400, 1, 8)) == 8);
    CHECK(rt::thread_count(picture(640, 400, 1, 0)) >= 1);
}

TEST_CASE("progress never decreases and ends at 1; only one of the threads reports it at a time") {
    std::vector<float> shares;
    rt::render(picture(83, 49, 1, 3), noise, [&shares](float share) { shares.push_back(share); });
    REQUIRE(shares.size() > 4);
    for (std::size_t i = 1; i < shares.size(); ++i) CHECK(shares[i] > shares[i - 1]);
    CHECK(shares.front() > 0);
    CHECK(shares.back() == 1);
}
