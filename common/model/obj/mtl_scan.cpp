// Checks an .mtl file and reduces it to the lines we use, in the form that tinyobjloader reads correctly.
// On its own, tinyobjloader reads "nan" as 0, a grey "Kd .5" as dark red, and the third number of "-s 2 2
// wood.png" as part of the file name.
#include "common/model/obj/material.h"

#include "common/util/error.h"
#include "common/model/obj/find_file.h"
#include "common/util/text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <sstream>

namespace rt {
namespace {

/// The words of a line, as views into it.
struct Words {
    std::string line;
    std::vector<std::string_view> words;

    explicit Words(std::string line_) : line(std::move(line_)) {
        line.erase(line.find_last_not_of(" \t") + 1);
        for (std::size_t begin = line.find_first_not_of(" \t"); begin != std::string::npos;) {
            const std::size_t end = std::min(line.find_first_of(" \t", begin), line.size());
            words.push_back(std::string_view(line).substr(begin, end - begin));
            begin = line.find_first_not_of(" \t", end);
        }
    }
    Words(const Words&) = delete;
    Words& operator=(const Words&) = delete;

    /// Returns the line from word `first` to the end, including spaces.
    std::string from(std::size_t first) const {
        return first < words.size() ? line.substr(std::size_t(words[first].data() - line.data())) : "";
    }
    /// Returns the number of words after the first, up to a comment.
    std::size_t arguments() const {
        std::size_t count = 0;
        while (count + 1 < words.size() && words[count + 1][0] != '#') ++count;
        return count;
    }
};

/// Skipped lines of one kind, reported by one warning.
struct Skipped {
    int count = 0;
    int first_line = 0;
    std::string first_word;

    void add(int line, std::string_view word) {
        if (count++ > 0) return;
        first_line = line;
        first_word = word;
    }
};

class MtlScanner {
  public:
    MtlScanner(const std::string& path_, std::string text) : path(path_), stream(std::move(text)) {}
    std::string run();

  private:
    [[noreturn]] void fail(const std::string& message) const { throw Error(at_line(path, line, message)); }
    std::string rewritten(const Words& words);
    std::string number(std::string_view word) const;
    std::string colour(const Words& words);
    std::string three_numbers(const Words& words, std::size_t first) const;
    std::string colour_of_xyz(const Words& words) const;
    std::string highlight(const Words& words);
    std::string scalar(const Words& words) const;
    std::string new_material(const Words& words);
    std::string texture(const Words& words, const char* keyword);
    void unused(const Words& words);
    void tell() const;

    std::string path;
    std::istringstream stream;
    int line = 0;
    std::string material; ///< name of the current material, empty before the first one
    Skipped homeless, unknown, unnamed;
    std::map<std::string, Skipped> options; ///< of textures, by name
    Unfollowed unfollowed;
};

std::string MtlScanner::run() {
    std::string out;
    for (std::string text; std::getline(stream, text);) {
        ++line;
        const Words words(std::move(text));
        if (words.words.empty() || words.words[0][0] == '#') continue;
        if (material.empty() && words.words[0] != "newmtl")
            homeless.add(line, words.words[0]);
        else
            out += rewritten(words);
    }
    tell();
    return out;
}

void MtlScanner::tell() const {
    const auto say = [this](const Skipped& lines, const std::string& what) {
        const std::string count = lines.count > 1 ? " (" + std::to_string(lines.count) + " such lines)" : "";
        if (lines.count > 0) warn(at_line(path, lines.first_line, what + count));
    };
    say(homeless, in_quotes(homeless.first_word) + " is skipped, since no newmtl precedes it");
    say(unnamed, in_quotes(unnamed.first_word) + " names no file and is skipped");
    say(unknown, in_quotes(unknown.first_word) + " is not a known statement and is skipped");
    for (const auto& [option, lines] : options)
        say(lines, "the texture option " + option + " is not supported");
    unfollowed.tell();
}

std::string MtlScanner::rewritten(const Words& words) {
    static const std::array<std::string_view, 5> scalars{"Ni", "d", "Tr", "Pm", "illum"};
    const std::string_view keyword = words.words[0];
    if (keyword == "newmtl") return new_material(words);
    if (keyword == "map_Kd" || keyword == "map_kd") return texture(words, "map_Kd");
    if (keyword == "map_d" || keyword == "map_D") return texture(words, "map_d");
    if (keyword == "Kd" || keyword == "Ke") return colour(words);
    if (keyword == "Ks") return highlight(words);
    if (std::find(scalars.begin(), scalars.end(), keyword) != scalars.end()) return scalar(words);
    unused(words);
    return "";
}

constexpr const char* no_bumps = "bump and normal maps are not supported";
constexpr const char* no_displacement = "displacement maps are not supported";
constexpr const char* no_glow = "emission maps (map_Ke) are not supported";
constexpr const char* no_shine = "maps of highlights, roughness and metal are not supported";
constexpr const char* no_reflections = "reflection maps are not supported";
constexpr const char* no_layers =
    "roughness, sheen, coat and anisotropy (Pr, Ps, Pc, aniso) are not supported";

/// Statements that would change an image but are not supported, by keyword in lower case.
const std::map<std::string_view, const char*> not_followed{
    {"bump", no_bumps},          {"map_bump", no_bumps},    {"norm", no_bumps},
    {"map_kn", no_bumps},        {"disp", no_displacement}, {"map_disp", no_displacement},
    {"map_ke", no_glow},         {"map_ks", no_shine},      {"map_ns", no_shine},
    {"map_pr", no_shine},        {"map_pm", no_shine},      {"map_ps", no_shine},
    {"map_rma", no_shine},       {"map_orm", no_shine},     {"refl", no_reflections},
    {"map_refl", no_reflections}};
const std::set<std::string_view> layers{"pr", "ps", "pc", "pcr", "aniso", "anisor"};
/// Keywords that are ignored without a warning.
const std::set<std::string_view> silent{"ka",     "ns",        "tf",      "map_ka",
                                        "map_tf", "sharpness", "map_aat", "decal"};

/// Records a statement that is not supported, by kind.
void MtlScanner::unused(const Words& words) {
    std::string keyword(words.words[0]);
    std::transform(keyword.begin(), keyword.end(), keyword.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    if (const auto kind = not_followed.find(keyword); kind != not_followed.end())
        unfollowed.add(path, kind->second, material);
    else if (layers.count(keyword) > 0) {
        if (words.arguments() > 0 && words.words[1].find_first_of("123456789") != std::string_view::npos)
            unfollowed.add(path, no_layers, material); // 0 has no effect
    } else if (silent.count(keyword) == 0)
        unknown.add(line, words.words[0]);
}

std::string MtlScanner::number(std::string_view word) const {
    if (const std::string_view fault = number_fault(word); !fault.empty())
        fail(in_quotes(word) + " " + std::string(fault));
    return " " + std::string(word);
}

/// Returns a colour statement as RGB. The file states RGB, CIE XYZ, or a spectrum, which is in a separate
/// file and not supported.
std::string MtlScanner::colour(const Words& words) {
    const std::string_view kind = words.words.size() > 1 ? words.words[1] : "";
    const std::string keyword(words.words[0]);
    if (kind == "xyz") return keyword + colour_of_xyz(words) + "\n";
    if (kind != "spectral") return keyword + three_numbers(words, 1) + "\n";
    unfollowed.add(path, keyword + " as a spectrum is not supported", material);
    return "";
}

/// Returns three numbers from word `first` on; a single number stands for all three.
std::string MtlScanner::three_numbers(const Words& words, std::size_t first) const {
    const std::size_t count = words.arguments() + 1 - first;
    if (count != 1 && count < 3) fail(std::string(words.words[0]) + " needs three numbers");
    std::string out;
    for (std::size_t i = 0; i < 3; ++i) out += number(words.words[first + (count == 1 ? 0 : i)]);
    return out;
}

/// Converts "xyz" and three numbers to linear RGB (IEC 61966-2-1); colours out of gamut are clamped at 0.
std::string MtlScanner::colour_of_xyz(const Words& words) const {
    float x = 0, y = 0, z = 0;
    std::istringstream(three_numbers(words, 2)) >> x >> y >> z;
    const std::array<float, 3> rgb{3.2406f * x - 1.5372f * y - 0.4986f * z,
                                   -0.9689f * x + 1.8758f * y + 0.0415f * z,
                                   0.0557f * x - 0.2040f * y + 1.0570f * z};
    std::ostringstream out;
    for (const float value : rgb) out << " " << std::max(value, 0.0f);
    return out.str();
}

/// Returns a Ks statement. Few materials use Ks, so an error in it is no reason to reject the model.
std::string MtlScanner::highlight(const Words& words) {
    try {
        return "Ks" + three_numbers(words, 1) + "\n";
    } catch (const Error&) {
        unfollowed.add(path, "Ks that is not three numbers is skipped", material);
        return "";
    }
}

std::string MtlScanner::scalar(const Words& words) const {
    const std::size_t at = words.words.size() > 1 && words.words[1] == "-halo" ? 2 : 1;
    if (words.arguments() < at) fail(std::string(words.words[0]) + " needs a number");
    return std::string(words.words[0]) + number(words.words[at]) + "\n";
}

std::string MtlScanner::new_material(const Words& words) {
    std::string name = unquoted(words.from(1));
    if (name.empty()) fail("newmtl names no material");
    material = name;
    std::replace_if(name.begin(), name.end(), is_blank, name_space);
    const std::string value = " " + std::to_string(unset);
    return "newmtl " + name + "\nKd" + value + value + value + "\n";
}

const std::set<std::string_view> settings{"-blendu", "-blendv", "-cc",      "-clamp", "-boost",
                                          "-bm",     "-texres", "-imfchan", "-type",  "-colorspace"};
const std::set<std::string_view> transforms{"-o", "-s", "-t", "-mm"}; // take up to three numbers each

/// Returns how many words the texture option at word `at` takes, or 0 if there is none.
std::size_t option_length(const Words& words, std::size_t at) {
    if (at >= words.words.size()) return 0;
    if (settings.count(words.words[at]) > 0) return 2;
    if (transforms.count(words.words[at]) == 0) return 0;
    std::size_t length = 1;
    while (length <= 3 && at + length < words.words.size() && number_fault(words.words[at + length]).empty())
        ++length;
    return length;
}

/// Returns `text` with each `from` replaced by `to`.
std::string replaced(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

/// Returns a texture statement without options: we support none of them, and tinyobjloader would apply some.
std::string MtlScanner::texture(const Words& words, const char* keyword) {
    std::size_t at = 1;
    while (const std::size_t length = option_length(words, at)) {
        const std::string option(words.words[at]);
        if (transforms.count(option) > 0) options[option].add(line, option);
        at += length;
    }
    const std::string name = unquoted(words.from(at));
    if (name.empty()) {
        unnamed.add(line, words.words[0]);
        return "";
    }
    // In "my\ wall.png" the backslash escapes a space; "art\wall.png" is a Windows path.
    return keyword + (" " + replaced(replaced(name, "\\ ", " "), "\\", "/")) + "\n";
}

} // namespace

std::string scan_mtl(const std::string& path, std::string text) {
    blank_byte_order_mark(text);
    unify_line_ends(text);
    return MtlScanner(path, std::move(text)).run();
}

} // namespace rt
