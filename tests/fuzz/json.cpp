// JSON: the reader on any text, and both writers of texts, whose output it reads back.
#include "common/json.h"
#include "tests/fuzz/fuzz.h"
#include "tools/bench/json_reader.h"
#include "tools/tutor/embed.h"

#include <algorithm>

namespace rt::fuzz {

namespace {

/// How many bytes a character of UTF-8 has that begins with this one; 0 if none does.
std::size_t length_of(unsigned char first) {
    if (first < 0x80) return 1;
    if (first < 0xc2 || first > 0xf4) return 0;
    return first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
}

/// Whether it is made of the bytes of UTF-8; characters that have several spellings or none are not looked for.
bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = length_of(static_cast<unsigned char>(text[0]));
        if (length == 0 || length > text.size()) return false;
        const auto goes_on = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
        if (!std::ranges::all_of(text.substr(1, length - 1), goes_on)) return false;
        text.remove_prefix(length);
    }
    return true;
}

bool has_control(std::string_view text) {
    return std::ranges::any_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

std::string read_back(const std::string& json) {
    const bench::Json read = bench::parse_json(json);
    require(read.kind == bench::Json::Kind::text, "a text is written as a text");
    return read.text;
}

} // namespace

void run_json(std::string_view bytes) {
    refusal([&] {
        const bench::Json read = bench::parse_json(bytes);
        bench::number_of(bench::field(read, "a"));
    });
    const std::string text = json_text(bytes);
    require(!has_control(text), "no control character stands in JSON");
    const std::string read = read_back(text);
    if (is_utf8(bytes) && !has_control(bytes)) require(read == bytes, "what is written is read back");
    const std::string embedded = embedded_text(bytes);
    read_back(embedded);
    require(is_utf8(embedded) && !has_control(embedded), "an embedded text is UTF-8");
    require(embedded.find_first_of("<>&") == std::string::npos, "an embedded text ends no element");
}

} // namespace rt::fuzz
