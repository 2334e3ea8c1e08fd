// Stands for common/cli/program.cpp and common/render/render.cpp: the page asks for samples of tiles, again and again.
#include "common/cli/program.h"

#include "common/image/image.h"
#include "common/render/pixel_sum.h"
#include "common/util/error.h"
#include "site/twins/page.h"

#include <algorithm>
#include <map>
#include <vector>

int step_main(int argc, char** argv); ///< the step's main(), renamed by the build

namespace rt {
namespace {

struct Pixel {
    PixelSum sum;
    bool finite = true;
};

const SampleFunction* radiance = nullptr;
RenderSettings settings;
std::vector<Pixel> pixels;
std::map<std::string, std::vector<char>> files;

void add_sample(int x, int y, int index, Pixel& pixel) {
    PixelSample sample{x, y, index, settings.samples, Random(x, y, index, settings.seed), settings.seed};
    const vec3 value = (*radiance)(sample);
    if (is_finite(value))
        pixel.sum.add(value);
    else
        pixel.finite = false;
}

/// Writes the pixel as common/image/image_file.cpp writes a PNG, and as opaque.
void write_colour(const Pixel& pixel, std::uint8_t* rgba) {
    const vec3 colour = pixel.finite ? pixel.sum.mean() : vec3(1, 0, 1);
    for (int channel = 0; channel < 3; ++channel) {
        const float linear = std::clamp(colour[channel], 0.0f, 1.0f);
        rgba[channel] = std::uint8_t(srgb_from_linear(linear) * 255.0f + 0.5f);
    }
    rgba[3] = 255;
}

} // namespace

/// Calls `body`, which calls render, which leaves main() without returning: nothing is unwound, so the scene stays
/// on the stack, below which the tiles are rendered.
int run_program(Options& options, int argc, const char* const* argv,
                const std::function<void(const RenderFunction& render)>& body, const std::string&) {
    options.parse(argc, argv);
    body([&](const SampleFunction& function) {
        radiance = &function;
        settings = options.settings();
        pixels.assign(std::size_t(settings.width) * std::size_t(settings.height), {});
        page_ready();
    });
    return 0;
}

std::span<const char> page::file(const std::string& name) {
    const auto found = files.find(name);
    if (found == files.end()) throw Error("the page has no file " + name);
    return found->second;
}

} // namespace rt

/// Returns memory for the page to write to.
RT_PAGE_CALLS(allocate) void* allocate(std::size_t bytes) {
    return ::operator new(bytes);
}

/// Makes a file of this size and returns where its bytes go.
RT_PAGE_CALLS(make_file) char* make_file(const char* name, std::size_t bytes) {
    std::vector<char>& file = rt::files[name];
    file.resize(bytes);
    return file.data();
}

/// Runs main() with `count` words, each of which ends with a zero. Does not return if all is well.
RT_PAGE_CALLS(start) void start(char* words, int count) {
    std::vector<char*> argv(std::size_t(count) + 1);
    for (int i = 0; i < count; ++i) {
        argv[std::size_t(i)] = words;
        while (*words++) {
        }
    }
    step_main(count, argv.data());
}

/// Adds the samples begin to end - 1 to the pixels of a tile, and writes their colours so far, row by row.
RT_PAGE_CALLS(add_samples)
void add_samples(int x0, int y0, int x1, int y1, int begin, int end, std::uint8_t* rgba) {
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x, rgba += 4) {
            rt::Pixel& pixel = rt::pixels[std::size_t(y) * std::size_t(rt::settings.width) + std::size_t(x)];
            for (int i = begin; i < end; ++i) rt::add_sample(x, y, i, pixel);
            rt::write_colour(pixel, rgba);
        }
}

/// Returns the number of rays so far.
RT_PAGE_CALLS(rays) double rays() {
    return double(rt::ray_stats.rays);
}
