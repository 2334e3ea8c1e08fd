// Facts about the program compare: its exit code, its output and files, and its one-line errors.
#include "tests/compare/pictures.h"
#include "tests/malformed/png.h"
#include "tests/posix.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>

using namespace rt;
using namespace rt::compare;
using namespace rt::malformed;

namespace {

struct Said {
    int code = 0;
    std::string out, err;
};

/// Runs compare with these words of a shell command.
Said run_compare(const Folder& folder, const std::string& words) {
    const std::string out = folder / "out.txt", err = folder / "err.txt";
    const std::string line = "\"" RT_COMPARE "\" " + words + " >\"" + out + "\" 2>\"" + err + "\"";
#if defined(_WIN32)
    const int code = std::system(("\"" + line + "\"").c_str()); // cmd takes the outer quotes off
#else
    const int status = std::system(line.c_str()), code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
#endif
    return {code, bytes_of(out), bytes_of(err)};
}

/// Checks for one line on stderr that contains all parts, nothing on stdout, and exit code 2.
template <typename... Parts>
void check_refused(const Said& said, const Parts&... parts) {
    CHECK(said.code == 2);
    CHECK(said.out.empty());
    CHECK(said.err.rfind("compare: ", 0) == 0);
    CHECK(said.err.find('\n') == said.err.size() - 1);
    CHECK_ERROR(said.err, parts...);
}

/// A folder with a correct picture and a flipped one.
struct Pictures {
    Folder folder;
    std::string right = folder / "right.hdr", flipped = folder / "flipped.hdr";

    Pictures() {
        write_image(right, lopsided(96, 64));
        write_image(flipped, mirrored(lopsided(96, 64), true, false));
    }
    Said operator()(const std::string& words) const { return run_compare(folder, words); }
};

/// Returns a PNG of 2 x 2 pixels.
std::string tiny_png(int colour_type, std::size_t channels) {
    const std::string row = std::string(1, '\0') + std::string(2 * channels, '\x80');
    return png(2, 2, 8, colour_type, row + row);
}

} // namespace

TEST_CASE("compare exits with 0 for the same picture and with 1 for a different one, and states the reason") {
    const Pictures run;
    const Said same = run(run.right + " " + run.right);
    CHECK(same.code == 0);
    CHECK(same.out == "same picture (largest difference 0, mean 0)\n");
    CHECK(same.err.empty());
    const Said different = run(run.flipped + " " + run.right);
    CHECK(different.code == 1);
    CHECK(different.err.empty());
    CHECK(different.out.rfind("different: ", 0) == 0);
    CHECK_ERROR(different.out, "\nwhere: ", "\nworst pixel: ", "\nFLIP: mean ",
                "\nlikely cause: flipped left to right\n");
    Image nearly = lopsided(96, 64);
    for (int x = 0; x < 40; ++x) nearly(x, 30) += vec3(0.02f);
    write_image(run.folder / "nearly.hdr", nearly);
    const Said look = run(run.folder / "nearly.hdr" + " " + run.right);
    CHECK(look.code == 1);
    CHECK(look.out.rfind("almost the same, look at the map", 0) == 0);
}

TEST_CASE("compare with variances reports only what noise does not explain") {
    const Pictures run;
    const Image wrong = changed(lopsided(96, 64), [](vec3 c) { return c * 1.1f; });
    const std::vector<std::pair<std::string, NoisyPicture>> noisy{
        {"a", {lopsided(96, 64), 1}}, {"b", {lopsided(96, 64), 2}}, {"c", {wrong, 3}}};
    for (const auto& [name, picture] : noisy) {
        write_image(run.folder / (name + ".hdr"), picture.mean);
        write_image(run.folder / (name + "v.hdr"), picture.variance);
    }
    const auto file = [&](const std::string& name) { return run.folder / (name + ".hdr "); };
    const std::string map = run.folder / "map.png";
    const Said noise =
        run(file("a") + file("b") + "--variance-a " + file("av") + "--variance-b " + file("bv"));
    CHECK(noise.code == 0);
    CHECK_ERROR(noise.out, "same picture up to noise (96 tiles");
    const Said different = run(file("c") + file("b") + "--variance-a " + file("cv") + "--variance-b " +
                               file("bv") + "--map " + map + " --json -");
    CHECK(different.code == 1);
    CHECK_ERROR(different.out, "{\"verdict\":\"different\"", "the whole picture times 1.1",
                "\"tiles_over_4\":");
    CHECK(read_image(map).width == 96);
    CHECK(run(file("a") + file("b")).code == 1);
    check_refused(run(file("a") + file("b") + "--variance-a " + file("av")), "--variance-b");
}

TEST_CASE("compare writes its verdict as JSON to a file or to standard output, and the map") {
    const Pictures run;
    const std::string both = run.flipped + " " + run.right, json = run.folder / "verdict.json";
    const Said to_file = run(both + " --json " + json + " --map " + (run.folder / "map.png"));
    CHECK(to_file.code == 1);
    CHECK(to_file.out.rfind("different: ", 0) == 0);
    CHECK_ERROR(bytes_of(json), "{\"verdict\":\"different\",\"explanation\":\"flipped left to right\"");
    const Said to_stdout = run(both + " --json -");
    CHECK(to_stdout.code == 1);
    CHECK(to_stdout.out == bytes_of(json));
    const Image map = read_image(run.folder / "map.png");
    CHECK(map.width == 96);
    CHECK(map.height == 64);
    float brightest = 0;
    for (const vec3& pixel : map.pixels) brightest = std::max(brightest, luminance(pixel));
    CHECK(brightest > 0.05f);
}

TEST_CASE("compare names the matching known picture from a folder") {
    const Pictures run;
    std::filesystem::create_directory(run.folder / "known");
    write_image(run.folder / "known/reflect-plus.hdr", mirrored(lopsided(96, 64), true, false));
    write_image(run.folder / "known/reflect-plus.png", mirrored(lopsided(96, 64), true, false));
    write_image(run.folder / "known/upside-down.png", mirrored(lopsided(96, 64), false, true));
    run.folder.write("known/readme.txt", "not a picture");
    const std::string known = " --known " + (run.folder / "known");
    CHECK_ERROR(run(run.flipped + " " + run.right + known).out, "this is the picture of reflect-plus\n");
    CHECK(run(run.right + " " + run.right + known).code == 0);
    check_refused(run(run.flipped + " " + run.right + " --known " + (run.folder / "nowhere")), "nowhere",
                  "is not a readable folder");
    std::filesystem::create_directory(run.folder / "empty");
    check_refused(run(run.flipped + " " + run.right + " --known " + (run.folder / "empty")),
                  "contains no .hdr");
    write_image(run.folder / "known/small.hdr", Image(8, 8));
    check_refused(run(run.flipped + " " + run.right + known), "known picture small", "8 x 8", "96 x 64");
    run.folder.write("known/small.hdr", "#?RADIANCE\nnot much");
    check_refused(run(run.flipped + " " + run.right + known), "small.hdr");
}

TEST_CASE(
    "compare rejects pictures that are missing, damaged or of different sizes or channels with one line") {
    const Pictures run;
    const Folder& folder = run.folder;
    check_refused(run(folder / "nope.png" + " " + run.right), "nope.png", "no such file");
    check_refused(run(run.right + " " + (folder / "nope.hdr")), "nope.hdr", "no such file");
    write_image(folder / "small.hdr", Image(64, 96));
    check_refused(run(folder / "small.hdr" + " " + run.right), "64 x 96", "96 x 64");
    const std::string whole = bytes_of(run.right);
    const std::string cut = folder.write("cut.hdr", whole.substr(0, whole.size() / 2));
    check_refused(run(cut + " " + run.right), "cut.hdr", "cut short");
    const std::string garbage = folder.write("garbage.png", "\x89PNG and then nothing of use");
    check_refused(run(garbage + " " + run.right), "garbage.png", "damaged");
    check_refused(run(folder.write("empty.png", "") + " " + run.right), "empty.png", "is empty");
    const std::string grey = folder.write("grey.png", tiny_png(0, 1)),
                      rgb = folder.write("rgb.png", tiny_png(2, 3)),
                      alpha = folder.write("alpha.png", tiny_png(6, 4));
    check_refused(run(grey + " " + rgb), "1 channel and 3 channels", "save both as RGB");
    check_refused(run(rgb + " " + alpha), "3 channels and 4 channels");
    CHECK(run(grey + " " + grey).code == 0);
}

TEST_CASE("compare rejects unknown words and unwritable files before it compares") {
    const Pictures run;
    const std::string both = run.flipped + " " + run.right;
    check_refused(run(run.right), "B is required");
    check_refused(run(both + " --fast"), "--fast");
    check_refused(run(both + " --step 9"), "--step");
    check_refused(run(both + " --map " + (run.folder / "map.jpg")), "map.jpg", ".png or .hdr");
    check_refused(run(both + " --map " + (run.folder / "none/map.png")), "none");
    check_refused(run(both + " --json " + (run.folder / "none/verdict.json")), "none");
    check_refused(run(both + " --json " + (run.folder / "a.json") + " --map " + (run.folder / "none/b.png")),
                  "none");
    CHECK_FALSE(std::filesystem::exists(run.folder / "a.json"));
    CHECK(run("--help").code == 0);
    CHECK_ERROR(run("--help").out, "0 same, 1 different, 2 an error", "--known", "--json", "--map");
}
