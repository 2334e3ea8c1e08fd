// Fuzz target for a command line, one word per line: accepted options are in their declared ranges.
#include "common/image/image_file.h"
#include "common/cli/options.h"
#include "tests/fuzz/fuzz.h"
#include "tools/tutor/exercises.h"

#include <cmath>
#include <iostream>

namespace rt::fuzz {

using namespace tutor;

namespace {

enum class Accel { brute, bvh, wide };

/// Silences stdout, because --help prints there.
struct Silence {
    Silence() { std::cout.setstate(std::ios::failbit); }
    ~Silence() { std::cout.clear(); }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;
};

void check_picture(const RenderSettings& settings) {
    require(settings.width >= 1 && settings.width <= max_dimension, "the width is in range");
    require(settings.height >= 1 && settings.height <= max_dimension, "the height is in range");
    require(settings.samples >= 1 && settings.threads >= 0, "there are samples and threads");
    const Crop& crop = settings.crop;
    require(crop.x0 >= 0 && crop.x0 < crop.x1 && crop.x1 <= settings.width,
            "the crop's columns are in the picture");
    require(crop.y0 >= 0 && crop.y0 < crop.y1 && crop.y1 <= settings.height,
            "the crop's rows are in the picture");
    require(!settings.out.empty(), "the picture has a name");
}

} // namespace

void run_options(std::string_view bytes) {
    const std::vector<std::string> lines = lines_of(std::string(bytes));
    std::vector<const char*> words{"prog"};
    for (const std::string& line : lines) words.push_back(line.c_str());
    Options options("prog", "What is this?", {.width = 64, .height = 40, .samples = 4});
    const float& ior = options.option("ior", 1.5f, 1.0f, 2.5f, "index of refraction");
    const int& depth = options.option("depth", 6, 0, 24, "bounces");
    const dvec3& from = options.option("from", vec3(1, 2, 3), "the eye");
    options.file("mesh", "a model");
    options.flag("bare", "no floor");
    const Choice<Accel> accel = options.choice("accel", {"brute", "bvh", "wide"}, Accel::bvh, "the tree");
    const Silence silence;
    bool goes_on = false;
    if (!refusal([&] { goes_on = options.parse(int(words.size()), words.data()); }).empty() || !goes_on)
        return;
    require(ior >= 1 && ior <= 2.5f && depth >= 0 && depth <= 24, "options are in their ranges");
    for (int i = 0; i < 3; ++i) require(std::isfinite(from[i]), "a point is finite");
    require(int(Accel(accel)) >= 0 && int(Accel(accel)) < 3, "a choice is one of the names");
    check_picture(options.settings());
}

} // namespace rt::fuzz
