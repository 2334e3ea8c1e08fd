// Writes report.html: inserts the findings as JSON, with pictures as data URLs, into a template.
#include "tools/tutor/report.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/util/paths.h"

#include <cstdint>

namespace rt::tutor {

namespace {

/// Replaces the placeholder, which must occur once in a template. Throws Error.
void fill_in(std::string& page, std::string_view place, const std::string& text, const std::string& path) {
    const std::size_t at = page.find(place);
    if (at == std::string::npos || page.find(place, at + 1) != std::string::npos)
        throw Error(path + ": " + std::string(place) + " must occur in it exactly once");
    page.replace(at, place.size(), text);
}

std::uint32_t byte_at(std::string_view bytes, std::size_t i) {
    return i < bytes.size() ? static_cast<std::uint8_t>(bytes[i]) : 0;
}

/// A PNG file, with the width and height from its header.
struct Picture {
    std::string bytes;
    std::uint32_t width = 0, height = 0;

    explicit Picture(const std::string& path) : bytes(read_file(path)) {
        constexpr std::string_view opening("\x89PNG\r\n\x1A\n\0\0\0\rIHDR", 16); // then width and height
        if (bytes.size() < 24 || !bytes.starts_with(opening))
            throw Error(path + ": is not a PNG file; render it again");
        for (std::size_t i = 0; i < 4; ++i) {
            width = width << 8 | byte_at(bytes, 16 + i);
            height = height << 8 | byte_at(bytes, 20 + i);
        }
    }
    std::string url() const { return "data:image/png;base64," + base64(bytes); }
};

/// Replaces the paths of pictures by the pictures. They are shown on top of each other, so they must have
/// the same size.
void embed_pictures(Json& pictures) {
    std::string first;
    for (const char* const name : {"mine", "reference", "map"}) {
        const std::string path = pictures.value(name, "");
        pictures.erase(name);
        if (path.empty()) continue;
        const Picture picture(path);
        if (first.empty()) first = path;
        if (pictures.value("width", picture.width) != picture.width ||
            pictures.value("height", picture.height) != picture.height)
            throw Error(path + ": differs in size from " + first +
                        "; a report needs pictures of the same size");
        pictures["width"] = picture.width;
        pictures["height"] = picture.height;
        pictures[name] = picture.url();
    }
}

void embed_mistake(Json& mistake) {
    if (!mistake.is_object()) return;
    const std::string path = mistake.value("picture", "");
    mistake.erase("picture");
    std::error_code ignored;
    if (std::filesystem::exists(path_of(path), ignored)) mistake["picture"] = Picture(path).url();
}

} // namespace

std::string script_safe_json(const Json& value) {
    std::string out;
    for (const char c : rt::json::text(value)) {
        char escape[8];
        std::snprintf(escape, sizeof escape, "\\u%04x", unsigned(c));
        out += c == '<' || c == '>' || c == '&' || c == '\x7F' ? escape : std::string(1, c);
    }
    return out;
}

std::string base64(std::string_view bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::uint32_t three =
            byte_at(bytes, i) << 16 | byte_at(bytes, i + 1) << 8 | byte_at(bytes, i + 2);
        for (const int shift : {18, 12, 6, 0}) out += digits[three >> shift & 63];
    }
    out.replace(out.size() - (3 - bytes.size() % 3) % 3, out.npos, (3 - bytes.size() % 3) % 3, '=');
    return out;
}

std::string filled_page(const std::filesystem::path& root, const std::string& name, const Json& data) {
    const std::filesystem::path folder = root / "tools/tutor";
    const std::string path = text_of(folder / name);
    std::string page = read_file(path);
    fill_in(page, "{{page.js}}", read_file(text_of(folder / "page.js")), path);
    fill_in(page, "{{data}}", script_safe_json(data), path);
    return page;
}

std::string report_html(const std::filesystem::path& root, Json report) {
    embed_pictures(report["pictures"]);
    embed_mistake(report["mistake"]);
    return filled_page(root, "report.html", report);
}

} // namespace rt::tutor
