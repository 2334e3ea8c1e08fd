// Facts about the report: a single self-contained page in which foreign text is never markup.
#include "tools/tutor/report.h"
#include "common/util/paths.h"

#include "common/util/file_bytes.h"
#include "common/image/image_file.h"
#include "tests/malformed/folder.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace rt;
using namespace rt::tutor;
using namespace rt::malformed;

namespace {

const std::string root = RT_ROOT;
const std::string references = root + "/assets/reference/";

/// Writes a reference with a mistake: one quarter is upside down and too bright.
std::string wrong_picture(const Folder& folder, const std::string& name) {
    const Image right = read_image(references + name + ".png");
    Image wrong = right;
    for (int y = 0; y < right.height / 2; ++y)
        for (int x = right.width / 2; x < right.width; ++x)
            wrong(x, y) = 1.3f * right(x, right.height / 2 - y);
    write_image(folder / "mine.png", wrong);
    return folder / "mine.png";
}

/// Writes the difference of two pictures, pixel by pixel.
std::string difference_picture(const Folder& folder, const std::string& a, const std::string& b) {
    Image map = read_image(a);
    const Image other = read_image(b);
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        const float d = std::abs(luminance(map.pixels[i]) - luminance(other.pixels[i]));
        map.pixels[i] = vec3(std::sqrt(d), d, d * d) + vec3(0.01f);
    }
    write_image(folder / "map.png", map);
    return folder / "map.png";
}

Json check(const std::string& name, const std::string& state, double seconds,
           const std::vector<std::string>& lines) {
    return {{"name", name}, {"state", state}, {"seconds", seconds}, {"lines", lines}};
}

Json some_checks() {
    Json checks = Json::array();
    const auto add = [&](const char* name, const char* state, std::vector<std::string> lines = {}) {
        checks.push_back(check(name, state, 0.0013 * double(checks.size() + 1), lines));
    };
    add("a reflected direction leaves at the angle at which it came", "failed",
        {"tests/03_mirror.cpp:41  CHECK( dot(out, normal) == approx(-dot(in, normal)) )",
         "expected 0.6 within 1e-05, got -0.6",
         "a cosine of the opposite sign: the direction still points into the surface"});
    add("a reflected direction keeps its length", "ok");
    add("a mirror keeps the tangential part of a direction", "ok");
    add("reflecting twice restores the direction", "failed",
        {"expected (1, 2, 3) within 1e-05, got (1, 26, 3)"});
    add("a reflection does not depend on the sign of the normal", "ok");
    add("a corner of three mirrors sends a ray back to where it came from", "failed",
        {"expected (-0.36, -0.48, -0.8) within 1e-05, got (0.36, 0.48, 0.8)"});
    add("a path of three segments shows the ball at the end of its third segment", "unfinished",
        {"stopped after 10 s: a path over mirrors never ends"});
    add("white objects are invisible under a uniform sky, whatever share of them is a mirror", "skipped",
        {"[skipped] needs the picture of step 02"});
    for (const char* name :
         {"a quad is hit between its edges and missed beyond them",
          "a quad is hit on both sides of its diagonal", "a ray parallel to a quad misses it",
          "u and v of a quad run along its edges from the corner"})
        add(name, "ok");
    return checks;
}

Json some_mistake() {
    return {{"title", "the part along the normal is added instead of subtracted"},
            {"confidence", "very likely: the same checks fail with the same numbers"},
            {"shows", "reflections are upside down under every ball."},
            {"why", "d.n is negative for a ray that hits the surface, so `- 2 (d.n) n` points outward. With "
                    "a plus the ray enters the surface three times as steeply."},
            {"fix", "write `direction - 2 * dot(direction, normal) * normal`."},
            {"picture", references + "02_shadows.png"}};
}

Json empty_report() {
    return {{"checks", Json::array()},   {"own_files", Json::array()}, {"earlier", Json::array()},
            {"tiles_over_4", nullptr},   {"mistake", nullptr},         {"settings", ""},
            {"pictures", Json::object()}};
}

/// Builds the report of a check of step 03 with a known mistake.
Json some_report(const Folder& folder) {
    Json report = empty_report();
    report["step"] = "03_mirror";
    report["question"] = "what does the mirror see?";
    report["own_files"] = {"03_mirror/mirror.h"};
    report["checks"] = some_checks();
    report["earlier"] = {"01_spheres: 67 of 67 checks", "02_shadows: 41 of 41 checks"};
    report["verdict"] = "different";
    report["verdict_lines"] = {"Too bright by 12 % in the upper right; the worst pixel is x 497, y 31."};
    report["flip_mean"] = 0.0731;
    report["flip_max"] = 0.8124;
    report["pictures"]["mine"] = wrong_picture(folder, "03_mirror");
    report["pictures"]["reference"] = references + "03_mirror.png";
    report["pictures"]["map"] =
        difference_picture(folder, report["pictures"]["mine"], report["pictures"]["reference"]);
    report["mistake"] = some_mistake();
    report["next"] = "./learn hint 03 reflect";
    report["settings"] = "640 x 400, 16 samples a pixel, seed 1";
    return report;
}

/// Builds the report of a successful check of a noisy step.
Json good_report() {
    Json report = empty_report();
    report["step"] = "08_indirect";
    report["question"] = "where does the light in the shadow come from?";
    report["own_files"] = {"08_indirect/hemisphere.h", "08_indirect/area_lights.h"};
    for (int i = 0; i < 74; ++i)
        report["checks"].push_back(
            check("fact number " + std::to_string(i + 1) + " about light", "ok", 0.002 * i, {}));
    report["verdict"] = "noise";
    report["verdict_lines"] = {"No tile differs by more than its noise explains."};
    report["tiles_over_4"] = 1;
    for (const char* name : {"mine", "reference", "map"})
        report["pictures"][name] = references + "08_indirect.png";
    report["next"] = "./learn status";
    report["settings"] = "480 x 480, 16 samples a pixel, seed 1";
    return report;
}

Json unbuilt_report() {
    Json report = empty_report();
    report["step"] = "03_mirror";
    report["question"] = "what does the mirror see?";
    report["own_files"] = {"03_mirror/mirror.h"};
    report["verdict"] = "the program did not build";
    report["verdict_lines"] = {
        "workshop/03_mirror/mirror.h:24:12: error: 'refelct' was not declared in this scope; did "
        "you mean 'reflect'?"};
    report["next"] = "./learn hint 03 reflected_ray";
    return report;
}

/// Returns markup, quotes, a second data placeholder, and a word that is wider than a phone's screen.
std::string evil_text() {
    std::string text =
        "</script><script>window.harm = 1</script><!-- <img src=x onerror=\"window.harm = 1\"> "
        "' & \\ {{data}} ";
    for (int i = 0; i < 12; ++i) text += "a_long_word";
    return text;
}

/// Builds a report with the same text everywhere, which would be harmful as markup.
Json evil_report(const Folder& folder) {
    const std::string evil = evil_text();
    Json report = some_report(folder);
    report["step"] = "03_" + evil;
    for (const char* field : {"question", "next", "settings", "verdict"}) report[field] = evil;
    for (const char* field : {"title", "confidence", "shows", "why", "fix"}) report["mistake"][field] = evil;
    for (const char* field : {"own_files", "earlier", "verdict_lines"}) report[field] = Json::array({evil});
    report["checks"] = {check(evil, "failed", 1, {evil}), check(evil, evil, 1, {evil}),
                        check(evil, "ok", 1, {evil})};
    return report;
}

/// Returns the page without its pictures, whose base64 may contain anything.
std::string without_pictures(std::string page) {
    const std::string opening = "data:image/png;base64,";
    for (std::size_t at = 0; (at = page.find(opening, at)) != std::string::npos;) {
        at += opening.size();
        page.erase(at, page.find('"', at) - at);
    }
    return page;
}

int count(const std::string& text, const std::string& part) {
    int n = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
    return n;
}

/// Removes the text between `from` and `to`, every time, and keeps the two.
std::string cut(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;) {
        at += from.size();
        const std::size_t end = text.find(to, at);
        REQUIRE_MESSAGE(end != std::string::npos, ("no " + to + " after " + from));
        text.erase(at, end - at);
    }
    return text;
}

/// Returns the first tag that closes nothing or stays open; empty if all are balanced.
std::string unbalanced_tag(std::string page) {
    page = cut(cut(cut(page, "<!--", "-->"), "<style>", "</style>"), "<script>", "</script>");
    page = cut(page, "<script type=\"application/json\" id=\"data\">", "</script>");
    const std::vector<std::string> alone = {"!doctype", "!----", "meta", "link", "br", "img", "input", "hr"};
    std::vector<std::string> open;
    for (std::size_t at = 0; (at = page.find('<', at)) != std::string::npos; ++at) {
        const bool closes = page[at + 1] == '/';
        const std::size_t begin = at + 1 + (closes ? 1 : 0);
        const std::string tag = page.substr(begin, page.find_first_of(" \n>", begin) - begin);
        if (closes) {
            if (open.empty() || open.back() != tag) return "/" + tag;
            open.pop_back();
        } else if (std::find(alone.begin(), alone.end(), tag) == alone.end()) {
            open.push_back(tag);
        }
    }
    return open.empty() ? "" : open.back();
}

} // namespace

TEST_CASE("base64 encodes the examples of the standard") {
    const std::pair<const char*, const char*> examples[] = {{"", ""},
                                                            {"f", "Zg=="},
                                                            {"fo", "Zm8="},
                                                            {"foo", "Zm9v"},
                                                            {"foob", "Zm9vYg=="},
                                                            {"fooba", "Zm9vYmE="},
                                                            {"foobar", "Zm9vYmFy"}};
    for (const auto& [bytes, text] : examples) CHECK(base64(bytes) == text);
    CHECK(base64("\xFB\xFF\xFE") == "+//+");
}

TEST_CASE("an embedded text is JSON in which nothing can end a script") {
    CHECK(script_safe_json("plain \xC3\xA4 \xE2\x82\xAC \xF0\x9F\x98\x80") ==
          "\"plain \xC3\xA4 \xE2\x82\xAC \xF0\x9F\x98\x80\"");
    CHECK(script_safe_json("\"\\\n\t\x7F") == "\"\\\"\\\\\\n\\t\\u007f\"");
    CHECK(script_safe_json("</script>&") == "\"\\u003c/script\\u003e\\u0026\"");
    CHECK(script_safe_json(std::string("\0", 1)) == "\"\\u0000\"");
    CHECK(script_safe_json("a\xFFz") == "\"a\xEF\xBF\xBDz\""); // not UTF-8
}

TEST_CASE("the report contains its three pictures and that of the mistake") {
    const Folder folder;
    const Json report = some_report(folder);
    const std::string page = report_html(root, report);
    for (const std::string path : {report["pictures"]["mine"], report["pictures"]["reference"],
                                   report["pictures"]["map"], report["mistake"]["picture"]}) {
        CAPTURE(path);
        CHECK(count(page, base64(bytes_of(path))) == 1);
    }
    CHECK(count(page, "data:image/png;base64,") == 4);
}

TEST_CASE("the report requests nothing from a network") {
    const Folder folder;
    const std::string page = without_pictures(report_html(root, some_report(folder)));
    for (const char* part : {"http:", "https:", "//", "@import", "url(", "<link", "<iframe", "src=\"",
                             "fetch(", "XMLHttpRequest", "WebSocket", "import("})
        CHECK_MESSAGE(!contains(page, part), ("there is a " + std::string(part) + " in the page"));
    CHECK(contains(page, "default-src 'none'"));
}

TEST_CASE("the report's tags are balanced") {
    const Folder folder;
    CHECK(unbalanced_tag(report_html(root, some_report(folder))) == "");
    CHECK(unbalanced_tag(report_html(root, evil_report(folder))) == "");
    CHECK(unbalanced_tag("<p><b></p></b>") == "/p"); // checks the function itself
    CHECK(unbalanced_tag("<p><br>") == "p");
}

TEST_CASE("foreign text is never markup in the report") {
    const Folder folder;
    const std::string page = report_html(root, evil_report(folder)),
                      tame = report_html(root, some_report(folder));
    CHECK(!contains(page, "<img src=x"));
    CHECK(!contains(page, "<script>window.harm"));
    for (const char* part : {"<", ">", "&"}) CHECK(count(page, part) == count(tame, part));
    CHECK(contains(page, "\\u003c/script\\u003e\\u003cscript\\u003ewindow.harm = 1"));
}

const char* const report_fields[] = {"\"step\":\"03_mirror\"",
                                     "\"question\":\"what does the mirror see?\"",
                                     "\"own_files\":[\"03_mirror/mirror.h\"]",
                                     "\"01_spheres: 67 of 67 checks\"",
                                     "\"verdict\":\"different\"",
                                     "Too bright by 12 %",
                                     "\"flip_mean\":0.0731",
                                     "\"flip_max\":0.8124",
                                     "\"tiles_over_4\":17",
                                     "\"title\":\"the part along",
                                     "\"confidence\":\"very likely",
                                     "\"shows\":\"reflections are",
                                     "\"why\":\"d.n is",
                                     "\"fix\":\"write",
                                     "\"next\":\"./learn hint 03 reflect\"",
                                     "\"settings\":\"640 x 400",
                                     "\"width\":640",
                                     "\"height\":400",
                                     "\"seconds\":null",
                                     "\"seconds\":0.0026",
                                     "\"state\":\"unfinished\"",
                                     "\"expected 0.6 within 1e-05, got -0.6\""};

TEST_CASE("every field of the report is in its data") {
    const Folder folder;
    Json report = some_report(folder);
    report["tiles_over_4"] = 17;
    report["checks"][0]["seconds"] = std::numeric_limits<double>::quiet_NaN();
    const std::string page = report_html(root, report);
    for (const char* part : report_fields)
        CHECK_MESSAGE(contains(page, part), ("there is no " + std::string(part)));
}

TEST_CASE("a report without pictures or a mistake is a valid page too") {
    const std::string page = report_html(root, unbuilt_report());
    CHECK(count(page, "data:image/png") == 0);
    CHECK(contains(page, "\"pictures\":{}"));
    CHECK(contains(page, "\"mistake\":null"));
    CHECK(contains(page, "\"tiles_over_4\":null"));
    CHECK(unbalanced_tag(page) == "");
}

TEST_CASE("a mistake whose picture does not exist yet is reported without it") {
    const Folder folder;
    Json report = some_report(folder);
    report["mistake"]["picture"] = folder / "not_yet.png";
    CHECK(count(report_html(root, report), "data:image/png;base64,") == 3);
    report["mistake"].erase("picture");
    CHECK(count(report_html(root, report), "data:image/png;base64,") == 3);
}

TEST_CASE("a picture that cannot be shown is an error that names it") {
    const Folder folder;
    const auto error = [&](auto change) {
        Json report = some_report(folder);
        change(report);
        return error_of([&] { report_html(root, report); });
    };
    CHECK_ERROR(error([&](Json& r) { r["pictures"]["mine"] = folder / "gone.png"; }),
                "gone.png: no such file");
    folder.write("text.png", "This is a text of more than twenty-four bytes.");
    CHECK_ERROR(error([&](Json& r) { r["pictures"]["map"] = folder / "text.png"; }),
                "text.png: is not a PNG file");
    folder.write("short.png", bytes_of(references + "03_mirror.png").substr(0, 20));
    CHECK_ERROR(error([&](Json& r) { r["mistake"]["picture"] = folder / "short.png"; }),
                "short.png: is not a PNG file");
    CHECK_ERROR(error([&](Json& r) { r["pictures"]["reference"] = references + "08_indirect.png"; }),
                "08_indirect.png", "differs in size", "mine.png");
}

TEST_CASE("a frame that is missing or has no place for the data is an error that names it") {
    const Folder folder;
    Json report = unbuilt_report();
    const auto error = [&] { return error_of([&] { report_html(folder.path, report); }); };
    CHECK_ERROR(error(), "tools/tutor/report.html: no such file");
    folder.write("tools/tutor/page.js", "");
    folder.write("tools/tutor/report.html", "<html>{{page.js}}</html>");
    CHECK_ERROR(error(), "tools/tutor/report.html: {{data}} must occur in it exactly once");
    folder.write("tools/tutor/report.html", "{{page.js}} {{data}} {{data}}");
    CHECK_ERROR(error(), "tools/tutor/report.html: {{data}} must occur in it exactly once");
    folder.write("tools/tutor/report.html", "<{{data}}>{{page.js}}");
    CHECK(error() == "no error");
}

TEST_CASE("reports of each kind are written for the browser, and each is of moderate size") {
    const Folder folder;
    const std::filesystem::path out = RT_REPORTS;
    std::filesystem::create_directories(out);
    Json single = some_report(folder);
    single["pictures"].erase("mine");
    single["pictures"].erase("map");
    single["verdict"] = "the program was stopped after 10 s";
    Json unknown = some_report(folder);
    unknown["mistake"] = nullptr;
    const std::pair<const char*, Json> reports[] = {
        {"wrong", some_report(folder)}, {"good", good_report()}, {"unbuilt", unbuilt_report()},
        {"evil", evil_report(folder)},  {"single", single},      {"unknown", unknown}};
    for (const auto& [name, report] : reports) {
        const std::string file = text_of(out / (std::string(name) + ".html"));
        write_file(file, report_html(root, report));
        CHECK(std::filesystem::file_size(file) > 20'000);
        CHECK(std::filesystem::file_size(file) < 4'000'000);
    }
}
