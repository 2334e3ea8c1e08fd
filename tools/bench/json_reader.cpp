// A recursive descent through the grammar of RFC 8259.

#include "tools/bench/json_reader.h"

#include "common/util/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
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
        json.number = digits();
        return json;
    }

    /// Not by std::from_chars, which not every standard library has for a double.
    double digits() {
        const std::size_t end = std::min(text.find_first_not_of("+-.0123456789eE", place), text.size());
        const std::string word(text.substr(place, end - place));
        char* rest = nullptr;
        const double number = std::strtod(word.c_str(), &rest);
        if (rest == word.c_str() || word[0] == '+' || !std::isfinite(number)) fail("a value is missing");
        place += std::size_t(rest - word.c_str());
        return number;
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
            json.names.push_back(rest_of_text());
            demand(":");
            json.list.push_back(value(depth + 1));
        } while (take(","));
        demand("}");
        return json;
    }

    std::string rest_of_text() {
        std::string out;
        while (place < text.size() && text[place] != '"') {
            if (text[place] == '\\' && place + 1 < text.size())
                out += escaped();
            else
                out += text[place++];
        }
        demand("\"");
        return out;
    }

    /// The character of the escape that begins here. \u stands for ASCII alone: json::text writes no other.
    char escaped() {
        constexpr std::string_view letters = "bfnrt", characters = "\b\f\n\r\t";
        const char kind = text[place + 1];
        place += 2;
        if (kind != 'u') {
            const std::size_t i = letters.find(kind);
            return i == std::string_view::npos ? kind : characters[i];
        }
        const std::string_view digits = text.substr(place, 4);
        unsigned code = 0;
        const auto [end, problem] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
        if (problem != std::errc() || end - digits.data() != 4 || code > 0x7F) fail("an escape is not ASCII");
        place += 4;
        return char(code);
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
    for (std::size_t i = 0; i < object.names.size(); ++i)
        if (object.names[i] == name) return object.list[i];
    return null;
}

double number_of(const Json& value) {
    return value.kind == Json::Kind::number ? value.number : std::numeric_limits<double>::quiet_NaN();
}

} // namespace rt::bench
