// Facts about the benchmarks' own tools: what they trace, who is told right, and what the report draws.
#include "tests/check.h"

#include "common/util/error.h"
#include "tools/bench/agreement.h"
#include "common/util/json.h"
#include "tools/bench/json_reader.h"
#include "tools/bench/meshes.h"
#include "tools/bench/rays.h"
#include "tools/bench/statistics.h"
#include "tools/bench/svg.h"
#include "tools/bench/team.h"

#include <doctest/doctest.h>

#include <atomic>
#include <set>
#include <string>
#include <vector>

using namespace rt;
using namespace rt::bench;

// ---- what is traced ----

TEST_CASE("a field of knots has as many triangles as its name says, within a tenth") {
    for (const char* name : {"1k", "10k", "30k", "100k"}) {
        CAPTURE(std::string(name));
        const double want = triangle_count(name), got = double(make_subject(name).mesh.triangles.size());
        CHECK(std::abs(got - want) <= 0.1 * want);
    }
    CHECK(triangle_count("2M") == 2'000'000);
    for (const char* wrong : {"", "k", "10", "10x", "cat", "-5k", "100M"}) CHECK(triangle_count(wrong) == 0);
}

TEST_CASE("the same field comes out on every run") {
    const Mesh a = make_subject("3k").mesh, b = make_subject("3k").mesh;
    CHECK(a.positions == b.positions);
    CHECK(a.triangles == b.triangles);
}

TEST_CASE("all triangles face outward: their corners run round the normals of their vertices") {
    const Mesh mesh = make_subject("10k").mesh;
    std::size_t turned = 0;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i)
        turned += dot(area_normal(vertices(mesh, i)), dvec3(mesh.normals[mesh.triangles[i][0]])) <= 0;
    CHECK_MESSAGE(turned == 0, turned << " triangles are turned");
}

TEST_CASE("a room is closed: whatever starts in it meets something, as asking every triangle shows") {
    for (const char* name : {"cat", "1k"}) {
        CAPTURE(std::string(name));
        const Subject subject = make_subject(name);
        const RaySets sets = make_rays(subject, build_ours(subject.mesh, 1), 48);
        CHECK(sets.primary.size() == 48 * 48);
        CHECK(sets.bounce.size() == sets.primary.size());
        std::size_t lost = 0;
        for (const Ray& ray : sets.bounce) lost += brute_nearest(subject.mesh, ray).primitive == nothing;
        CHECK_MESSAGE(lost == 0, lost << " of the bounce rays leave the room");
    }
}

TEST_CASE("some shadow rays reach the light and some do not") {
    const Subject subject = make_subject("1k");
    const Ours ours = build_ours(subject.mesh, 1);
    const RaySets sets = make_rays(subject, ours, 64);
    std::size_t dark = 0;
    for (const Ray& ray : sets.shadow) dark += any_hit(ours, ray);
    CHECK(sets.shadow.size() > sets.primary.size() / 4);
    CHECK(dark > sets.shadow.size() / 10);
    CHECK(dark < sets.shadow.size() * 9 / 10);
}

TEST_CASE("the primary rays of a picture are its pixels' rays, each once, neighbours side by side") {
    const Subject subject = make_subject("1k");
    const std::vector<Ray> rays = primary_rays(subject, 32);
    const Camera camera = make_camera(subject.look_at, 32, 32);
    CHECK(rays[0].direction == camera_ray(camera, {0.5f, 0.5f}).direction);
    CHECK(rays[16].direction == camera_ray(camera, {0.5f, 1.5f}).direction);
    CHECK(rays[256].direction == camera_ray(camera, {16.5f, 0.5f}).direction);
    std::set<std::pair<float, float>> different;
    for (const Ray& ray : rays) different.insert({ray.direction.x, ray.direction.y});
    CHECK(different.size() == rays.size());
}

// ---- how it is traced ----

TEST_CASE("a team works off every index once, in one round after another") {
    for (const int threads : {1, 2, 5}) {
        Team team(threads);
        for (const std::size_t size :
             {std::size_t(0), std::size_t(1), std::size_t(1024), std::size_t(100'001)}) {
            std::vector<std::atomic<int>> visits(size);
            const Seconds seconds = team.run(size, [&](std::size_t begin, std::size_t end) {
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

// ---- who is right ----

namespace {

/// Rays in a room, and the truth about each.
struct Known {
    Subject subject = make_subject("1k");
    std::vector<Ray> rays = primary_rays(subject, 16);
    std::vector<Found> truth;

    Known() {
        for (const Ray& ray : rays) truth.push_back(brute_nearest(subject.mesh, ray));
    }
};

} // namespace

TEST_CASE("two sides that tell the truth agree") {
    const Known known;
    const Agreement a = compare(known.subject.mesh, known.rays, known.truth, known.truth, false, 100);
    CHECK(a.rays == 256);
    CHECK(disagreements(a) == 0);
    CHECK(a.judged == 0);
    CHECK(a.sampled == 100);
    CHECK(a.sampled_wrong == 0);
}

TEST_CASE("every planted disagreement is counted, by kind, and the side that is wrong is told") {
    const Known known;
    std::vector<Found> ours = known.truth, embree = known.truth;
    ours[1] = {};               // we miss
    embree[2] = embree[3] = {}; // Embree misses
    ours[4].t *= 1.01f;         // we find what is behind
    embree[5].t *= 0.99f;       // Embree finds what is not there
    ours[6].primitive += 1;     // the neighbour at the same distance is as good
    embree[7].t *= 1 + 1e-6f;   // rounding
    const Agreement a = compare(known.subject.mesh, known.rays, ours, embree, false, 100);
    CHECK(a.only_embree == 1);
    CHECK(a.only_ours == 2);
    CHECK(a.embree_nearer == 2);
    CHECK(a.ours_nearer == 0);
    CHECK(a.other_triangle == 1);
    CHECK(a.judged == 5);
    CHECK(a.ours_right == 3);
    CHECK(a.embree_right == 2);
}

TEST_CASE("our own mistakes are found without Embree too") {
    const Known known;
    const Agreement a =
        compare(known.subject.mesh, known.rays, std::vector<Found>(known.rays.size()), {}, false, 100);
    CHECK(a.sampled_wrong == 100);
}

TEST_CASE("of a shadow ray only counts whether anything is met") {
    const Known known;
    std::vector<Found> ours = known.truth;
    for (Found& found : ours) found.t = infinity;
    CHECK(disagreements(compare(known.subject.mesh, known.rays, ours, known.truth, true, 10)) == 0);
    ours[9] = {};
    CHECK(disagreements(compare(known.subject.mesh, known.rays, ours, known.truth, true, 10)) == 1);
}

// ---- the report ----

TEST_CASE("medians and geometric means") {
    CHECK(median({3, 1, 2}) == 2);
    CHECK(median({4, 1, 2, 3}) == 2.5);
    CHECK(std::isnan(median({})));
    CHECK(geometric_mean({2, 8}) == doctest::Approx(4));
    CHECK(geometric_mean({2, unknown, 8}) == doctest::Approx(4));
    CHECK(std::isnan(geometric_mean({unknown})));
}

TEST_CASE("what is written as JSON is read back") {
    const std::string text =
        json::object({{"name", json::text("a \"b\" \\ c")},
                      {"list", json::array({json::object({{"x", json::number(1.25)}}), json::number(unknown),
                                            json::number(std::int64_t(7))})},
                      {"empty", json::array({})}});
    const Json json = parse_json(text);
    CHECK(field(json, "name").text == "a \"b\" \\ c");
    REQUIRE(field(json, "list").list.size() == 3);
    CHECK(number_of(field(field(json, "list").list[0], "x")) == 1.25);
    CHECK(field(json, "list").list[1].kind == Json::Kind::null);
    CHECK(number_of(field(json, "list").list[2]) == 7);
    CHECK(field(json, "empty").list.empty());
    CHECK(std::isnan(number_of(field(json, "absent"))));
}

TEST_CASE("every text comes back from JSON: letters of all languages, control characters, quotes") {
    std::string text = "caf\u00E9 \u4E2D \U0001F600 \t\n\r\b\f \"\\/\u0085\u2028";
    for (char c = 0; c < '\x7F'; ++c) text += c;
    text += '\x7F';
    CHECK(parse_json(json::text(text)).text == text);
    CHECK(json::text("\x1f\x7f\t") == "\"\\u001f\\u007f\\u0009\"");
    CHECK(parse_json("\"\\b\\f\\n\\r\\t\\/\\u0041\"").text == "\b\f\n\r\t/A");
}

TEST_CASE("bytes that are not UTF-8 come back from JSON as U+FFFD, each of them") {
    CHECK(parse_json(json::text("caf\xE9!")).text == "caf\uFFFD!");
    for (int i = 0; i < 0x10000; ++i) {
        const std::string pair{char(i >> 8), char(i)};
        const std::string once = parse_json(json::text(pair)).text;
        const bool valid = once == pair;
        if (parse_json(json::text(once)).text != once || (!valid && once.find("\uFFFD") == std::string::npos))
            FAIL("bytes ", i);
    }
}

TEST_CASE("what is not JSON is refused, with the place") {
    for (const char* wrong : {"", "{", "[1,", "{\"a\" 1}", "[1] 2", "nul", "\"open", "{\"a\":}", "{a: 1}",
                              "\"\\u00\"", "\"\\u00g0\"", "\"\\u00e9\"", "\"\\"}) {
        CAPTURE(std::string(wrong));
        CHECK_THROWS_AS(parse_json(wrong), Error);
    }
    CHECK_THROWS_AS(parse_json(std::string(1000, '[')), Error);
}

TEST_CASE("numbers of JSON are read in every form that they have, and nothing else is one") {
    const Json list = parse_json("[0, -0.5, 1e3, 2.5E-1, 12345678901234567]");
    const std::vector<double> wanted{0, -0.5, 1e3, 0.25, 12345678901234567.0};
    REQUIRE(list.list.size() == wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) CHECK(number_of(list.list[i]) == wanted[i]);
    for (const char* wrong : {"nan", "inf", "-inf", "0x10", "+1", "1e", "1-2", "-", "1e999"}) {
        CAPTURE(std::string(wrong));
        CHECK_THROWS_AS(parse_json(wrong), Error);
    }
}

namespace {

/// Every opened element is closed, in order; style and text may hold anything but tags.
bool well_formed(const std::string& text) {
    std::vector<std::string> open;
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
        const std::size_t end = text.find('>', at);
        if (end == std::string::npos) return false;
        const std::string tag = text.substr(at + 1, end - at - 1);
        const std::string name = tag.substr(0, tag.find_first_of(" /", 1));
        if (tag.ends_with('/')) continue;
        if (tag[0] != '/') {
            open.push_back(name);
        } else if (open.empty() || open.back() != tag.substr(1)) {
            return false;
        } else {
            open.pop_back();
        }
    }
    return open.empty();
}

/// The numbers that follow `name='` anywhere in the text.
std::vector<double> attributes(const std::string& text, const std::string& name) {
    std::vector<double> values;
    const std::string key = " " + name + "='";
    for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1))
        values.push_back(std::stod(text.substr(at + key.size())));
    return values;
}

} // namespace

TEST_CASE("a plot is whole, knows the dark, and leaves out what was not measured") {
    const std::string log =
        svg(LogPlot{"a < b & c", "n", "s", {{"one", {{1e3, 1}, {1e4, unknown}, {1e6, 9}}, 0, false}}});
    const std::string bars = svg(Bars{"bars", "y", {"g", "h"}, {"s", "t"}, {{1, 2}, {unknown, 0.5}}, 1});
    const std::string shares = svg(Shares{"shares", {"row"}, {"a", "b"}, {{0.25, 0.75}}});
    for (const std::string& text :
         {log, bars, shares, svg(LogPlot{"none", "", "", {}}), svg(Bars{"none", "", {}, {}, {}, 0})}) {
        CAPTURE(text);
        CHECK(well_formed(text));
        CHECK(text.find("prefers-color-scheme: dark") != std::string::npos);
        CHECK(text.find("nan") == std::string::npos);
        CHECK(text.find("inf") == std::string::npos);
    }
    CHECK(log.find("a &lt; b &amp; c") != std::string::npos);
    CHECK(attributes(log, "cx").size() == 2);
}

TEST_CASE("equal ratios are equally far apart on a logarithmic axis, more is higher") {
    const std::string text =
        svg(LogPlot{"t", "n", "s", {{"one", {{1e3, 1}, {1e4, 2}, {1e5, 4}, {1e7, 16}}, 0, false}}});
    const std::vector<double> x = attributes(text, "cx"), y = attributes(text, "cy");
    REQUIRE(x.size() == 4);
    CHECK(x[1] - x[0] == doctest::Approx(x[2] - x[1]).epsilon(0.01));
    CHECK(x[3] - x[2] == doctest::Approx(2 * (x[2] - x[1])).epsilon(0.01));
    CHECK(y[0] - y[1] == doctest::Approx(y[1] - y[2]).epsilon(0.01));
    CHECK(y[0] > y[1]);
}

TEST_CASE("a bar of twice the value is twice as high") {
    const std::string text = svg(Bars{"bars", "y", {"g"}, {"s", "t"}, {{0.4, 0.8}}, 0});
    std::vector<double> heights = attributes(text, "height");
    REQUIRE(heights.size() >= 2);
    CHECK(heights[heights.size() - 1] == doctest::Approx(2 * heights[heights.size() - 2]).epsilon(0.01));
}
