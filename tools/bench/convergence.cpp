// Measures how fast the error of step 08's images falls, for each light strategy and each sampler.
#include "07_antialias/filter.h"
#include "08_indirect/program/cornell.h"
#include "08_indirect/program/room.h"
#include "08_indirect/radiance.h"
#include "common/render/render.h"
#include "tools/bench/program.h"

namespace rt::bench {
namespace {

struct Options {
    std::vector<std::string> scenes{"cornell", "room"};
    int size = 128, most = 256, truth = 4096, repeats = 2;
};

const Options quick{.size = 32, .most = 16, .truth = 256, .repeats = 1};

/// A light strategy, under the name that the tables and plots give it.
struct Estimator {
    std::string name;
    PathSettings settings;
};

/// "book" is the path tracer with which books begin: uniform directions, random numbers only, no light
/// sampling and no Russian roulette.
const std::vector<Estimator> estimators{{"MIS", {}},
                                        {"lights", {.direct = DirectLighting::light_sampling}},
                                        {"bounces", {.direct = DirectLighting::bsdf_sampling}},
                                        {"book",
                                         {.direct = DirectLighting::bsdf_sampling,
                                          .roulette = false,
                                          .hemisphere_sampling = HemisphereSampling::uniform}}};

const std::vector<std::string> samplers{"random", "stratified", "sobol"}; // in the order of SamplerKind

/// A scene with its camera, and the converged image of it.
struct ReferenceScene {
    std::string name;
    Scene scene{};
    AreaLights lights{};
    Camera camera{};
    Image truth{};
};

Image render_scene(const ReferenceScene& scene, const PathSettings& settings, SamplerKind kind,
                   RenderSettings image) {
    image.width = int(scene.camera.resolution.x);
    image.height = int(scene.camera.resolution.y);
    const auto pixel = [&](const PixelSample& sample) {
        Sampler sampler(kind, sample);
        const Ray ray = camera_ray(scene.camera, film_point(sample, sampler, Filter::gaussian, 1));
        return radiance(scene.scene, scene.lights, settings, ray, sampler);
    };
    return render(image, pixel).mean;
}

ReferenceScene make_reference_scene(const std::string& name, const Options& options) {
    ReferenceScene scene{name};
    const LookAt look_at = name == "cornell" ? cornell(scene.scene) : room(scene.scene);
    build_bvhs(scene.scene);
    scene.lights = collect_area_lights(scene.scene);
    scene.camera = make_camera(look_at, options.size, options.size);
    std::printf("%s: rendering the converged image, %d samples per pixel\n", name.c_str(), options.truth);
    std::fflush(stdout);
    scene.truth = render_scene(scene, {}, SamplerKind::sobol, {.samples = options.truth, .seed = 1'000'003});
    return scene;
}

struct Errors {
    double squared; ///< the mean over all pixels and channels
    double
        relative; ///< the mean of (error / (truth + 1/10 of the image's mean))^2 without its worst thousandth
};

Errors compare(const Image& image, const Image& truth) {
    std::vector<double> luminances, squared, relative;
    for (const vec3 pixel : truth.pixels) luminances.push_back(double(luminance(pixel)));
    const double offset = 0.1 * mean(luminances);
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        const dvec3 error(image.pixels[i] - truth.pixels[i]);
        squared.push_back(dot(error, error) / 3);
        const double change = double(luminance(image.pixels[i])) - luminances[i];
        relative.push_back(std::pow(change / (luminances[i] + offset), 2));
    }
    std::ranges::sort(relative); // a few rare bright paths shall not decide
    relative.resize(relative.size() - relative.size() / 1000);
    return {mean(squared), mean(relative)};
}

/// Renders several images, each with another seed: the fewer samples, the more images.
Json measure(const ReferenceScene& scene, const Estimator& estimator, SamplerKind kind, int samples,
             const Options& options) {
    std::vector<double> seconds, squared, relative;
    const int repeats = std::max(options.repeats, std::min(options.most, 16) / samples);
    for (int seed = 1; seed <= repeats; ++seed) {
        const Stopwatch watch;
        const Image image = render_scene(scene, estimator.settings, kind,
                                         {.samples = samples, .threads = 1, .seed = std::uint64_t(seed)});
        seconds.push_back(watch.cpu());
        const Errors errors = compare(image, scene.truth);
        squared.push_back(errors.squared);
        relative.push_back(errors.relative);
    }
    return {{"scene", scene.name},
            {"estimator", estimator.name},
            {"sampler", samplers[std::size_t(kind)]},
            {"samples", samples},
            {"seconds", mean(seconds)},
            {"rmse", std::sqrt(mean(squared))},
            {"relative_mse", mean(relative)}};
}

/// Adds the measurements of a scene to `rows`, and prints a table with a column per number of samples.
void measure(const ReferenceScene& scene, const Options& options, Json& rows) {
    Json errors;
    for (const Estimator& estimator : estimators)
        for (std::size_t kind = 0; kind < (estimator.name == "book" ? 1 : samplers.size()); ++kind) {
            Json row{{"estimator", estimator.name}, {"sampler", samplers[kind]}};
            for (int samples = 1; samples <= options.most; samples *= 2) {
                rows.push_back(measure(scene, estimator, SamplerKind(kind), samples, options));
                row[std::to_string(samples)] = rows.back()["rmse"];
            }
            row["relative"] = rows.back()["relative_mse"];
            row["seconds"] = rows.back()["seconds"];
            errors.push_back(row);
        }
    std::printf(
        "\n## %s\n\nRoot mean squared error (RMSE) at n samples per pixel, %d x %d pixels. In the last "
        "columns, at most samples:\nthe mean squared relative error without its worst thousandth, and "
        "processor seconds.\n\n%s",
        scene.name.c_str(), options.size, options.size, table(errors).c_str());
    std::fflush(stdout);
}

} // namespace
} // namespace rt::bench

int main(int argc, char** argv) {
    using namespace rt::bench;
    Options options;
    CLI::App app("Error against time of step 08, for each light strategy and each sampler.",
                 "bench_convergence");
    const auto set_quick = [&] { options = quick; }; // before the other options change it
    app.add_flag_callback("--quick", set_quick, "small images and few samples: does it run?");
    add_choice(app, "--scenes", options.scenes, options.scenes, "scenes, separated by commas");
    add_number(app, "--size", options.size, 4, 2048, "side of the images in pixels");
    add_number(app, "--most", options.most, 2, 65536, "samples per pixel at most");
    add_number(app, "--truth", options.truth, 2, 1 << 20, "samples per pixel of the converged image");
    add_number(app, "--repeats", options.repeats, 1, 1000, "images of each kind, at least");
    return run_program(app, argc, argv, [&] {
        rt::Json rows;
        for (const std::string& name : options.scenes)
            measure(make_reference_scene(name, options), options, rows);
        return rt::Json{{"convergence", rows}};
    });
}
