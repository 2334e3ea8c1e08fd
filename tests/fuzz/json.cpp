// Fuzz target for JSON: the benchmark report from any numbers, and both writers of strings, read back.
#include "common/util/json.h"
#include "tests/fuzz/fuzz.h"
#include "tools/bench/report.h"
#include "tools/tutor/report.h"

#include <algorithm>

namespace rt::fuzz {

using namespace tutor;

namespace {

/// Returns the length of the UTF-8 character at the start of the text; 0 if it is
/// invalid (RFC 3629, section 4).
std::size_t character_at(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const unsigned first = byte(0), second = byte(1);
    const std::size_t length = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    for (std::size_t i = 1; i < length; ++i)
        if ((byte(i) & 0xc0) != 0x80) return 0;
    const bool too_short =
        first < 0xc2 || (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
    const bool too_large =
        first > 0xf4 || (first == 0xf4 && second > 0x8f) || (first == 0xed && second > 0x9f);
    return length > 1 && (too_short || too_large) ? 0 : length;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = character_at(text);
        if (length == 0) return false;
        text.remove_prefix(length);
    }
    return true;
}

bool has_control(std::string_view text) {
    return std::ranges::any_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x20; });
}

std::string read_back(const std::string& json) {
    const Json read = Json::parse(json);
    require(read.is_string(), "a string is written as a string");
    return read.get<std::string>();
}

/// Checks the report with these numbers as the results of each type of benchmark.
void check_report(std::string_view bytes) {
    const Json numbers = Json::parse(bytes, nullptr, false);
    if (numbers.is_discarded()) return;
    for (const char* name : {"traversal", "scaling", "renders", "convergence", "obj", "kernels"})
        refusal([&] {
            for (const auto& [plot, data] : bench::make_report({{name, numbers}}, true).plots)
                require(data.starts_with("title = \""), "a plot has a title");
        });
}

} // namespace

void run_json(std::string_view bytes) {
    check_report(bytes);
    const std::string text = json::text(Json(bytes)), safe = script_safe_json(bytes);
    require(!has_control(text) && !has_control(safe), "no control character stands in JSON");
    require(is_utf8(text) && is_utf8(safe), "JSON is UTF-8");
    require(safe.find_first_of("<>&") == std::string::npos, "an embedded text cannot end an element");
    const bool same = read_back(text) == bytes && read_back(safe) == bytes;
    require(same || !is_utf8(bytes), "written text is read back unchanged");
}

} // namespace rt::fuzz
