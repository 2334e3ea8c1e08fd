// Stands for common/cli/options.cpp: options are declared to the page as JSON and parsed from words, without CLI11.
#include "common/cli/options.h"

#include "common/cli/option_values.h"
#include "common/util/error.h"
#include "common/util/suggestion.h"
#include "common/util/text.h"
#include "site/twins/page.h"

#include <algorithm>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

namespace rt {
namespace {

constexpr std::int64_t max_page_pixels = 1 << 22;

std::string quoted(const std::string& text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        out += c;
    }
    return out + "\"";
}

} // namespace

struct Options::Parser {
    struct Option {
        std::string name, json;
        bool takes_value;
        std::function<void(const std::string& text)> read;
        bool is_set = false;
    };

    std::string name, question, crop;
    RenderSettings settings;
    std::deque<Option> options;
    std::deque<std::variant<bool, int, float, dvec3, std::string>> values;

    template <typename Value>
    Value& store(Value initial) {
        return std::get<Value>(values.emplace_back(std::move(initial)));
    }

    /// Declares an option; `more` are the fields of its JSON that belong to its kind.
    void add(const std::string& option, const std::string& kind, const std::string& more,
             const std::string& help, const std::function<void(const std::string& text)>& read) {
        if (find(option)) throw std::logic_error("two options are called --" + option);
        options.push_back({option,
                           "{\"name\":" + quoted(option) + ",\"kind\":" + quoted(kind) + more +
                               ",\"help\":" + quoted(help) + "}",
                           kind != "flag", read});
    }

    template <typename Number>
    void add_number(const std::string& option, const std::string& kind, Number& value, Number low,
                    Number high, const std::string& help) {
        add(option, kind,
            ",\"low\":" + text_of(low) + ",\"high\":" + text_of(high) + ",\"initial\":" + text_of(value),
            help, [=, &value](const std::string& text) { value = parse_number(option, text, low, high); });
    }

    Option* find(const std::string& wanted) {
        for (Option& option : options)
            if (option.name == wanted) return &option;
        return nullptr;
    }

    Option& named(const std::string& word) {
        Option* const option = word.starts_with("--") ? find(word.substr(2)) : nullptr;
        if (option) return *option;
        std::vector<std::string> names;
        for (const Option& each : options) names.push_back(each.name);
        const std::string letters = word.substr(std::min(word.find_first_not_of('-'), word.size()));
        throw Error(in_quotes(word) + " is not an option of " + name + suggestion(letters, names, "--"));
    }

    std::string json() const {
        std::string all;
        for (const Option& option : options) all += (all.empty() ? "" : ",") + option.json;
        return "{\"program\":" + quoted(name) + ",\"question\":" + quoted(question) + ",\"options\":[" + all +
               "]}";
    }
};

Options::Options(std::string name, std::string question, RenderSettings settings)
    : parser(std::make_unique<Parser>()) {
    parser->name = std::move(name);
    parser->question = std::move(question);
    RenderSettings& s = parser->settings = std::move(settings);
    parser->add_number("width", "image", s.width, 1, max_image_dimension,
                       "columns of the whole image, in pixels");
    parser->add_number("height", "image", s.height, 1, max_image_dimension,
                       "rows of the whole image, in pixels");
    parser->add_number("samples", "image", s.samples, 1, 1 << 20, "samples per pixel");
    parser->add_number("seed", "image", s.seed, std::uint64_t(0), ~std::uint64_t(0),
                       "a different seed gives different noise");
    parser->add("crop", "image", "", "a part of the whole image",
                [this](const std::string& text) { parser->crop = text; });
}

Options::~Options() = default;

template <typename Number>
const Number& Options::option(const std::string& name, Number initial, Number low, Number high,
                              const std::string& help) {
    Number& value = parser->store(initial);
    parser->add_number(name, std::is_integral_v<Number> ? "whole" : "number", value, low, high, help);
    return value;
}
template const float& Options::option(const std::string&, float, float, float, const std::string&);
template const int& Options::option(const std::string&, int, int, int, const std::string&);

const dvec3& Options::option(const std::string& name, vec3 initial, const std::string& help) {
    dvec3& value = parser->store(dvec3(initial));
    const std::string usual = text_of(initial.x) + "," + text_of(initial.y) + "," + text_of(initial.z);
    parser->add(name, "vector", ",\"initial\":[" + usual + "]", help,
                [=, &value](const std::string& text) { value = parse_vector(name, text); });
    return value;
}

const bool& Options::flag(const std::string& name, const std::string& help) {
    bool& value = parser->store(false);
    parser->add(name, "flag", "", help, [&value](const std::string&) { value = true; });
    return value;
}

const std::string& Options::file(const std::string& name, const std::string& help) {
    std::string& value = parser->store(std::string());
    parser->add(name, "file", "", help, [&value](const std::string& text) { value = text; });
    return value;
}

const int& Options::choice_index(const std::string& name, const std::vector<std::string>& names, int initial,
                                 const std::string& help) {
    int& value = parser->store(initial);
    std::string list;
    for (const std::string& choice : names) list += (list.empty() ? "" : ",") + quoted(choice);
    parser->add(name, "choice",
                ",\"names\":[" + list + "],\"initial\":" + quoted(names.at(std::size_t(initial))), help,
                [=, &value](const std::string& text) { value = parse_choice(name, text, names); });
    return value;
}

bool Options::is_set(const std::string& name) const {
    return parser->find(name)->is_set;
}

bool Options::parse(int argc, const char* const* argv) {
    const std::string declared = parser->json();
    page_declare(declared.data(), declared.size());
    for (int i = 1; i < argc; ++i) {
        Parser::Option& option = parser->named(argv[i]);
        if (option.takes_value && i + 1 == argc) throw Error(std::string(argv[i]) + " needs a value");
        option.read(option.takes_value ? argv[++i] : "");
        option.is_set = true;
    }
    RenderSettings& settings = parser->settings;
    settings.crop = {0, 0, settings.width, settings.height};
    if (is_set("crop")) settings.crop = parse_crop(parser->crop, settings.width, settings.height);
    if (std::int64_t(settings.width) * settings.height > max_page_pixels)
        throw Error("a picture of this size does not fit in a page: make --width and --height smaller");
    return true;
}

const RenderSettings& Options::settings() const {
    return parser->settings;
}

const std::string& Options::name() const {
    return parser->name;
}

} // namespace rt
