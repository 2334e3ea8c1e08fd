// Facts about the whole comparison: verdict, location, known mistakes, NaN, JSON and error map.
#include "tools/compare/comparison.h"
#include "tests/compare/pictures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>

using namespace rt;
using namespace rt::compare;
using namespace rt::malformed;

namespace {

std::string all_lines(const Comparison& comparison) {
    std::string text;
    for (const std::string& line : comparison.lines) text += line + "\n";
    return text;
}

Comparison compared(const Image& test, const Image& reference) {
    return compare_images({{test}, {reference}});
}

ComparisonInput noisy_input(const NoisyPicture& test, const NoisyPicture& reference) {
    return {{test.mean}, {reference.mean}, {test.variance, reference.variance}};
}

/// Multiplies the pixels x0 <= x < x1, y0 <= y < y1 by a factor.
Image patched(Image image, Region box, vec3 factor) {
    for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x) image(x, y) *= factor;
    return image;
}

void add_to_catalogue(ComparisonInput& input, const std::string& name, const Image& image,
                      const Image& variance = {}) {
    CatalogueImage known;
    known.name = name;
    known.picture.image = image;
    known.variance = variance;
    input.catalogue.push_back(known);
}

const Region lower_left{8, 72, 40, 88};
const Image right = lopsided(144, 96);

} // namespace

TEST_CASE("the verdict is same, borderline or different, by the floats and by FLIP") {
    CHECK(compared(right, right).verdict == Verdict::same);
    CHECK(all_lines(compared(right, right)) == "same picture (largest difference 0, mean 0)\n");
    const Image nearly = patched(right, {60, 40, 72, 48}, vec3(1.02f));
    const Comparison look = compared(nearly, right);
    CHECK(look.verdict == Verdict::borderline);
    CHECK(look.flip.mean <= borderline_flip(0));
    CHECK_ERROR(look.lines[0], "look at the map", "96 of 13824 pixels");
    const Comparison different = compared(patched(right, lower_left, vec3(2.0f)), right);
    CHECK(different.verdict == Verdict::different);
    CHECK(different.lines[0].rfind("different: 512 of 13824 pixels", 0) == 0);
}

TEST_CASE("step 04 has a higher limit before the verdict is different") {
    ComparisonInput input{{patched(right, {0, 0, 144, 9}, vec3(1.06f))}, {right}};
    const double seen = compare_images(input).flip.mean;
    REQUIRE(seen > borderline_flip(0));
    REQUIRE(seen < borderline_flip(4));
    CHECK(compare_images(input).verdict == Verdict::different);
    input.step = 4;
    CHECK(compare_images(input).verdict == Verdict::borderline);
}

TEST_CASE("the words state place, direction, amount and the values of the worst pixel") {
    const Comparison bright = compared(patched(right, lower_left, vec3(1.12f)), right);
    CHECK_ERROR(bright.location.words, "too bright by 12 % in the lower left", "3.7 % of the picture",
                "x 9 to 38, y 72 to 87");
    const Comparison dark = compared(patched(right, lower_left, vec3(0.5f)), right);
    CHECK_ERROR(dark.location.words, "too dark by a factor of 2 in the lower left");
    CHECK_ERROR(all_lines(dark), "worst pixel: 39,87 is (0.118, 0.235, 0.159)", "in the reference (0.");
    const Comparison red = compared(patched(right, lower_left, vec3(1.5f, 0.934f, 1)), right);
    CHECK_ERROR(red.location.words, "in a different colour (too much red)");
    Image both = patched(right, {0, 0, 20, 20}, vec3(1.5f));
    both = patched(both, {100, 60, 120, 80}, vec3(0.7f));
    CHECK_ERROR(compared(both, right).location.words, "too bright in places and too dark in others all over");
    CHECK(compared(right, right).location.words.empty());
}

TEST_CASE("a region is described in words") {
    CHECK(place_in_words({0, 0, 90, 90}, 90, 90) == "all over the picture");
    CHECK(place_in_words({0, 0, 20, 20}, 90, 90) == "in the upper left");
    CHECK(place_in_words({70, 70, 90, 90}, 90, 90) == "in the lower right");
    CHECK(place_in_words({35, 35, 55, 55}, 90, 90) == "in the middle");
    CHECK(place_in_words({0, 35, 20, 55}, 90, 90) == "on the left");
    CHECK(place_in_words({70, 0, 90, 90}, 90, 90) == "on the right");
    CHECK(place_in_words({35, 0, 55, 20}, 90, 90) == "at the top");
    CHECK(place_in_words({0, 70, 90, 90}, 90, 90) == "at the bottom");
    CHECK(place_in_words({0, 35, 90, 55}, 90, 90) == "across the middle");
    CHECK(place_in_words({35, 0, 55, 90}, 90, 90) == "in the middle");
}

TEST_CASE("noisy pictures are the same up to noise or different in a place") {
    const NoisyPicture a(right, 1), b(right, 2);
    const Comparison noise = compare_images(noisy_input(a, b));
    CHECK(noise.verdict == Verdict::noise);
    CHECK(noise.tiles->outliers == 0);
    CHECK(noise.explanation.empty());
    CHECK(compare_images(noisy_input(a, a)).verdict == Verdict::same);
    const NoisyPicture wrong(patched(right, lower_left, vec3(1.5f)), 3);
    const Comparison different = compare_images(noisy_input(wrong, b));
    CHECK(different.verdict == Verdict::different);
    CHECK(different.tiles->outliers == 8);
    CHECK_ERROR(all_lines(different), "different: 8 of 216 tiles", "in the lower left", "too bright by",
                "worst tile: the 8 x 8 pixels at ", "none of these");
    // One outlier tile more than chance permits is borderline.
    const NoisyPicture little(patched(right, {8, 72, 24, 80}, vec3(1.12f)), 6);
    const Comparison look = compare_images(noisy_input(little, b));
    CHECK(look.verdict == Verdict::borderline);
    CHECK_ERROR(look.lines[0], "look at the map");
}

TEST_CASE("NaN pixels are reported with the first one, in memory and from a file, and are never noise") {
    Image wrong = right;
    wrong(70, 50).y = std::numeric_limits<float>::quiet_NaN();
    wrong(30, 51).x = infinity;
    for (const EncodedImage& test :
         {EncodedImage{wrong}, through_file(wrong, ".hdr"), through_file(wrong, ".png")}) {
        const EncodedImage reference = test.encoding == Encoding::floats ? EncodedImage{right}
                                       : test.encoding == Encoding::hdr  ? through_file(right, ".hdr")
                                                                         : through_file(right, ".png");
        const Comparison comparison = compare_images({test, reference});
        CHECK(comparison.verdict == Verdict::different);
        CHECK_ERROR(comparison.lines[0], "different: 2 pixels not a number", "the first at 70,50");
        CHECK_FALSE(contains(to_json(comparison), ":nan"));
        CHECK_FALSE(contains(to_json(comparison), ":inf"));
    }
    NoisyPicture a(right, 1);
    a.mean(70, 50) = a.variance(70, 50) =
        vec3(1, 0, 1); // what a file stores for a NaN; z alone would not detect it
    const Comparison comparison = compare_images(noisy_input(a, NoisyPicture(right, 2)));
    CHECK(comparison.verdict == Verdict::different);
    CHECK_ERROR(comparison.lines[0], "1 pixel not a number", "the first at 70,50");
    const Image pink = patched(right, {3, 3, 4, 4}, vec3(0.0f)); // a reference may contain magenta
    Image magenta = pink;
    magenta(3, 3) = vec3(1, 0, 1);
    CHECK(compared(magenta, magenta).verdict == Verdict::same);
}

TEST_CASE("a PNG is compared with a .hdr as far as the PNG has information") {
    const Image bright = changed(right, [](vec3 c) { return c * 2.0f; }); // some of it exceeds white
    for (const Image& image : {right, bright}) {
        CHECK(compare_images({through_file(image, ".png"), through_file(image, ".hdr")}).verdict ==
              Verdict::same);
        CHECK(compare_images({through_file(image, ".hdr"), through_file(image, ".png")}).verdict ==
              Verdict::same);
    }
    const Image wrong = patched(right, lower_left, vec3(1.12f));
    CHECK_ERROR(compare_images({through_file(wrong, ".png"), through_file(right, ".hdr")}).location.words,
                "too bright by 1", "in the lower left", "3.7 %");
}

TEST_CASE("a known mistake is named if the picture matches it, and only then") {
    const Image mistake = patched(right, lower_left, vec3(2.0f)), other = mirrored(right, true, false);
    ComparisonInput input{{mistake}, {right}};
    add_to_catalogue(input, "other", other);
    add_to_catalogue(input, "mistake", mistake);
    CHECK(compare_images(input).match.names == std::vector<std::string>{"mistake"});
    CHECK_ERROR(all_lines(compare_images(input)), "known mistakes: this is the picture of mistake");
    input.test = {patched(mistake, {60, 40, 64, 44}, vec3(1.02f))}; // nearly
    CHECK(compare_images(input).match.names == std::vector<std::string>{"mistake"});
    input.test = {patched(right, lower_left, vec3(1.5f))}; // halfway
    CHECK(compare_images(input).match.names.empty());
    CHECK_ERROR(all_lines(compare_images(input)), "known mistakes: none of 2 pictures");
    input.test = {right}; // correct, although a known picture matches as well
    add_to_catalogue(input, "invisible", right);
    CHECK(compare_images(input).match.names.empty());
    input.test = {
        patched(right, {60, 40, 66, 48}, vec3(1.02f))}; // about as close to "invisible" as to the reference
    CHECK(compare_images(input).match.names.empty());
    input.test = {mistake};
    add_to_catalogue(input, "twin", mistake);
    CHECK(compare_images(input).match.names == std::vector<std::string>{"mistake", "twin"});
    add_to_catalogue(input, "small", Image(3, 3));
    CHECK_ERROR(error_of([&] { compare_images(input); }), "known picture small", "3 x 3");
}

TEST_CASE("a known mistake is named under noise with or without its own variance") {
    const Image mistake = patched(right, lower_left, vec3(1.8f)), other = mirrored(right, true, false);
    ComparisonInput input = noisy_input(NoisyPicture(mistake, 1), NoisyPicture(right, 2));
    const NoisyPicture known(mistake, 3), unlike(other, 4);
    add_to_catalogue(input, "mistake", known.mean, known.variance);
    add_to_catalogue(input, "other", unlike.mean, unlike.variance);
    CHECK(compare_images(input).match.names == std::vector<std::string>{"mistake"});
    input.catalogue[0].variance = Image();
    CHECK(compare_images(input).match.names == std::vector<std::string>{"mistake"});
    input.catalogue.erase(input.catalogue.begin());
    CHECK(compare_images(input).match.names.empty());
}

TEST_CASE("the JSON contains what programs need") {
    const Comparison different = compared(mirrored(right, true, false), right);
    CHECK_ERROR(to_json(different),
                "{\"verdict\":\"different\",\"explanation\":\"flipped left to right\","
                "\"flip\":{\"mean\":0.",
                "\"rmse\":0.", "\"tiles_over_4\":null", "\"nearest\":[]");
    CHECK_ERROR(to_json(compared(right, right)), "\"verdict\":\"same\",\"explanation\":\"\"",
                "\"flip\":{\"mean\":0.0,\"max\":0.0},\"rmse\":0.0,\"mean_change\":0.0,");
    CHECK_ERROR(to_json(compare_images(noisy_input(NoisyPicture(right, 1), NoisyPicture(right, 2)))),
                "\"verdict\":\"noise\"", "\"tiles_over_4\":0,");
    const auto brighter = [](vec3 c) { return c + 0.25f; };
    const Comparison lifted = compared(changed(right, brighter), right);
    CHECK(lifted.rmse == doctest::Approx(0.25));
    CHECK_ERROR(to_json(lifted), "\"explanation\":\"none of these\"");
    ComparisonInput named{{mirrored(right, true, false)}, {right}};
    add_to_catalogue(named, "a \"quoted\" \\ name", named.test.image);
    CHECK_ERROR(to_json(compare_images(named)), "\"nearest\":[\"a \\\"quoted\\\" \\\\ name\"]");
}

TEST_CASE("the map is black where nothing differs and distinguishes too bright from too dark under noise") {
    const Image wrong = patched(right, lower_left, vec3(2.0f));
    const Image seen = error_map(compared(wrong, right));
    CHECK(seen.width == 144);
    CHECK(seen.height == 96);
    CHECK(luminance(seen(120, 20)) < 0.001f);
    CHECK(luminance(seen(24, 80)) > 0.1f);
    const NoisyPicture reference(right, 2);
    const vec3 bright = error_map(compare_images(noisy_input(NoisyPicture(wrong, 1), reference)))(24, 80);
    CHECK(bright.x > 2 * bright.z);
    const Image darker = patched(right, lower_left, vec3(0.5f));
    const vec3 dark = error_map(compare_images(noisy_input(NoisyPicture(darker, 1), reference)))(24, 80);
    CHECK(dark.z > 2 * dark.x);
}

TEST_CASE("pictures of different sizes or channels are an error that states both") {
    CHECK_ERROR(error_of([] { compared(Image(3, 2), Image(2, 3)); }), "3 x 2", "2 x 3");
    const EncodedImage grey{right, Encoding::png, 1}, rgb{right, Encoding::png, 3};
    CHECK_ERROR(error_of([&] { compare_images({grey, rgb}); }), "1 channel", "3 channels");
}
