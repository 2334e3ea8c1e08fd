// bench_convergence: how fast the error of step 08's pictures falls, for each way to look for light and each
// sampler, against a converged picture. The book-style path tracer that it compares with bounces uniformly
// over the hemisphere, with plain random numbers, never asks a lamp and plays no roulette.
#include "07_antialias/filter.h"
#include "08_indirect/program/cornell.h"
#include "08_indirect/radiance.h"
#include "08_indirect/program/room.h"
#include "08_indirect/scene.h"
#include "common/util/report_error.h"
#include "common/util/file_bytes.h"
#include "common/render/render.h"
#include "tools/bench/convergence.h"
#include "common/util/json.h"
#include "tools/bench/svg.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace rt::bench {

struct Wish {
    std::vector<std::string> scenes{"cornell", "room"};
    int size = 128, most = 256, truth = 4096, repeats = 2;
    std::string json, plots;
    bool quick = false;
};

/// A way to look for light, under the name that the table and the plot give it.
struct Estimator {
    const char* name;
    PathSettings settings;
    int colour;
};

const std::vector<Estimator> estimators{{"MIS", {}, 0},
                                        {"lights", {.direct = DirectLighting::light_sampling}, 2},
                                        {"bounces", {.direct = DirectLighting::bsdf_sampling}, 4},
                                        {"book",
                                         {.direct = DirectLighting::bsdf_sampling,
                                          .roulette = false,
                                          .hemisphere_sampling = HemisphereSampling::uniform},
                                         1}};

const std::vector<std::string> samplers{"random", "stratified", "sobol"}; // as SamplerKind counts them

/// A scene before its camera, and the picture that all others should become.
struct Subject {
    std::string name;
    Scene scene;
    AreaLights lights;
    Camera camera;
    Image truth;
};

/// Of this whole program, over all threads. (std::clock does not count past 36 minutes everywhere.)
double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

Image shoot(const Subject& subject, const PathSettings& settings, SamplerKind kind, int samples,
            std::uint64_t seed, int threads) {
    RenderSettings picture;
    picture.width = int(subject.camera.resolution.x);
    picture.height = int(subject.camera.resolution.y);
    picture.samples = samples;
    picture.seed = seed;
    picture.threads = threads;
    return render(picture,
                  [&](const PixelSample& sample) {
                      Sampler sampler(kind, sample);
                      const vec2 point = film_point(sample, sampler, Filter::gaussian, 1);
                      return radiance(subject.scene, subject.lights, settings,
                                      camera_ray(subject.camera, point), sampler);
                  })
        .mean;
}

// ---- the converged picture ----

std::string_view bytes_of(const Image& image) {
    return {reinterpret_cast<const char*>(image.pixels.data()), image.pixels.size() * sizeof(vec3)};
}

/// Renders the truth, or reads it from the build folder, where it stands under a name that changes with all
/// that it depends on: a coarse picture by the same code is part of the key.
void find_truth(Subject& subject, int samples) {
    const Image coarse = shoot(subject, {}, SamplerKind::sobol, 4, 1, 0);
    std::uint64_t key = mix64(std::uint64_t(samples));
    for (const char byte : bytes_of(coarse)) key = mix64(key ^ std::uint8_t(byte));
    char name[64];
    std::snprintf(name, sizeof name, "-%016llx.raw", static_cast<unsigned long long>(key));
    const std::string path = (std::filesystem::path(RT_OUT) / (subject.name + name)).string();
    subject.truth = coarse;
    const std::size_t size = bytes_of(coarse).size();
    if (std::filesystem::exists(path)) {
        const std::string found = read_file(path, size);
        if (found.size() == size) {
            std::memcpy(subject.truth.pixels.data(), found.data(), size);
            return;
        }
    }
    std::printf("%s: rendering the converged picture, %d samples a pixel\n", subject.name.c_str(), samples);
    std::fflush(stdout);
    subject.truth = shoot(subject, {}, SamplerKind::sobol, samples, 1'000'003, 0);
    std::filesystem::create_directories(RT_OUT);
    write_file(path, bytes_of(subject.truth));
}

Subject make_subject(const std::string& name, const Wish& wish) {
    Subject subject{name, {}, {}, {}, {}};
    const LookAt look_at = name == "cornell" ? cornell(subject.scene) : room(subject.scene);
    build_bvhs(subject.scene);
    subject.lights = collect_area_lights(subject.scene);
    subject.camera = make_camera(look_at, wish.size, wish.size);
    find_truth(subject, wish.truth);
    return subject;
}

// ---- measuring ----

double squared_error(const Image& got, const Image& truth) {
    double sum = 0;
    for (std::size_t i = 0; i < got.pixels.size(); ++i) {
        const glm::dvec3 error(got.pixels[i] - truth.pixels[i]);
        sum += dot(error, error) / 3;
    }
    return sum / double(got.pixels.size());
}

/// A few pixels that were hit by a rare bright path must not decide: the worst thousandth is left out.
double relative_error(const Image& got, const Image& truth) {
    double mean = 0;
    for (const vec3 pixel : truth.pixels) mean += double(luminance(pixel)) / double(truth.pixels.size());
    std::vector<double> errors;
    for (std::size_t i = 0; i < got.pixels.size(); ++i) {
        const double want = double(luminance(truth.pixels[i]));
        const double error = (double(luminance(got.pixels[i])) - want) / (want + 0.1 * mean);
        errors.push_back(error * error);
    }
    std::ranges::sort(errors);
    errors.resize(errors.size() - errors.size() / 1000);
    double sum = 0;
    for (const double error : errors) sum += error;
    return sum / double(errors.size());
}

/// Few samples are soon rendered, so they are repeated more often, with a seed each.
Convergence measure(const Subject& subject, const Estimator& estimator, SamplerKind kind, int samples,
                    int repeats) {
    Convergence result{samples, 0, 0, 0};
    for (int i = 0; i < repeats; ++i) {
        const double start = processor_seconds();
        const Image got = shoot(subject, estimator.settings, kind, samples, std::uint64_t(i + 1), 1);
        result.seconds += (processor_seconds() - start) / repeats;
        result.rmse += squared_error(got, subject.truth) / repeats;
        result.relative += relative_error(got, subject.truth) / repeats;
    }
    result.rmse = std::sqrt(result.rmse);
    return result;
}

Series measure(const Subject& subject, const Estimator& estimator, SamplerKind kind, const Wish& wish) {
    Series series{subject.name, estimator.name, samplers[std::size_t(kind)], {}};
    for (int samples = 1; samples <= wish.most; samples *= 2)
        series.points.push_back(measure(subject, estimator, kind, samples,
                                        std::max(wish.repeats, std::min(wish.most, 16) / samples)));
    return series;
}

std::vector<Series> measure(const Subject& subject, const Wish& wish) {
    std::vector<Series> all;
    for (const Estimator& estimator : estimators)
        for (std::size_t kind = 0; kind < samplers.size(); ++kind)
            if (kind == 0 || estimator.settings.hemisphere_sampling ==
                                 HemisphereSampling::cosine) // the book knows plain numbers only
                all.push_back(measure(subject, estimator, SamplerKind(kind), wish));
    return all;
}

// ---- the report ----

const Series& find(const std::vector<Series>& all, const std::string& estimator, const std::string& sampler) {
    return *std::ranges::find_if(
        all, [&](const Series& s) { return s.estimator == estimator && s.sampler == sampler; });
}

void print_table(const std::vector<Series>& all, const Wish& wish) {
    std::printf(
        "\n## %s\n\nRoot of the mean squared error at n samples a pixel, %d x %d pixels; in the last columns "
        "the relative\nsquared error without its worst thousandth, which hides rare bright pixels, and the "
        "processor seconds, at %d\nsamples.\n\n"
        "| estimator | sampler    |",
        all.front().scene.c_str(), wish.size, wish.size, all.front().points.back().samples);
    for (const Convergence& point : all.front().points) std::printf(" %7d |", point.samples);
    std::printf(" relative | seconds |\n|-----------|------------|");
    for (std::size_t i = 0; i < all.front().points.size(); ++i) std::printf("--------:|");
    std::printf("---------:|--------:|\n");
    for (const Series& series : all) {
        std::printf("| %-9s | %-10s |", series.estimator.c_str(), series.sampler.c_str());
        for (const Convergence& point : series.points) std::printf(" %7.4f |", point.rmse);
        std::printf(" %8.5f | %7.2f |\n", series.points.back().relative, series.points.back().seconds);
    }
}

/// How many times less time MIS needs to the book's error. Where its first sample is better already, it is at
/// least that much.
void print_speedups(const std::vector<Series>& all) {
    const Series& book = find(all, "book", "random");
    std::printf(
        "\nTimes less time than the book's path tracer to the same error, which the book reaches at n samples"
        "\n(> where one sample is better already):\n\n| MIS with   |");
    for (const Convergence& point : book.points) std::printf(" %6d |", point.samples);
    std::printf("\n|------------|");
    for (std::size_t i = 0; i < book.points.size(); ++i) std::printf("-------:|");
    for (const std::string& sampler : samplers) {
        const Series& ours = find(all, "MIS", sampler);
        std::printf("\n| %-10s |", sampler.c_str());
        for (const Convergence& point : book.points) {
            const auto seconds = time_at_error(ours, point.rmse);
            const bool better = point.rmse > ours.points.front().rmse;
            const double ratio = point.seconds / seconds.value_or(ours.points.front().seconds);
            if (seconds || better)
                std::printf(" %s%5.1f |", better ? ">" : " ", ratio);
            else
                std::printf(" %6s |", "-");
        }
    }
    std::printf("\n");
}

/// The error that each sampler leaves in the time in which random numbers take n samples, as a part of
/// theirs.
void print_equal_time(const std::vector<Series>& all) {
    const Series& random = find(all, "MIS", "random");
    std::printf("\nError with MIS at equal time, over that of n random samples with MIS:\n\n| sampler    |");
    for (const Convergence& point : random.points) std::printf(" %6d |", point.samples);
    std::printf("\n|------------|");
    for (std::size_t i = 0; i < random.points.size(); ++i) std::printf("-------:|");
    for (const std::string& sampler : {samplers[1], samplers[2]}) {
        std::printf("\n| %-10s |", sampler.c_str());
        for (const Convergence& point : random.points)
            if (const auto error = error_at_time(find(all, "MIS", sampler), point.seconds))
                std::printf(" %6.3f |", *error / point.rmse);
            else
                std::printf(" %6s |", "-");
    }
    std::printf("\n");
}

LogPlot plot_of(const std::vector<Series>& all) {
    LogPlot plot{"Error against time: " + all.front().scene,
                 "processor seconds",
                 "error (RMSE of linear radiance)",
                 {}};
    for (const Series& series : all) {
        if (series.sampler == "stratified") continue; // close to Sobol: the table tells them apart
        const auto estimator = std::ranges::find(estimators, series.estimator, &Estimator::name);
        Curve curve{
            series.estimator + ", " + series.sampler, {}, estimator->colour, series.sampler == "random"};
        for (const Convergence& point : series.points) curve.points.emplace_back(point.seconds, point.rmse);
        plot.curves.push_back(curve);
    }
    return plot;
}

std::vector<std::string> json_of(const std::vector<Series>& all) {
    std::vector<std::string> rows;
    for (const Series& series : all)
        for (const Convergence& point : series.points)
            rows.push_back(json::object({{"scene", json::text(series.scene)},
                                         {"estimator", json::text(series.estimator)},
                                         {"sampler", json::text(series.sampler)},
                                         {"samples", json::number(std::int64_t(point.samples))},
                                         {"seconds", json::number(point.seconds)},
                                         {"rmse", json::number(point.rmse)},
                                         {"relative_mse", json::number(point.relative)}}));
    return rows;
}

void run(const Wish& wish) {
    json::write(wish.json, "{}"); // better now than after the work
    std::vector<std::string> rows;
    for (const std::string& name : wish.scenes) {
        const std::vector<Series> all = measure(make_subject(name, wish), wish);
        print_table(all, wish);
        print_speedups(all);
        print_equal_time(all);
        std::fflush(stdout);
        if (!wish.plots.empty()) {
            std::filesystem::create_directories(wish.plots);
            write_file((std::filesystem::path(wish.plots) / ("convergence_" + name + ".svg")).string(),
                       svg(plot_of(all)));
        }
        for (std::string& row : json_of(all)) rows.push_back(std::move(row));
    }
    json::write(wish.json, json::object({{"convergence", json::array(rows)}}));
}

void declare(CLI::App& app, Wish& wish) {
    app.add_option("--scenes", wish.scenes, "cornell, room")
        ->delimiter(',')
        ->check(CLI::IsMember({"cornell", "room"}));
    app.add_option("--size", wish.size, "side of the pictures in pixels")->check(CLI::Range(4, 2048));
    app.add_option("--most", wish.most, "samples a pixel at most")->check(CLI::Range(2, 65536));
    app.add_option("--truth", wish.truth, "samples a pixel of the converged picture")
        ->check(CLI::Range(2, 1 << 20));
    app.add_option("--repeats", wish.repeats, "pictures of each kind, at least")->check(CLI::Range(1, 1000));
    app.add_option("--json", wish.json, "a file for the numbers");
    app.add_option("--plots", wish.plots, "a folder for the plots; that of --json if not given");
    app.add_flag("--quick", wish.quick, "small pictures and few samples: does it run?");
}

void settle(CLI::App& app, Wish& wish) {
    if (wish.plots.empty() && !wish.json.empty())
        wish.plots = std::filesystem::absolute(wish.json).parent_path().string();
    if (!wish.quick) return;
    const auto unless = [&](const char* flag, int& value, int quick) {
        if (app.count(flag) == 0) value = quick;
    };
    unless("--size", wish.size, 32);
    unless("--most", wish.most, 16);
    unless("--truth", wish.truth, 256);
    unless("--repeats", wish.repeats, 1);
}

} // namespace rt::bench

int main(int argc, char** argv) {
    rt::bench::Wish wish;
    CLI::App app("Error against time of step 08, for each way to look for light and each sampler.",
                 "bench_convergence");
    rt::bench::declare(app, wish);
    try {
        app.parse(argc, argv);
        rt::bench::settle(app, wish);
        rt::bench::run(wish);
        return 0;
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const std::exception& problem) {
        return rt::report_error("bench_convergence", problem.what());
    }
}
