// The text of an .mtl file, checked and reduced to the lines we use, in the one form that tinyobjloader reads
// rightly: it takes "nan" for 0, a grey "Kd .5" for dark red, and the third number of "-s 2 2 wood.png" for
// the name.
#include "common/obj/material.h"

#include "common/error.h"
#include "common/obj/scan.h"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>

namespace rt {
namespace {

/// The words of a line, and where each begins.
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

    /// From word `first` to the end, spaces and all.
    std::string from(std::size_t first) const {
        return first < words.size() ? line.substr(std::size_t(words[first].data() - line.data())) : "";
    }
    /// How many words there are after the first, up to a comment.
    std::size_t arguments() const {
        std::size_t count = 0;
        while (count + 1 < words.size() && words[count + 1][0] != '#') ++count;
        return count;
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
    std::string colour(const Words& words) const;
    std::string scalar(const Words& words) const;
    std::string new_material(const Words& words) const;
    std::string texture(const Words& words) const;

    std::string path;
    std::istringstream stream;
    int line = 0;
};

std::string MtlScanner::run() {
    std::string out;
    for (std::string text; std::getline(stream, text);) {
        ++line;
        const Words words(std::move(text));
        if (!words.words.empty()) out += rewritten(words);
    }
    return out;
}

std::string MtlScanner::rewritten(const Words& words) {
    static const std::array<std::string_view, 3> colours{"Kd", "Ke", "Ks"};
    static const std::array<std::string_view, 5> scalars{"Ni", "d", "Tr", "Pm", "illum"};
    const std::string_view keyword = words.words[0];
    if (keyword == "newmtl") return new_material(words);
    if (keyword == "map_Kd" || keyword == "map_kd") return texture(words);
    if (std::find(colours.begin(), colours.end(), keyword) != colours.end()) return colour(words);
    if (std::find(scalars.begin(), scalars.end(), keyword) != scalars.end()) return scalar(words);
    return "";
}

std::string MtlScanner::number(std::string_view word) const {
    if (const std::string_view fault = number_fault(word); !fault.empty())
        fail(in_quotes(word) + " " + std::string(fault));
    return " " + std::string(word);
}

/// Three numbers, or one that stands for all.
std::string MtlScanner::colour(const Words& words) const {
    const std::size_t count = words.arguments();
    if (count != 1 && count < 3) fail(std::string(words.words[0]) + " needs three numbers");
    std::string out(words.words[0]);
    for (std::size_t i = 1; i <= 3; ++i) out += number(words.words[count == 1 ? 1 : i]);
    return out + "\n";
}

std::string MtlScanner::scalar(const Words& words) const {
    const std::size_t at = words.words.size() > 1 && words.words[1] == "-halo" ? 2 : 1;
    if (words.arguments() < at) fail(std::string(words.words[0]) + " needs a number");
    return std::string(words.words[0]) + number(words.words[at]) + "\n";
}

std::string MtlScanner::new_material(const Words& words) const {
    std::string name = words.from(1);
    if (name.empty()) fail("newmtl names no material");
    std::replace_if(name.begin(), name.end(), is_blank, inner_space);
    const std::string value = " " + std::to_string(unstated);
    return "newmtl " + name + "\nKd" + value + value + value + "\n";
}

const std::set<std::string_view> settings{"-blendu", "-blendv", "-cc",      "-clamp", "-boost",
                                          "-bm",     "-texres", "-imfchan", "-type",  "-colorspace"};
const std::set<std::string_view> transforms{"-o", "-s", "-t", "-mm"}; // up to three numbers each

/// How many words the option of a texture at word `at` takes, 0 if none stands there.
std::size_t option_length(const Words& words, std::size_t at) {
    if (at >= words.words.size()) return 0;
    if (settings.count(words.words[at]) > 0) return 2;
    if (transforms.count(words.words[at]) == 0) return 0;
    std::size_t length = 1;
    while (length <= 3 && at + length < words.words.size() && number_fault(words.words[at + length]).empty())
        ++length;
    return length;
}

/// The name of the file alone: the options before it are not followed, and some of them would be seen.
std::string MtlScanner::texture(const Words& words) const {
    std::size_t at = 1;
    while (const std::size_t length = option_length(words, at)) {
        const std::string option(words.words[at]);
        if (transforms.count(option) > 0)
            warn(at_line(path, line, "the texture's option " + option + " is not followed"));
        at += length;
    }
    std::string name = words.from(at);
    if (name.empty()) fail("map_Kd names no file");
    std::replace(name.begin(), name.end(), '\\', '/');
    return "map_Kd " + name + "\n";
}

} // namespace

std::string scan_mtl(const std::string& path, std::string text) {
    blank_byte_order_mark(text);
    unify_line_ends(text);
    return MtlScanner(path, std::move(text)).run();
}

} // namespace rt
