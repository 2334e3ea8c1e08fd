// Reads JSON back: enough for what the benchmarks write.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rt::bench {

/// A value: null, true or false, a number, a text, a list, or named fields.
struct Json {
    enum class Kind { null, boolean, number, text, list, fields };
    Kind kind = Kind::null;
    double number = 0; ///< 1 and 0 for true and false
    std::string text;
    std::vector<Json> list;
    std::vector<std::pair<std::string, Json>> fields;
};

/// Throws Error, with the place, if this is not JSON.
Json parse_json(std::string_view text);

/// The field of this name, or null.
const Json& field(const Json& object, std::string_view name);

/// A number, or not a number.
double number_of(const Json& value);

} // namespace rt::bench
