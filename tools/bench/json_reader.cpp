// A recursive descent through the grammar of RFC 8259.

#include "tools/bench/json_reader.h"

#include "common/error.h"

#include <charconv>
#include <limits>

namespace rt::bench {

namespace {

class Reader {
  public:
    explicit Reader(std::string_view all) : text(all) {}

    Json whole() {
        const Json json = value(0);
        skip_space();
        if (place < text.size()) fail("something follows the end");
        return json;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        throw Error("this is not JSON: " + what + " at byte " + std::to_string(place));
    }

    void skip_space() {
        while (place < text.size() &&
               (text[place] == ' ' || text[place] == '\n' || text[place] == '\r' || text[place] == '\t'))
            ++place;
    }

    bool take(std::string_view word) {
        skip_space();
        if (text.substr(place, word.size()) != word) return false;
        place += word.size();
        return true;
    }

    void demand(std::string_view word) {
        if (!take(word)) fail(std::string(word) + " is missing");
    }

    Json value(int depth) {
        if (depth > 64) fail("too deep a nesting");
        Json json;
        if (take("null")) return json;
        if (take("true")) return json.kind = Json::Kind::boolean, json.number = 1, json;
        if (take("false")) return json.kind = Json::Kind::boolean, json;
        if (take("{")) return fields(depth);
        if (take("[")) return list(depth);
        if (take("\"")) return json.kind = Json::Kind::text, json.text = rest_of_text(), json;
        json.kind = Json::Kind::number;
        const auto [end, problem] =
            std::from_chars(text.data() + place, text.data() + text.size(), json.number);
        if (problem != std::errc()) fail("a value is missing");
        place = std::size_t(end - text.data());
        return json;
    }

    Json list(int depth) {
        Json json;
        json.kind = Json::Kind::list;
        if (take("]")) return json;
        do json.list.push_back(value(depth + 1));
        while (take(","));
        demand("]");
        return json;
    }

    Json fields(int depth) {
        Json json;
        json.kind = Json::Kind::fields;
        if (take("}")) return json;
        do {
            demand("\"");
            std::string name = rest_of_text();
            demand(":");
            json.fields.emplace_back(std::move(name), value(depth + 1));
        } while (take(","));
        demand("}");
        return json;
    }

    /// What no benchmark writes, \u and its digits, is kept as it stands.
    std::string rest_of_text() {
        std::string out;
        while (place < text.size() && text[place] != '"') {
            if (text[place] == '\\' && place + 1 < text.size() && text[place + 1] != 'u') {
                ++place;
                out += text[place] == 'n' ? '\n' : text[place] == 't' ? '\t' : text[place];
            } else {
                out += text[place];
            }
            ++place;
        }
        demand("\"");
        return out;
    }

    std::string_view text;
    std::size_t place = 0;
};

} // namespace

Json parse_json(std::string_view text) {
    return Reader(text).whole();
}

const Json& field(const Json& object, std::string_view name) {
    static const Json null;
    for (const auto& [key, value] : object.fields)
        if (key == name) return value;
    return null;
}

double number_of(const Json& value) {
    return value.kind == Json::Kind::number ? value.number : std::numeric_limits<double>::quiet_NaN();
}

} // namespace rt::bench
