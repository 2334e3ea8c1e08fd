// Measures how fast the error of step 08's pictures falls, for each light strategy and each sampler, against
// a converged picture. The path tracer of a book, to compare with: bounces uniform over the hemisphere, plain
// random numbers, no light sampling, no Russian roulette.
#include "07_antialias/filter.h"
#include "08_indirect/program/cornell.h"
#include "08_indirect/radiance.h"
#include "08_indirect/program/room.h"
#include "08_indirect/scene.h"
#include "common/render/render.h"
#include "tools/bench/convergence.h"
#include "tools/bench/program.h"
#include "tools/bench/table.h"
#include "tools/bench/threads.h"

#include <algorithm>
#include <cstdio>

namespace rt::bench {

struct ConvergenceOptions {
    std::vector<std::string> scenes{"cornell", "room"};
    int size = 128, most = 256, truth = 4096, repeats = 2;
    std::string json;
    bool quick = false;
};

/// A light strategy, under the name that the tables and plots give it.
struct Estimator {
    const char* name;
    PathSettings settings;
};

const std::vector<Estimator> estimators{{"MIS", {}},
                                        {"lights", {.direct = DirectLighting::light_sampling}},
                                        {"bounces", {.direct = DirectLighting::bsdf_sampling}},
                                        {"book",
                                         {.direct = DirectLighting::bsdf_sampling,
                                          .roulette = false,
                                          .hemisphere_sampling = HemisphereSampling::uniform}}};

const std::vector<std::string> samplers{"random", "stratified", "sobol"}; // as SamplerKind counts them

/// A scene with its camera, and the converged picture of it.
struct ReferenceScene {
    std::string name;
    Scene scene;
    AreaLights lights;
    Camera camera;
    Image truth;
};

Image render_scene(const ReferenceScene& scene, const PathSettings& settings, SamplerKind kind, int samples,
                   std::uint64_t seed, int threads) {
    RenderSettings picture;
    picture.width = int(scene.camera.resolution.x);
    picture.height = int(scene.camera.resolution.y);
    picture.samples = samples;
    picture.seed = seed;
    picture.threads = threads;
    return render(picture,
                  [&](const PixelSample& sample) {
                      Sampler sampler(kind, sample);
                      const vec2 point = film_point(sample, sampler, Filter::gaussian, 1);
                      return radiance(scene.scene, scene.lights, settings, camera_ray(scene.camera, point),
                                      sampler);
                  })
        .mean;
}

ReferenceScene make_reference_scene(const std::string& name, const ConvergenceOptions& options) {
    ReferenceScene scene{name, {}, {}, {}, {}};
    const LookAt look_at = name == "cornell" ? cornell(scene.scene) : room(scene.scene);
    build_bvhs(scene.scene);
    scene.lights = collect_area_lights(scene.scene);
    scene.camera = make_camera(look_at, options.size, options.size);
    std::printf("%s: rendering the converged picture, %d samples per pixel\n", name.c_str(), options.truth);
    std::fflush(stdout);
    scene.truth = render_scene(scene, {}, SamplerKind::sobol, options.truth, 1'000'003, 0);
    return scene;
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

/// The mean squared relative error without its worst thousandth, so that a few rare bright paths do not
/// decide.
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

/// Pictures of few samples are quick, so they are repeated more often, with another seed each.
Convergence measure(const ReferenceScene& scene, const Estimator& estimator, SamplerKind kind, int samples,
                    int repeats) {
    Convergence result{samples, 0, 0, 0};
    for (int i = 0; i < repeats; ++i) {
        const double start = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
        const Image got = render_scene(scene, estimator.settings, kind, samples, std::uint64_t(i + 1), 1);
        result.seconds += (cpu_seconds(CLOCK_PROCESS_CPUTIME_ID) - start) / repeats;
        result.rmse += squared_error(got, scene.truth) / repeats;
        result.relative += relative_error(got, scene.truth) / repeats;
    }
    result.rmse = std::sqrt(result.rmse);
    return result;
}

Series measure(const ReferenceScene& scene, const Estimator& estimator, SamplerKind kind,
               const ConvergenceOptions& options) {
    Series series{scene.name, estimator.name, samplers[std::size_t(kind)], {}};
    for (int samples = 1; samples <= options.most; samples *= 2)
        series.points.push_back(measure(scene, estimator, kind, samples,
                                        std::max(options.repeats, std::min(options.most, 16) / samples)));
    return series;
}

std::vector<Series> measure(const ReferenceScene& scene, const ConvergenceOptions& options) {
    std::vector<Series> all;
    for (const Estimator& estimator : estimators)
        for (std::size_t kind = 0; kind < samplers.size(); ++kind)
            if (kind == 0 || estimator.settings.hemisphere_sampling ==
                                 HemisphereSampling::cosine) // the book knows plain numbers only
                all.push_back(measure(scene, estimator, SamplerKind(kind), options));
    return all;
}

// ---- the tables ----

const Series& find(const std::vector<Series>& all, const std::string& estimator, const std::string& sampler) {
    return *std::ranges::find_if(
        all, [&](const Series& s) { return s.estimator == estimator && s.sampler == sampler; });
}

/// A row of the tables: a value for each number of samples of a series.
Json row(Json begin, const Series& series, const std::function<Json(const Convergence&)>& value) {
    for (const Convergence& point : series.points) begin[std::to_string(point.samples)] = value(point);
    return begin;
}

Json error_rows(const std::vector<Series>& all) {
    Json rows = Json::array();
    for (const Series& series : all) {
        rows.push_back(row({{"estimator", series.estimator}, {"sampler", series.sampler}}, series,
                           [](const Convergence& point) { return point.rmse; }));
        rows.back()["relative"] = series.points.back().relative;
        rows.back()["seconds"] = series.points.back().seconds;
    }
    return rows;
}

/// How many times less time MIS needs to the error of the book; "> ..." where its first sample is better
/// already.
Json speedup_rows(const std::vector<Series>& all) {
    Json rows = Json::array();
    for (const std::string& sampler : samplers) {
        const Series& ours = find(all, "MIS", sampler);
        rows.push_back(
            row({{"MIS with", sampler}}, find(all, "book", "random"), [&](const Convergence& point) {
                const auto seconds = time_at_error(ours, point.rmse);
                const Convergence& first = ours.points.front();
                if (!seconds && point.rmse <= first.rmse) return Json();
                return Json((seconds ? "" : "> ") +
                            formatted("%.1f", point.seconds / seconds.value_or(first.seconds)));
            }));
    }
    return rows;
}

/// The error of each sampler in the time in which random numbers take n samples, divided by the error of
/// these.
Json equal_time_rows(const std::vector<Series>& all) {
    Json rows = Json::array();
    for (const std::string sampler : {"stratified", "sobol"})
        rows.push_back(row({{"sampler", sampler}}, find(all, "MIS", "random"), [&](const Convergence& point) {
            const auto error = error_at_time(find(all, "MIS", sampler), point.seconds);
            return error ? Json(*error / point.rmse) : Json();
        }));
    return rows;
}

void print_tables(const std::vector<Series>& all, const ConvergenceOptions& options) {
    std::printf(
        "\n## %s\n\nRoot mean squared error (RMSE) at n samples per pixel, %d x %d pixels; in the last "
        "columns the "
        "mean squared\nrelative error without its worst thousandth, which hides rare bright pixels, and the "
        "processor seconds, at most\nsamples.\n\n%s",
        all.front().scene.c_str(), options.size, options.size, table(error_rows(all)).c_str());
    std::printf("How many times less time than the book's path tracer to the error of its n samples (> where "
                "one sample is "
                "better already):\n\n%s",
                table(speedup_rows(all)).c_str());
    std::printf("Error with MIS at equal time, divided by that of n random samples with MIS:\n\n%s",
                table(equal_time_rows(all)).c_str());
    std::fflush(stdout);
}

// ---- the program ----

void run(const ConvergenceOptions& options) {
    check_json(options.json);
    Json rows = Json::array();
    for (const std::string& name : options.scenes) {
        const std::vector<Series> all = measure(make_reference_scene(name, options), options);
        print_tables(all, options);
        for (const Series& series : all)
            for (const Convergence& point : series.points)
                rows.push_back({{"scene", series.scene},
                                {"estimator", series.estimator},
                                {"sampler", series.sampler},
                                {"samples", point.samples},
                                {"seconds", point.seconds},
                                {"rmse", point.rmse},
                                {"relative_mse", point.relative}});
    }
    write_json(options.json, {{"convergence", rows}});
}

void declare(CLI::App& app, ConvergenceOptions& options) {
    app.add_option("--scenes", options.scenes, "cornell, room")
        ->delimiter(',')
        ->check(CLI::IsMember({"cornell", "room"}));
    app.add_option("--size", options.size, "side of the pictures in pixels")->check(CLI::Range(4, 2048));
    app.add_option("--most", options.most, "samples per pixel at most")->check(CLI::Range(2, 65536));
    app.add_option("--truth", options.truth, "samples per pixel of the converged picture")
        ->check(CLI::Range(2, 1 << 20));
    app.add_option("--repeats", options.repeats, "pictures of each kind, at least")
        ->check(CLI::Range(1, 1000));
    app.add_flag("--quick", options.quick, "small pictures and few samples: does it run?");
    add_json_option(app, options.json);
}

void apply_quick(const CLI::App& app, ConvergenceOptions& options) {
    set_by_default(app, "--size", options.size, 32);
    set_by_default(app, "--most", options.most, 16);
    set_by_default(app, "--truth", options.truth, 256);
    set_by_default(app, "--repeats", options.repeats, 1);
}

} // namespace rt::bench

int main(int argc, char** argv) {
    rt::bench::ConvergenceOptions options;
    CLI::App app("Error against time of step 08, for each light strategy and each sampler.",
                 "bench_convergence");
    rt::bench::declare(app, options);
    return rt::bench::run_program(app, argc, argv, [&] {
        if (options.quick) rt::bench::apply_quick(app, options);
        rt::bench::run(options);
    });
}
