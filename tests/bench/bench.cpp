// Facts about the benchmarks' own tools: what they trace, which side they call correct, and what the report draws.
#include "tests/check.h"
#include "common/util/paths.h"

#include "01_spheres/camera.h"
#include "accel/bench/agreement.h"
#include "accel/bench/scenes.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/util/json.h"
#include "tools/bench/numbers.h"
#include "tools/bench/report.h"

#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

using namespace rt;
using namespace rt::bench;

// ---- scenes and rays ----

TEST_CASE("a field of knots has the number of triangles in its name within a tenth") {
    for (const char* name : {"1k", "10k", "30k", "100k"}) {
        CAPTURE(std::string(name));
        const double want = triangle_count(name), got = double(make_scene(name).triangles.size());
        CHECK(std::abs(got - want) <= 0.1 * want);
    }
    CHECK(triangle_count("2M") == 2'000'000);
    for (const char* wrong : {"", "k", "10", "10x", "cat", "-5k", "100M"}) CHECK(triangle_count(wrong) == 0);
}

TEST_CASE("the same field comes out on every run") {
    const BenchScene a = make_scene("3k"), b = make_scene("3k");
    CHECK(a.vertices == b.vertices);
    CHECK(a.triangles == b.triangles);
}

TEST_CASE("a room is closed: every ray that starts in it hits something, as brute force shows") {
    for (const char* name : {"cat", "1k"}) {
        CAPTURE(std::string(name));
        const BenchScene scene = make_scene(name);
        auto rays = make_rays(scene, accel::build_triangle_bvh(scene.mesh()), 48);
        CHECK(rays["primary"].size() == 48 * 48);
        CHECK(rays["bounce"].size() == rays["primary"].size());
        std::size_t lost = 0;
        for (const accel::Ray& ray : rays["bounce"]) lost += !brute_force_closest_hit(scene.mesh(), ray);
        CHECK_MESSAGE(lost == 0, lost << " of the bounce rays leave the room");
    }
}

TEST_CASE("bounces leave a surface at angles whose mean cosine is 2/3, and shadow rays end at the light") {
    const BenchScene scene = make_scene("1k");
    auto rays = make_rays(scene, accel::build_triangle_bvh(scene.mesh()), 64);
    double sum = 0;
    for (std::size_t i = 0; i < rays["bounce"].size(); ++i) {
        const auto hit = brute_force_closest_hit(scene.mesh(), rays["primary"][i]);
        const auto [a, b, c] = triangle_at(scene.mesh(), hit->primitive);
        sum += double(std::abs(dot(rays["bounce"][i].direction, normalize(cross(b - a, c - a)))));
    }
    const double count = double(rays["bounce"].size()); // the variance of the cosine is 1/18
    CHECK(std::abs(sum / count - 2.0 / 3) < 4 * std::sqrt(1 / (18 * count)));
    for (const accel::Ray& ray : rays["shadow"]) {
        const vec3 end = ray.origin + ray.direction;
        const vec3 outside = max(scene.light.min - end, end - scene.light.max);
        CHECK(std::max({outside.x, outside.y, outside.z}) < 1e-5f);
    }
}

TEST_CASE("some shadow rays reach the light and some do not") {
    const BenchScene scene = make_scene("1k");
    const accel::TriangleBvh bvh = accel::build_triangle_bvh(scene.mesh());
    auto rays = make_rays(scene, bvh, 64);
    std::size_t dark = 0;
    for (const accel::Ray& ray : rays["shadow"]) dark += accel::any_hit(bvh, ray);
    CHECK(rays["shadow"].size() > rays["primary"].size() / 4);
    CHECK(dark > rays["shadow"].size() / 10);
    CHECK(dark < rays["shadow"].size() * 9 / 10);
}

TEST_CASE(
    "the primary rays of an image are those of the lesson's camera, each once, neighbours side by side") {
    const BenchScene scene = make_scene("1k");
    const std::vector<accel::Ray> rays = primary_rays(scene, 32);
    const Camera camera = make_camera({.from = scene.camera, .at = scene.target, .fov = scene.fov}, 32, 32);
    for (const auto& [i, x, y] : {std::tuple(0, 0.5f, 0.5f), {16, 0.5f, 1.5f}, {256, 16.5f, 0.5f}})
        CHECK(length(rays[std::size_t(i)].direction - camera_ray(camera, {x, y}).direction) < 1e-6f);
    std::set<std::pair<float, float>> different;
    for (const accel::Ray& ray : rays) different.insert({ray.direction.x, ray.direction.y});
    CHECK(different.size() == rays.size());
}

// ---- which side is correct ----

namespace {

/// Rays in a room, and their correct hits.
struct KnownHits {
    BenchScene scene = make_scene("1k");
    std::vector<accel::Ray> rays = primary_rays(scene, 16);
    Hits truth;

    KnownHits() {
        for (const accel::Ray& ray : rays) truth.push_back(brute_force_closest_hit(scene.mesh(), ray));
    }
    Agreement compare(const Hits& ours, const Hits& embree, bool shadow) const {
        return bench::compare(scene.mesh(), rays, ours, embree, shadow, 100);
    }
};

} // namespace

TEST_CASE("two sides that are correct agree") {
    const KnownHits known;
    Agreement counts = known.compare(known.truth, known.truth, false);
    CHECK(counts["rays"] == 256);
    CHECK(counts["sampled"] == 100);
    for (const auto& [name, count] : counts) CHECK((count == 0 || name == "rays" || name == "sampled"));
}

TEST_CASE("every planted disagreement is counted, by kind, and brute force says which side is correct") {
    const KnownHits known;
    Hits ours = known.truth, embree = known.truth;
    ours[1].reset();   // we miss
    embree[2].reset(); // Embree misses
    embree[3].reset();
    ours[4]->t *= 1.01f;       // we find what is behind
    embree[5]->t *= 0.99f;     // Embree finds what is not there
    ours[6]->primitive += 1;   // the neighbour at the same distance is as good
    embree[7]->t *= 1 + 1e-6f; // rounding
    Agreement counts = known.compare(ours, embree, false);
    CHECK(counts["only_embree"] == 1);
    CHECK(counts["only_ours"] == 2);
    CHECK(counts["embree_nearer"] == 2);
    CHECK(counts["ours_nearer"] == 0);
    CHECK(counts["other_triangle"] == 1);
    CHECK(counts["judged"] == 5);
    CHECK(counts["ours_right"] == 3);
    CHECK(counts["embree_right"] == 2);
}

TEST_CASE("mistakes of our tracer are found without Embree too") {
    const KnownHits known;
    CHECK(known.compare(Hits(known.rays.size()), {}, false)["sampled_wrong"] == 100);
}

TEST_CASE("for a shadow ray it only matters whether it hits anything") {
    const KnownHits known;
    Hits ours = known.truth;
    for (auto& hit : ours) hit->t = infinity;
    CHECK(known.compare(ours, known.truth, true)["judged"] == 0);
    ours[9].reset();
    CHECK(known.compare(ours, known.truth, true)["only_embree"] == 1);
}

// ---- the report ----

TEST_CASE("medians and geometric means are correct and ignore unknown values") {
    CHECK(median({3, 1, 2}) == 2);
    CHECK(median({4, 1, 2, 3}) == 2.5);
    CHECK(std::isnan(median({})));
    CHECK(geometric_mean({2, 8}) == doctest::Approx(4));
    CHECK(geometric_mean({2, unknown, 8}) == doctest::Approx(4));
    CHECK(std::isnan(geometric_mean({unknown})));
}

TEST_CASE(
    "JSON keeps the order of its fields; it has null for non-finite numbers and U+FFFD for invalid UTF-8") {
    const Json json{{"b", 1.25}, {"a", unknown}, {"list", {1, "x"}}};
    CHECK(json::text(json) == "{\"b\":1.25,\"a\":null,\"list\":[1,\"x\"]}");
    CHECK(json::text("caf\xE9!") == "\"caf\uFFFD!\"");
    std::string text = "caf\u00E9 \u4E2D \U0001F600 \"\\/\u0085\u2028\x7F";
    for (char c = 0; c < '\x7F'; ++c) text += c;
    CHECK(Json::parse(json::text(text)).get<std::string>() == text);
}

TEST_CASE("a table has a row per object and a dash for values that were not measured") {
    const Json rows{{{"mesh", "cat"}, {"ours_mrays", 1.25}}, {{"mesh", "10k"}, {"ours_mrays", unknown}}};
    CHECK(table(rows) ==
          "| mesh | ours mrays |\n|------|-----------:|\n| cat  |       1.25 |\n| 10k  |          - |\n\n");
    CHECK(table(Json::array()).empty());
}

namespace {

/// Example output of bench_traversal and bench_renders; the second mesh has no measurement for bounce rays.
const Json numbers = Json::parse(R"({
    "traversal": {"cases": [
        {"mesh": "cat", "triangles": 1000, "rays": "primary", "threads": 1, "ours_mrays": 4, "embree_mrays": 5, "ratio": 0.8},
        {"mesh": "cat", "triangles": 1000, "rays": "bounce", "threads": 1, "ours_mrays": 2, "embree_mrays": 5, "ratio": 0.4},
        {"mesh": "10k", "triangles": 10000, "rays": "primary", "threads": 1, "ours_mrays": 2, "embree_mrays": 2, "ratio": 1}],
        "geometric_mean_ratio": 0.68, "build": [],
        "checks": [{"rays": 10, "only_ours": 1}, {"rays": 20, "only_ours": 2}]},
    "scaling": {"cases": [
        {"mesh": "1k", "triangles": 1000, "rays": "primary", "threads": 1, "ours_mrays": 1000, "embree_mrays": null},
        {"mesh": "10k", "triangles": 10000, "rays": "primary", "threads": 1, "ours_mrays": 500, "embree_mrays": null},
        {"mesh": "100k", "triangles": 100000, "rays": "primary", "threads": 1, "ours_mrays": 250, "embree_mrays": null},
        {"mesh": "1M", "triangles": 1000000, "rays": "primary", "threads": 1, "ours_mrays": null, "embree_mrays": null},
        {"mesh": "10M", "triangles": 10000000, "rays": "primary", "threads": 1, "ours_mrays": 62.5, "embree_mrays": null}],
        "build": []},
    "renders": {"renders": [{"step": "05_mesh_bvh", "scene_percent": 5, "build_percent": 15, "traversal_percent": 50,
        "shading_percent": 30}]}})");

/// Returns the plots of the report, drawn by gnuplot, as SVG by name; empty if gnuplot is missing.
std::map<std::string, std::string> drawn_plots() {
    std::map<std::string, std::string> drawn;
    if (std::system("gnuplot --version >/dev/null 2>&1") != 0) return drawn;
    const auto folder = std::filesystem::temp_directory_path() / ("raysteps_plots_" + random_digits());
    std::filesystem::create_directories(folder);
    for (const auto& [name, data] : make_report(numbers, true).plots) {
        const std::string file = text_of(folder / name);
        write_file(file + ".txt", data);
        REQUIRE(std::system(("gnuplot -c '" RT_PLOT "' '" + file + ".txt' '" + file + ".svg'").c_str()) == 0);
        drawn[name] = read_file(file + ".svg");
    }
    std::filesystem::remove_all(folder);
    return drawn;
}

/// Returns the two numbers that `pattern` captures, for each match in the text.
std::vector<glm::dvec2> captured(const std::string& text, const std::string& pattern) {
    std::vector<glm::dvec2> all;
    const std::regex regex(pattern);
    for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
        all.push_back({std::stod((*at)[1]), std::stod((*at)[2])});
    return all;
}

} // namespace

TEST_CASE("the report sums the checks, shows its plots and rejects invalid numbers") {
    const Report report = make_report(numbers, true);
    CHECK(report.text.find("|   30 |         3 |") != std::string::npos);
    CHECK(report.text.find("![Where the time of one thread goes](renders.svg)") != std::string::npos);
    CHECK(report.plots.size() == 3); // the builds were not measured
    CHECK(make_report(numbers, false).plots.empty());
    CHECK(make_report(numbers, false).text.find(".svg") == std::string::npos);
    for (const char* wrong : {"1", "{}", "{\"cases\": 1}", "{\"cases\": [1], \"build\": []}"})
        CHECK_THROWS_AS(make_report({{"traversal", Json::parse(wrong)}}, true), Error);
}

TEST_CASE("a plot supports dark mode and equal numbers give an equal file") {
    const auto plots = drawn_plots();
    if (plots.empty()) {
        SKIP_CHECK("no gnuplot");
        return;
    }
    CHECK(plots == drawn_plots());
    for (const auto& [key, svg] : plots) {
        const std::string name = key; // CAPTURE cannot capture a structured binding
        CAPTURE(name);
        CHECK(svg.find("prefers-color-scheme: dark") != std::string::npos);
        CHECK(svg.find("</svg>") != std::string::npos);
        CHECK_FALSE(std::regex_search(svg, std::regex("[ ,-]nan[ ,]")));
    }
}

TEST_CASE("on a logarithmic axis, equal ratios have equal distances, larger values are higher and gaps are "
          "omitted") {
    const auto plots = drawn_plots();
    if (plots.empty()) {
        SKIP_CHECK("no gnuplot");
        return;
    }
    auto dots = captured(plots.at("scaling_ray"),
                         "<use xlink:href='#gpPt6' transform='translate\\(([0-9.]+),([0-9.]+)\\)");
    REQUIRE(dots.size() == 5); // four points, and one of the legend
    std::ranges::sort(dots, {}, &glm::dvec2::y);
    CHECK(dots[3].x - dots[4].x == doctest::Approx(dots[2].x - dots[3].x).epsilon(0.01));
    CHECK(dots[1].x - dots[2].x == doctest::Approx(2 * (dots[2].x - dots[3].x)).epsilon(0.01));
    CHECK(dots[4].y - dots[3].y == doctest::Approx(dots[3].y - dots[2].y).epsilon(0.01));
    CHECK(dots[4].y > dots[3].y);
}

TEST_CASE("a bar of twice the value is twice as high") {
    const auto plots = drawn_plots();
    if (plots.empty()) {
        SKIP_CHECK("no gnuplot");
        return;
    }
    // Starting from the bottom left corner; the captured numbers are the bottom and the top.
    const auto bars =
        captured(plots.at("traversal_1"), "points = '[0-9.]+,([0-9.]+) [0-9.]+,[0-9.]+ [0-9.]+,([0-9.]+) ");
    std::set<long> heights;
    for (const glm::dvec2 bar : bars) heights.insert(std::lround(bar.x - bar.y));
    REQUIRE(heights.size() >= 3);
    const double low = double(*std::next(heights.begin(), long(heights.size()) - 3));
    CHECK(double(*std::next(heights.begin(), long(heights.size()) - 2)) ==
          doctest::Approx(2 * low).epsilon(0.02));
    CHECK(double(*heights.rbegin()) == doctest::Approx(2.5 * low).epsilon(0.02));
}
