// The report: what is known as JSON, the pictures as data URLs, both put into the page's frame.
#include "tools/tutor/report.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/embed.h"

#include <cmath>
#include <cstdio>
#include <string_view>

namespace rt {
namespace {

/// Stands once in the frame, where the data goes.
constexpr std::string_view place = "{{report}}";

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return std::isfinite(value) ? text : "null";
}

/// A JSON object that grows by one field at a time.
class Object {
  public:
    Object& json(std::string_view name, const std::string& value) {
        text += (text.size() > 1 ? ",\n" : "") + embedded_text(name) + ": " + value;
        return *this;
    }
    Object& add(std::string_view name, const std::string& value) { return json(name, embedded_text(value)); }
    Object& add(std::string_view name, double value) { return json(name, number(value)); }
    std::string done() const { return text + "}"; }

  private:
    std::string text = "{";
};

template <typename Element, typename Write>
std::string array(const std::vector<Element>& elements, Write write) {
    std::string text = "[";
    for (const Element& element : elements) text += (text.size() > 1 ? ",\n" : "") + write(element);
    return text + "]";
}

std::string lines(const std::vector<std::string>& texts) {
    return array(texts, embedded_text);
}

std::string check(const ReportCheck& check) {
    return Object()
        .add("name", check.name)
        .add("state", check.state)
        .add("seconds", check.seconds)
        .json("lines", lines(check.lines))
        .done();
}

std::string mistake(const Report& report) {
    if (report.mistake_title.empty()) return "null";
    Object object;
    object.add("title", report.mistake_title)
        .add("confidence", report.mistake_confidence)
        .add("shows", report.mistake_shows)
        .add("why", report.mistake_why)
        .add("fix", report.mistake_fix);
    std::error_code ignored;
    if (std::filesystem::exists(report.mistake_picture, ignored))
        object.add("picture", embedded_picture(report.mistake_picture).url);
    return object.done();
}

/// Mine, reference and map, those that there are. They lie over each other, so they have one size.
std::string pictures(const Report& report) {
    Object object;
    EmbeddedPicture first;
    std::string first_path;
    const auto add = [&](std::string_view name, const std::filesystem::path& path) {
        if (path.empty()) return;
        const EmbeddedPicture picture = embedded_picture(path);
        if (first_path.empty()) {
            first_path = path.string();
            first = picture;
            object.add("width", picture.width).add("height", picture.height);
        }
        if (picture.width != first.width || picture.height != first.height)
            throw Error(path.string() + ": has another size than " + first_path +
                        "; a report shows pictures of one size");
        object.add(name, picture.url);
    };
    add("mine", report.mine);
    add("reference", report.reference);
    add("map", report.map);
    return object.done();
}

std::string data(const Report& report) {
    return Object()
        .add("step", report.step)
        .add("question", report.question)
        .json("own_files", lines(report.own_files))
        .json("checks", array(report.checks, check))
        .json("earlier", lines(report.earlier))
        .add("verdict", report.verdict)
        .json("verdict_lines", lines(report.verdict_lines))
        .add("flip_mean", report.flip_mean)
        .add("flip_max", report.flip_max)
        .json("tiles_over_4", report.tiles_over_4 ? std::to_string(*report.tiles_over_4) : "null")
        .json("mistake", mistake(report))
        .add("next", report.next)
        .add("settings", report.settings)
        .json("pictures", pictures(report))
        .done();
}

} // namespace

std::string report_html(const Report& report) {
    const std::string frame = (report.root / "tools/tutor/report.html").string();
    std::string page = read_file(frame);
    const std::size_t at = page.find(place);
    if (at == std::string::npos || page.find(place, at + 1) != std::string::npos)
        throw Error(frame + ": " + std::string(place) +
                    " must stand in it exactly once, where the data goes");
    return page.replace(at, place.size(), data(report));
}

} // namespace rt
