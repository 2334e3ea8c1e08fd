// Reads a list of spheres line by line. An error is one line that names the file and the line number.
#include "common/model/sphere_list.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/util/text.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace rt {
namespace {

constexpr std::string_view columns = "material,x,y,z,radius,red,green,blue,fuzz_or_ior";
constexpr std::uintmax_t max_bytes = std::uintmax_t(1) << 30;

/// Returns the values between the commas, without blanks around them.
std::vector<std::string> split(std::string_view line) {
    std::vector<std::string> words(1);
    for (const char c : line) {
        if (c == ',')
            words.emplace_back();
        else if (!is_blank(c) || !words.back().empty())
            words.back() += c;
    }
    for (std::string& word : words) word.erase(word.find_last_not_of(" \t") + 1);
    return words;
}

/// One line of the file, split into values.
struct CsvRow {
    const std::string& path;
    int line;
    std::vector<std::string> words;

    [[noreturn]] void refuse(const std::string& what) const { throw Error(at_line(path, line, what)); }

    float number(std::size_t column, float low, float high, const std::string& range) const {
        const std::string& word = words[column];
        const std::string name = split(columns)[column];
        if (const std::string_view fault = number_fault(word); !fault.empty())
            refuse(name + " " + in_quotes(word) + " " + std::string(fault));
        const float value = std::strtof(word.c_str(), nullptr);
        if (!(value >= low && value <= high))
            refuse(name + " " + in_quotes(word) + " is out of range: " + range);
        return value;
    }
};

SphereRecord::Kind kind_of(const CsvRow& row) {
    const std::string& word = row.words[0];
    if (word == "lambertian") return SphereRecord::Kind::matte;
    if (word == "metal") return SphereRecord::Kind::metal;
    if (word == "dielectric") return SphereRecord::Kind::glass;
    row.refuse("material " + in_quotes(word) + " is not one of lambertian, metal, dielectric");
}

SphereRecord sphere_of(const CsvRow& row) {
    const std::size_t count = split(columns).size();
    if (row.words.size() != count)
        row.refuse("has " + std::to_string(row.words.size()) + " values, not the " + std::to_string(count) +
                   " of " + std::string(columns));
    const auto place = [&](std::size_t column) {
        return row.number(column, -1e6f, 1e6f, "-1000000 to 1000000");
    };
    const auto colour = [&](std::size_t column) { return row.number(column, 0, 1, "0 to 1"); };
    SphereRecord sphere{.kind = kind_of(row)};
    sphere.center = {place(1), place(2), place(3)};
    sphere.radius = row.number(4, 1e-6f, 1e6f, "0.000001 to 1000000");
    sphere.albedo = {colour(5), colour(6), colour(7)};
    if (sphere.kind == SphereRecord::Kind::metal) sphere.fuzz = row.number(8, 0, 1, "a fuzz of 0 to 1");
    if (sphere.kind == SphereRecord::Kind::glass) sphere.ior = row.number(8, 1, 10, "an index of 1 to 10");
    return sphere;
}

} // namespace

std::vector<SphereRecord> read_sphere_list(const std::string& path) {
    std::string text = read_file(path, max_bytes);
    blank_byte_order_mark(text);
    unify_line_ends(text);
    std::vector<SphereRecord> spheres;
    bool named = false; // true once the line with the column names has been read
    int line = 0;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const CsvRow row{path, ++line, split(std::string_view(text).substr(begin, end - begin))};
        begin = end + 1;
        if (row.words == std::vector<std::string>{""}) continue;
        if (named) spheres.push_back(sphere_of(row));
        if (!named && row.words != split(columns))
            row.refuse("the first line must name the columns: " + std::string(columns));
        named = true;
    }
    if (spheres.empty()) throw Error(path + ": contains no spheres");
    return spheres;
}

} // namespace rt
