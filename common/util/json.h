// JSON by nlohmann-json, whose objects keep their fields in the order in which they were added.
#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace rt {

using Json = nlohmann::ordered_json;

namespace json {

/// Returns the text of a value, on one line or with an indent per level. Numbers that are not finite become
/// null; bytes that are not UTF-8 become U+FFFD.
inline std::string text(const Json& value, int indent = -1) {
    return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace json
} // namespace rt
