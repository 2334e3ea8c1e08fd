// Facts about the benchmark tools: scenes and rays, the arbitration of disagreements, the report.
#include "tests/check.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/util/json.h"
#include "tools/bench/agreement.h"
#include "tools/bench/meshes.h"
#include "tools/bench/rays.h"
#include "tools/bench/report.h"
#include "tools/bench/statistics.h"
#include "tools/bench/threads.h"

#include <atomic>
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
        const double want = triangle_count(name), got = double(make_scene(name).mesh.triangles.size());
        CHECK(std::abs(got - want) <= 0.1 * want);
    }
    CHECK(triangle_count("2M") == 2'000'000);
    for (const char* wrong : {"", "k", "10", "10x", "cat", "-5k", "100M"}) CHECK(triangle_count(wrong) == 0);
}

TEST_CASE("the same field is generated on every run") {
    const Mesh a = make_scene("3k").mesh, b = make_scene("3k").mesh;
    CHECK(a.positions == b.positions);
    CHECK(a.triangles == b.triangles);
}

TEST_CASE("all triangles face outward: their winding agrees with their vertex normals") {
    const Mesh mesh = make_scene("10k").mesh;
    std::size_t turned = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
        turned += dot(area_normal(vertices(mesh, i)), dvec3(mesh.normals[mesh.triangles[i][0]])) <= 0;
    CHECK_MESSAGE(turned == 0, turned << " triangles face inward");
}

TEST_CASE("a room is closed: by brute force every ray that starts inside hits something") {
    for (const char* name : {"cat", "1k"}) {
        CAPTURE(std::string(name));
        const BenchScene scene = make_scene(name);
        const RaySets sets = make_rays(scene, build_ours(scene.mesh, 1), 48);
        CHECK(sets.primary.size() == 48 * 48);
        CHECK(sets.bounce.size() == sets.primary.size());
        std::size_t lost = 0;
        for (const Ray& ray : sets.bounce)
            lost += brute_force_closest_hit(scene.mesh, ray).primitive == no_primitive;
        CHECK_MESSAGE(lost == 0, lost << " of the bounce rays leave the room");
    }
}

TEST_CASE("some shadow rays reach the light and some do not") {
    const BenchScene scene = make_scene("1k");
    const Ours ours = build_ours(scene.mesh, 1);
    const RaySets sets = make_rays(scene, ours, 64);
    std::size_t dark = 0;
    for (const Ray& ray : sets.shadow) dark += any_hit(ours, ray);
    CHECK(sets.shadow.size() > sets.primary.size() / 4);
    CHECK(dark > sets.shadow.size() / 10);
    CHECK(dark < sets.shadow.size() * 9 / 10);
}

TEST_CASE(
    "the primary rays of a picture are the rays of its pixels, each once and with neighbours adjacent") {
    const BenchScene scene = make_scene("1k");
    const std::vector<Ray> rays = primary_rays(scene, 32);
    const Camera camera = make_camera(scene.look_at, 32, 32);
    CHECK(rays[0].direction == camera_ray(camera, {0.5f, 0.5f}).direction);
    CHECK(rays[16].direction == camera_ray(camera, {0.5f, 1.5f}).direction);
    CHECK(rays[256].direction == camera_ray(camera, {16.5f, 0.5f}).direction);
    std::set<std::pair<float, float>> different;
    for (const Ray& ray : rays) different.insert({ray.direction.x, ray.direction.y});
    CHECK(different.size() == rays.size());
}

// ---- tracing ----

TEST_CASE("threads process every index exactly once") {
    for (const int threads : {1, 2, 5}) {
        for (const std::size_t size :
             {std::size_t(0), std::size_t(1), std::size_t(1024), std::size_t(100'001)}) {
            std::vector<std::atomic<int>> visits(size);
            const Seconds seconds = run_threads(threads, size, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) ++visits[i];
            });
            std::size_t wrong = 0;
            for (const auto& count : visits) wrong += count != 1;
            CHECK(wrong == 0);
            CHECK(seconds.wall >= 0);
            CHECK(seconds.cpu >= 0);
        }
    }
}

// ---- arbitration ----

namespace {

/// Rays in a room, and their correct hits.
struct KnownHits {
    BenchScene scene = make_scene("1k");
    std::vector<Ray> rays = primary_rays(scene, 16);
    std::vector<ClosestHit> truth;

    KnownHits() {
        for (const Ray& ray : rays) truth.push_back(brute_force_closest_hit(scene.mesh, ray));
    }
};

} // namespace

TEST_CASE("two correct tracers agree") {
    const KnownHits known;
    const Agreement a = compare(known.scene.mesh, known.rays, known.truth, known.truth, false, 100);
    CHECK(a.rays == 256);
    CHECK(disagreements(a) == 0);
    CHECK(a.judged == 0);
    CHECK(a.sampled == 100);
    CHECK(a.sampled_wrong == 0);
}

TEST_CASE("every planted disagreement is counted by type and brute force decides which tracer is right") {
    const KnownHits known;
    std::vector<ClosestHit> ours = known.truth, embree = known.truth;
    ours[1] = {};               // ours misses
    embree[2] = embree[3] = {}; // Embree misses
    ours[4].t *= 1.01f;         // ours finds a hit behind the correct one
    embree[5].t *= 0.99f;       // Embree finds a hit that does not exist
    ours[6].primitive += 1;     // a neighbour at the same distance is equally good
    embree[7].t *= 1 + 1e-6f;   // rounding
    const Agreement a = compare(known.scene.mesh, known.rays, ours, embree, false, 100);
    CHECK(a.only_embree == 1);
    CHECK(a.only_ours == 2);
    CHECK(a.embree_nearer == 2);
    CHECK(a.ours_nearer == 0);
    CHECK(a.other_triangle == 1);
    CHECK(a.judged == 5);
    CHECK(a.ours_right == 3);
    CHECK(a.embree_right == 2);
}

TEST_CASE("mistakes of our tracer are found without Embree too") {
    const KnownHits known;
    const Agreement a =
        compare(known.scene.mesh, known.rays, std::vector<ClosestHit>(known.rays.size()), {}, false, 100);
    CHECK(a.sampled_wrong == 100);
}

TEST_CASE("for a shadow ray it only matters whether it hits anything") {
    const KnownHits known;
    std::vector<ClosestHit> ours = known.truth;
    for (ClosestHit& hit : ours) hit.t = infinity;
    CHECK(disagreements(compare(known.scene.mesh, known.rays, ours, known.truth, true, 10)) == 0);
    ours[9] = {};
    CHECK(disagreements(compare(known.scene.mesh, known.rays, ours, known.truth, true, 10)) == 1);
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
        const std::string file = (folder / name).string();
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
    for (const auto& [name, svg] : plots) {
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
