// Command-line options, parsed by CLI11. Errors name the option, what was typed, and what is valid.

#include "common/cli/options.h"

#include "common/cli/option_values.h"
#include "common/render/render.h"
#include "common/util/error.h"
#include "common/util/suggestion.h"
#include "common/util/text.h"
#include "common/util/version.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

namespace rt {

namespace {

/// Wraps `text` at `width` columns: a line of --help has 80, of which the names take 25.
std::string wrapped(std::string text, std::size_t width = 55) {
    for (std::size_t start = 0; text.size() - start > width;) {
        const std::size_t blank = text.rfind(' ', start + width);
        if (blank == std::string::npos || blank < start) break;
        text[blank] = '\n';
        start = blank + 1;
    }
    return text;
}

const CLI::Validator not_empty([](auto& s) { return s.empty() ? "the name of the file is empty" : ""; }, "");

} // namespace

struct Options::Parser {
    CLI::App app;
    RenderSettings settings;
    std::string crop;  ///< as typed; checked after parsing, since it depends on the size of the image
    std::string group; ///< section of --help for the options declared next
    std::deque<std::variant<bool, int, float, dvec3, std::string>> values;

    template <typename Value>
    Value& store(Value initial) {
        return std::get<Value>(values.emplace_back(std::move(initial)));
    }

    /// Declares an option with a value, or a flag if `metavar` is empty. `read` parses the
    /// value; it may throw Error.
    CLI::Option* add(const std::string& name, const std::string& metavar, const std::string& help,
                     const std::function<void(const std::string& text)>& read) {
        const std::string flag = "--" + name;
        if (app.get_option_no_throw(flag)) throw std::logic_error("two options are called " + flag);
        const auto take = [=](const std::vector<std::string>& typed) {
            if (typed.size() > 1) throw Error(flag + " is given twice: keep one");
            if (metavar.empty() && typed[0] != "true")
                throw Error(flag + " takes no value: leave out " + in_quotes(typed[0]));
            if (!metavar.empty() && typed[0].rfind("--", 0) == 0) // CLI11 took the next option as the value
                throw Error(flag + " needs a value: " + flag + " " + metavar);
            read(typed[0]);
            return true;
        };
        CLI::Option* const option = app.add_option(flag, take, wrapped(help));
        option->option_text(metavar)->group(group)->expected(metavar.empty() ? 0 : 1);
        return option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    }

    template <typename Number>
    void add_number(const std::string& name, Number& value, Number low, Number high,
                    const std::string& help) {
        if (!(low <= value && value <= high))
            throw std::logic_error("the default of --" + name + " is out of its own range");
        constexpr bool whole = std::is_integral_v<Number>;
        const std::string range = text_of(low) + " to " + text_of(high);
        add(name, whole ? "N" : "X", help + " [" + range + "; default " + text_of(value) + "]",
            [=, &value](const std::string& text) { value = parse_number(name, text, low, high); });
    }

    CLI::Option* add_text(const std::string& name, const std::string& metavar, std::string& value,
                          const std::string& help) {
        return add(name, metavar, help, [&value](const std::string& text) { value = text; });
    }

    void add_image_options() {
        group = "Image";
        add_number("width", settings.width, 1, max_image_dimension, "columns of the whole image, in pixels");
        add_number("height", settings.height, 1, max_image_dimension, "rows of the whole image, in pixels");
        add_number("samples", settings.samples, 1, 1 << 20, "samples per pixel");
        add_number("seed", settings.seed, std::uint64_t(0), ~std::uint64_t(0),
                   "a different seed gives different noise");
        add_text("crop", "X0,Y0,X1,Y1", crop,
                 "render only columns x0 <= x < x1 and rows y0 <= y < y1 of the whole, in pixels from the "
                 "top left "
                 "[inside the image; default the whole image]");
        group = "Output";
        add_text(
            "out", "FILE", settings.out,
            "the image's file: NAME.png (8-bit sRGB), NAME.hdr (linear light), or NAME for both [default " +
                settings.out + "]")
            ->check(not_empty);
        add_text(
            "variance", "FILE", settings.variance,
            "also write the variance of each pixel's mean luminance: NAME.hdr; needs --samples 2 or more "
            "[default none]")
            ->check(not_empty);
        add_number("threads", settings.threads, 0, 1024,
                   "rendering threads; 0: one per core that the process may use");
        add("quiet", "", "print only the names of the files written, and errors",
            [this](const std::string&) { settings.quiet = true; });
    }

    void refuse_extras() const {
        const std::vector<std::string> extras = app.remaining();
        if (extras.empty()) return;
        const std::string word = extras.front().substr(0, extras.front().find('='));
        if (word.size() < 2 || word[0] != '-')
            throw Error(in_quotes(word) +
                        " has no option before it: every value follows its option, as in --width 640");
        std::vector<std::string> names;
        for (const CLI::Option* option : app.get_options()) names.push_back(option->get_lnames().front());
        const std::string letters = word.substr(std::min(word.find_first_not_of('-'), word.size()));
        throw Error(in_quotes(word) + " is not an option of " + app.get_name() +
                    suggestion(letters, names, "--") + ": --help lists them all");
    }
};

Options::Options(std::string name, std::string question, RenderSettings settings)
    : parser(std::make_unique<Parser>()) {
    const std::string own_group = "This step's options";
    CLI::App& app = parser->app;
    app.name(name);
    app.description(name + ": " + question);
    app.allow_extras();
    app.allow_windows_style_options(false);
    app.get_formatter()->column_width(25);
    app.set_help_flag(); // CLI11 handles its own --help after the values, which would have to be valid
    app.add_flag_callback(
           "-h,--help", [] { throw CLI::CallForHelp(); }, "print this help")
        ->group(own_group);
    app.set_version_flag("--version", version(), "print the version")->group(own_group);
    parser->settings = std::move(settings);
    if (parser->settings.out.empty()) parser->settings.out = name;
    parser->add_image_options();
    parser->group = own_group;
}

Options::~Options() = default;

template <typename Number>
const Number& Options::option(const std::string& name, Number initial, Number low, Number high,
                              const std::string& help) {
    Number& value = parser->store(initial);
    parser->add_number(name, value, low, high, help);
    return value;
}
template const float& Options::option(const std::string&, float, float, float, const std::string&);
template const int& Options::option(const std::string&, int, int, int, const std::string&);

const dvec3& Options::option(const std::string& name, vec3 initial, const std::string& help) {
    dvec3& value = parser->store(dvec3(initial));
    const std::string usual = text_of(initial.x) + "," + text_of(initial.y) + "," + text_of(initial.z);
    parser->add(name, "X,Y,Z", help + " [three numbers; default " + usual + "]",
                [=, &value](const std::string& text) { value = parse_vector(name, text); });
    return value;
}

const bool& Options::flag(const std::string& name, const std::string& help) {
    bool& value = parser->store(false);
    parser->add(name, "", help, [&value](const std::string&) { value = true; });
    return value;
}

const std::string& Options::file(const std::string& name, const std::string& help) {
    std::string& value = parser->store(std::string());
    parser->add_text(name, "FILE", value, help + " [default none]")->check(CLI::ExistingFile);
    return value;
}

const int& Options::choice_index(const std::string& name, const std::vector<std::string>& names, int initial,
                                 const std::string& help) {
    int& value = parser->store(initial);
    parser->add(name, "NAME",
                help + " [" + one_of(names) + "; default " + names.at(std::size_t(initial)) + "]",
                [=, &value](const std::string& text) { value = parse_choice(name, text, names); });
    return value;
}

bool Options::is_set(const std::string& name) const {
    const CLI::Option* const option = parser->app.get_option_no_throw("--" + name);
    if (!option) throw std::logic_error("no option is called --" + name);
    return option->count() > 0;
}

bool Options::parse(int argc, const char* const* argv) {
    std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    std::reverse(words.begin(), words.end()); // CLI11 consumes the arguments from the back
    try {
        parser->app.parse(words);
    } catch (const CLI::Success& asked) { // --help or --version
        const bool help = asked.get_name() == "CallForHelp";
        std::cout << (help ? parser->app.help() : version() + std::string("\n")) << std::flush;
        return false;
    } catch (const CLI::ArgumentMismatch& error) { // "--width: 1 required N missing"
        const std::string text = error.what(), flag = text.substr(0, text.find(':'));
        throw Error(flag + " needs a value: " + flag + " " + parser->app.get_option(flag)->get_option_text());
    } catch (const CLI::ParseError& error) {
        throw Error(error.what());
    }
    parser->refuse_extras(); // after the values: one without a value may have taken the next option
    RenderSettings& settings = parser->settings;
    settings.crop = {0, 0, settings.width, settings.height};
    if (is_set("crop")) settings.crop = parse_crop(parser->crop, settings.width, settings.height);
    if (const std::string problem = size_error(settings.crop); !problem.empty())
        throw Error("the image " + problem +
                    ": make --width and --height smaller, or render a part with --crop");
    return true;
}

const RenderSettings& Options::settings() const {
    return parser->settings;
}

const std::string& Options::name() const {
    return parser->app.get_name();
}

} // namespace rt
