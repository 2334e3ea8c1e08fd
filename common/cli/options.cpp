// Reads a command line into knobs, and says in one line what is wrong with it. CLI11 takes the line apart;
// what the pieces mean is decided here, so that each message names the flag, what was typed and what fits.

#include "common/cli/options.h"

#include "common/util/error.h"
#include "common/util/version.h"
#include "common/image/image_file.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <utility>

#if __has_include(<unistd.h>)
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace rt {

namespace {

constexpr int longest_side =
    65536; // of the whole picture; what is rendered of it ends at the writers' largest_side
constexpr int most_samples = 1 << 20;
constexpr std::int64_t bytes_per_film_pixel = 24; // two images

using Reader = std::function<void(const std::string& text)>;

struct Knob {
    std::string name;
    std::string metavar; ///< what --help shows for the value; empty for a flag that takes none
    std::string help;
    std::string range; ///< "1 to 2.5"
    std::string initial;
    Reader read; ///< throws Error
    CLI::Option* option = nullptr;

    std::string dashed() const { return "--" + name; }
};

struct Group {
    std::string title;
    std::deque<Knob> knobs;
};

// ---- words ----

/// What was typed, as a message shows it.
std::string shown(const std::string& text) {
    constexpr std::size_t longest = 100;
    if (text.empty()) return "''";
    return text.size() <= longest ? text : text.substr(0, longest) + "...";
}

/// The shortest decimal that reads back as `value`.
std::string decimal(float value) {
    std::array<char, 64> text{};
    if (std::abs(value) < 1e9f && value == std::trunc(value)) {
        std::snprintf(text.data(), text.size(), "%.0f", double(value));
        return text.data();
    }
    for (int digits = 6; digits <= 9; ++digits) {
        std::snprintf(text.data(), text.size(), "%.*g", digits, double(value));
        if (std::strtof(text.data(), nullptr) == value) break;
    }
    return text.data();
}

std::string decimal(vec3 v) {
    return decimal(v.x) + "," + decimal(v.y) + "," + decimal(v.z);
}

template <typename Number>
std::string range_text(Number low, Number high) {
    if constexpr (std::is_floating_point_v<Number>)
        return decimal(low) + " to " + decimal(high);
    else
        return std::to_string(low) + " to " + std::to_string(high);
}

std::string joined(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) line += (line.empty() ? "" : ", ") + word;
    return line;
}

std::vector<std::string> split_at_commas(const std::string& text) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == ',')
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

/// Letters to insert, drop, replace or swap with their neighbour to turn one word into the other
/// (optimal string alignment, a form of the Damerau-Levenshtein distance).
std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            const std::size_t replaced = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replaced});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

/// The candidate that was probably meant, or "".
std::string nearest_word(const std::string& typed, const std::vector<std::string>& candidates) {
    constexpr std::size_t longest =
        40; // no flag is longer, and the distance costs the product of the lengths
    if (typed.empty() || typed.size() > longest) return "";
    std::string nearest;
    std::size_t least = 3;
    for (const std::string& candidate : candidates) {
        const bool begins_it = typed.size() >= 3 && candidate.rfind(typed, 0) == 0;
        const std::size_t distance = begins_it ? 1 : edit_distance(typed, candidate);
        if (distance < least && distance < candidate.size() - candidate.size() / 3) {
            nearest = candidate;
            least = distance;
        }
    }
    return nearest;
}

/// " (did you mean --samples?)" or nothing.
std::string suggestion(const std::string& typed, const std::vector<std::string>& words,
                       const std::string& dashes) {
    const std::string meant = nearest_word(typed, words);
    return meant.empty() ? "" : " (did you mean " + dashes + meant + "?)";
}

// ---- numbers ----

[[noreturn]] void refuse(const std::string& flag, const std::string& text, const std::string& what,
                         const std::string& right) {
    throw Error(flag + " " + shown(text) + " " + what + ": " + right);
}

/// A whole number with nothing before or after it. Overflow counts as out of range.
template <typename Integer>
Integer read_whole(const std::string& flag, const std::string& text, Integer low, Integer high) {
    const std::string range = range_text(low, high);
    const bool negative = text.size() > 1 && text[0] == '-';
    const std::string digits = text.substr(negative || (text.size() > 1 && text[0] == '+') ? 1 : 0);
    if (digits.empty() || digits.find_first_not_of("0123456789") != std::string::npos)
        refuse(flag, text, "is not a whole number", range);
    Integer value = 0;
    const std::string plain =
        (negative && digits.find_first_not_of('0') != std::string::npos ? "-" : "") + digits;
    const auto [end, error] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    if (error != std::errc() || end != plain.data() + plain.size() || value < low || value > high)
        refuse(flag, text, "is out of range", range);
    return value;
}

/// A decimal number with nothing before or after it; `right` is what a message says would be right.
/// Infinite when it is too large, so that no range lets it pass.
double read_decimal(const std::string& flag, const std::string& text, const std::string& right) {
    char* end = nullptr;
    const bool plain = !text.empty() && text.find_first_not_of("+-.0123456789eE") == std::string::npos;
    const double value =
        plain ? std::strtod(text.c_str(), &end) : 0; // also reads "nan", "0x1p3" and leading blanks
    if (!plain || end == text.c_str() || *end != '\0') refuse(flag, text, "is not a number", right);
    return value;
}

dvec3 read_vector(const std::string& flag, const std::string& text) {
    const std::string right = "three numbers x,y,z, as in 0,1.5,-2";
    const std::vector<std::string> parts = split_at_commas(text);
    if (parts.size() != 3) refuse(flag, text, "is not a point or direction", right);
    dvec3 value(0);
    for (int i = 0; i < 3; ++i) {
        value[i] = read_decimal(flag, parts[std::size_t(i)], right);
        if (!std::isfinite(float(value[i]))) refuse(flag, text, "is not finite", right);
    }
    return value;
}

Crop read_crop(const std::string& text) {
    const std::vector<std::string> parts = split_at_commas(text);
    if (parts.size() != 4) refuse("--crop", text, "is not a rectangle", "four whole numbers x0,y0,x1,y1");
    const auto side = [](const std::string& part) { return read_whole("--crop", part, 0, longest_side); };
    return {side(parts[0]), side(parts[1]), side(parts[2]), side(parts[3])};
}

std::string read_existing_file(const std::string& flag, const std::string& text) {
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(text, ignored);
    if (text.empty() || !std::filesystem::exists(status))
        refuse(flag, text, "does not exist", "the path of a file to read");
    if (std::filesystem::is_directory(status))
        refuse(flag, text, "is a folder", "the path of a file to read");
    return text;
}

std::string read_output_name(const std::string& flag, const std::string& text) {
    if (text.empty()) refuse(flag, text, "is no name", "the path of a file to write");
    return text;
}

// ---- the picture as a whole ----

/// Bytes of memory that this program may have: the machine's, or less by `ulimit -v`. 0 if it is unknown.
std::int64_t usable_memory() {
#if defined(_SC_PHYS_PAGES) && defined(_SC_PAGESIZE)
    const std::int64_t pages = sysconf(_SC_PHYS_PAGES);
    const std::int64_t page = sysconf(_SC_PAGESIZE);
    const std::int64_t machine = pages > 0 && page > 0 ? pages * page : 0;
    rlimit limit{};
    const bool limited = getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur < rlim_t(machine);
    return limited ? std::int64_t(limit.rlim_cur) : machine;
#else
    return 0;
#endif
}

std::string gigabytes(std::int64_t bytes) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.1f GB", double(bytes) * 1e-9);
    return text.data();
}

void check_crop(const RenderSettings& picture, const std::string& typed) {
    const Crop& crop = picture.crop;
    const std::string width = std::to_string(picture.width), height = std::to_string(picture.height);
    const std::string right = "x0,y0,x1,y1 with 0 <= x0 < x1 <= " + width + " and 0 <= y0 < y1 <= " + height;
    if (crop.x0 >= crop.x1 || crop.y0 >= crop.y1) refuse("--crop", typed, "is empty", right);
    if (crop.x1 > picture.width || crop.y1 > picture.height)
        refuse("--crop", typed, "is not inside the picture", right);
}

void check_size(const Crop& crop) {
    const int width = crop.x1 - crop.x0, height = crop.y1 - crop.y0;
    const std::int64_t needed =
        std::int64_t(width) * height * bytes_per_film_pixel + std::int64_t(memory_to_write(width, height));
    const std::int64_t memory = usable_memory();
    const std::string advice = ": make --width and --height smaller, or render a part with --crop";
    if (memory > 0 && needed > memory)
        throw Error("the picture, " + std::to_string(width) + " x " + std::to_string(height) +
                    " pixels, needs " + gigabytes(needed) + " of memory and " + gigabytes(memory) +
                    " may be used" + advice);
    if (const std::string problem = size_problem(width, height); !problem.empty())
        throw Error("the picture " + problem + advice);
}

/// `text` in lines of at most 80 columns, all but the first moved in to `column`, where the first one starts.
std::string wrapped(const std::string& text, std::size_t column) {
    constexpr std::size_t width = 80;
    std::string lines, word;
    std::size_t used = column;
    std::istringstream words(text);
    while (words >> word) {
        if (used > column && used + 1 + word.size() > width) {
            lines += "\n" + std::string(column, ' ');
            used = column;
        }
        lines += (used > column ? " " : "") + word;
        used += word.size() + (used > column ? 1 : 0);
    }
    return lines;
}

std::string help_entry(const Knob& knob) {
    constexpr std::size_t column = 25;
    std::string head = "  " + knob.dashed() + (knob.metavar.empty() ? "" : " " + knob.metavar);
    head +=
        head.size() + 2 <= column ? std::string(column - head.size(), ' ') : "\n" + std::string(column, ' ');
    std::string range = knob.range;
    if (!knob.initial.empty()) range += (range.empty() ? "" : "; ") + ("default " + knob.initial);
    return head + wrapped(knob.help + (range.empty() ? "" : " [" + range + "]"), column) + "\n";
}

} // namespace

struct Options::Parser {
    std::string name;
    std::string question;
    RenderSettings picture;
    bool help_asked = false;
    bool version_asked = false;
    CLI::App app;
    Group own{"This step's knobs", {}};
    Group standard{"RenderSettings", {}};
    Group output{"Output", {}};
    std::deque<float> floats;
    std::deque<int> integers;
    std::deque<dvec3> vectors;
    std::deque<bool> flags;
    std::deque<std::string> texts;

    void add(Group& group, Knob knob);
    void add_standard();
    void add_output();
    const Knob* find(const std::string& wanted) const;
    std::vector<std::string> names() const;
    void take_apart(const std::vector<std::string>& words);
    void refuse_leftovers() const;
    void read_all(const Group& group) const;
    std::string help() const;

    /// Declares a whole number of the picture's.
    template <typename Integer>
    void whole(Group& group, const char* knob_name, Integer& value, Integer low, Integer high,
               const char* text) {
        const auto read = [&value, low, high, flag = "--" + std::string(knob_name)](
                              const std::string& typed) { value = read_whole(flag, typed, low, high); };
        add(group, {knob_name, "N", text, range_text(low, high), std::to_string(value), read});
    }
};

// A name that is taken is a mistake in main.cpp, not in what was typed.
void Options::Parser::add(Group& group, Knob knob) {
    if (find(knob.name) || knob.name == "help" || knob.name == "version")
        throw std::logic_error("two knobs are called " + knob.dashed());
    if (knob.metavar.empty())
        knob.option = app.add_flag(knob.dashed());
    else
        knob.option = app.add_option(knob.dashed())->expected(1);
    knob.option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    group.knobs.push_back(std::move(knob));
}

void Options::Parser::add_standard() {
    whole(standard, "width", picture.width, 1, longest_side, "columns of the whole picture, in pixels");
    whole(standard, "height", picture.height, 1, longest_side, "rows of the whole picture, in pixels");
    whole(standard, "samples", picture.samples, 1, most_samples, "samples a pixel");
    whole(standard, "seed", picture.seed, std::uint64_t(0), ~std::uint64_t(0), "another seed, other noise");
    add(standard,
        {"crop", "X0,Y0,X1,Y1",
         "render only columns x0 <= x < x1 and rows y0 <= y < y1 of the whole, in pixels from the top left",
         "inside the picture", "the whole picture",
         [this](const std::string& text) { picture.crop = read_crop(text); }});
}

void Options::Parser::add_output() {
    add(output,
        {"out", "FILE",
         "the picture's file: NAME.png (8-bit sRGB), NAME.hdr (linear light), or NAME for both", "",
         picture.out, [this](const std::string& text) { picture.out = read_output_name("--out", text); }});
    add(output,
        {"variance", "FILE",
         "also write the variance of each pixel's mean luminance: NAME.hdr; needs --samples 2 or more", "",
         "none",
         [this](const std::string& text) { picture.variance = read_output_name("--variance", text); }});
    whole(output, "threads", picture.threads, 0, 1024,
          "threads to render with; 0: as many as the cores that it may use");
    add(output, {"quiet", "", "print only the names of the files written, and errors", "", "",
                 [this](const std::string&) { picture.quiet = true; }});
}

const Knob* Options::Parser::find(const std::string& wanted) const {
    for (const Group* group : {&own, &standard, &output})
        for (const Knob& knob : group->knobs)
            if (knob.name == wanted) return &knob;
    return nullptr;
}

std::vector<std::string> Options::Parser::names() const {
    std::vector<std::string> all{"help"};
    for (const Group* group : {&own, &standard, &output})
        for (const Knob& knob : group->knobs) all.push_back(knob.name);
    return all;
}

void Options::Parser::take_apart(const std::vector<std::string>& words) {
    const std::string last = words.empty() ? "" : words.back();
    const Knob* const hungry = last.rfind("--", 0) == 0 ? find(last.substr(2)) : nullptr;
    if (hungry && !hungry->metavar.empty())
        throw Error(last + " needs a value: " + last + " " + hungry->metavar);
    try {
        app.parse(std::vector<std::string>(words.rbegin(), words.rend())); // CLI11 takes words from the back
    } catch (const CLI::ParseError& error) {
        throw Error(error.what());
    }
}

void Options::Parser::refuse_leftovers() const {
    const std::vector<std::string> left = app.remaining();
    if (left.empty()) return;
    const std::string& word = left.front();
    if (word.size() < 2 || word[0] != '-')
        throw Error(shown(word) + " has no flag before it: every value follows its flag, as in --width 640");
    const std::string flag = word.substr(0, word.find('='));
    const std::size_t first_letter = flag.find_first_not_of('-');
    const std::string letters = first_letter == std::string::npos ? "" : flag.substr(first_letter);
    throw Error(shown(flag) + " is not a flag of " + name + suggestion(letters, names(), "--") +
                ": --help lists them all");
}

void Options::Parser::read_all(const Group& group) const {
    for (const Knob& knob : group.knobs) {
        const std::vector<std::string>& typed = knob.option->results();
        if (typed.empty()) continue;
        if (typed.size() > 1) throw Error(knob.dashed() + " is given twice: keep one");
        const std::string& text = typed.front();
        if (knob.metavar.empty() && text != "true")
            throw Error(knob.dashed() + " takes no value: leave out " + shown(text));
        if (!knob.metavar.empty() && text.rfind("--", 0) == 0)
            throw Error(knob.dashed() + " needs a value: " + knob.dashed() + " " + knob.metavar);
        knob.read(text);
    }
}

std::string Options::Parser::help() const {
    std::string text = name + ": " + question + "\n\nUse: " + name + " [flags]\n";
    for (const Group* group : {&own, &standard, &output}) {
        if (group->knobs.empty()) continue;
        text += "\n" + group->title + "\n";
        for (const Knob& knob : group->knobs) text += help_entry(knob);
    }
    return text + "  --help                 print this\n  --version              print the version\n";
}

Options::Options(std::string name, std::string question, RenderSettings picture)
    : parser(std::make_unique<Parser>()) {
    parser->name = std::move(name);
    parser->question = std::move(question);
    parser->picture = std::move(picture);
    if (parser->picture.out.empty()) parser->picture.out = parser->name;
    parser->app.allow_extras();
    parser->app.allow_windows_style_options(false);
    parser->app.set_help_flag();
    parser->app.add_flag("-h,--help", parser->help_asked);
    parser->app.add_flag("--version", parser->version_asked);
    parser->add_standard();
    parser->add_output();
}

Options::~Options() = default;

const float& Options::knob(const std::string& name, float initial, float low, float high,
                           const std::string& help) {
    if (!(low <= initial && initial <= high))
        throw std::logic_error("the default of --" + name + " is out of its own range");
    float& value = parser->floats.emplace_back(initial);
    const std::string range = range_text(low, high);
    const auto read = [&value, low, high, range, flag = "--" + name](const std::string& text) {
        const float typed = float(read_decimal(flag, text, range));
        if (!(low <= typed && typed <= high)) refuse(flag, text, "is out of range", range);
        value = typed;
    };
    parser->add(parser->own, {name, "X", help, range, decimal(initial), read});
    return value;
}

const int& Options::knob(const std::string& name, int initial, int low, int high, const std::string& help) {
    if (!(low <= initial && initial <= high))
        throw std::logic_error("the default of --" + name + " is out of its own range");
    int& value = parser->integers.emplace_back(initial);
    parser->whole(parser->own, name.c_str(), value, low, high, help.c_str());
    return value;
}

const dvec3& Options::knob(const std::string& name, vec3 initial, const std::string& help) {
    dvec3& value = parser->vectors.emplace_back(initial);
    const auto read = [&value, flag = "--" + name](const std::string& text) {
        value = read_vector(flag, text);
    };
    parser->add(parser->own, {name, "X,Y,Z", help, "three numbers", decimal(initial), read});
    return value;
}

const bool& Options::flag(const std::string& name, const std::string& help) {
    bool& value = parser->flags.emplace_back(false);
    parser->add(parser->own, {name, "", help, "", "", [&value](const std::string&) { value = true; }});
    return value;
}

const std::string& Options::file(const std::string& name, const std::string& help) {
    std::string& value = parser->texts.emplace_back();
    const auto read = [&value, flag = "--" + name](const std::string& text) {
        value = read_existing_file(flag, text);
    };
    parser->add(parser->own, {name, "FILE", help, "", "none", read});
    return value;
}

const int& Options::choice_index(const std::string& name, const std::vector<std::string>& names, int initial,
                                 const std::string& help) {
    int& value = parser->integers.emplace_back(initial);
    const auto read = [&value, names, flag = "--" + name](const std::string& text) {
        const auto found = std::find(names.begin(), names.end(), text);
        if (found == names.end())
            throw Error(flag + " " + shown(text) + " is not a choice" + suggestion(text, names, "") +
                        ": one of " + joined(names));
        value = int(found - names.begin());
    };
    parser->add(parser->own,
                {name, "NAME", help, "one of " + joined(names), names.at(std::size_t(initial)), read});
    return value;
}

bool Options::given(const std::string& name) const {
    const Knob* const knob = parser->find(name);
    if (!knob) throw std::logic_error("no knob is called --" + name);
    return knob->option->count() > 0;
}

bool Options::parse(int argc, const char* const* argv) {
    parser->take_apart(argc > 1 ? std::vector<std::string>(argv + 1, argv + argc)
                                : std::vector<std::string>());
    if (parser->help_asked) {
        std::cout << parser->help() << std::flush;
        return false;
    }
    if (parser->version_asked) {
        std::cout << version() << std::endl;
        return false;
    }
    for (const Group* group : {&parser->own, &parser->standard, &parser->output}) parser->read_all(*group);
    parser
        ->refuse_leftovers(); // after the values: a flag that lacks its own may have swallowed the next flag
    RenderSettings& picture = parser->picture;
    if (given("crop"))
        check_crop(picture, parser->find("crop")->option->results().front());
    else
        picture.crop = {0, 0, picture.width, picture.height};
    check_size(picture.crop);
    return true;
}

const RenderSettings& Options::picture() const {
    return parser->picture;
}

const std::string& Options::name() const {
    return parser->name;
}

} // namespace rt
