// Parses a chunk of OBJ text.
// What a lenient reader would have to guess at is an error here, with its line number. Defects that can be
// skipped without harm are counted instead.
#include "common/model/obj/parse.h"

#include "common/util/text.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <utility>

namespace rt {
namespace {

constexpr std::array<const char*, 3> names{"position", "texture coordinate", "normal"}; // by IndexKind
constexpr float not_finite = std::numeric_limits<float>::quiet_NaN();

/// How many numbers a line may have.
struct Wanted {
    int least, most;
    bool or_nan; ///< numbers that are not finite are read as NaN instead of being errors
};

char* skip_blanks(char* at, const char* end) {
    while (at < end && is_blank(*at)) ++at;
    return at;
}

char* word_end(char* at, const char* end) {
    while (at < end && !is_blank(*at)) ++at;
    return at;
}

std::string_view view(const char* begin, const char* end) {
    return {begin, std::size_t(end - begin)};
}

char* line_end(char* begin, char* text_end) {
    void* const found = std::memchr(begin, '\n', std::size_t(text_end - begin));
    return found ? static_cast<char*>(found) : text_end;
}

/// Parses one chunk. Here and below, `end` points to a '\n' or to the text's final '\0'.
class Parser {
  public:
    Parser(std::string& text_, bool begins_file_) : text(text_), begins_file(begins_file_) {}
    ParsedChunk run();

  private:
    [[noreturn]] void fail(const std::string& message) const { throw ParseError{line, message}; }
    void read_lines();
    char* join_continued(char* begin, char* end);
    void read_line(char* begin, char* end);
    int read_numbers(char*& at, char* end, const Wanted& wanted, std::array<double, 3>& numbers);
    void read_position(char* at, char* end);
    void read_color(const char* at, const char* end);
    void read_normal(char* at, char* end);
    void read_uv(char* at, char* end);
    void read_painted(char* at, char* end);
    void read_face(char* at, char* end);
    char* read_plain_corner(char* at, const char* end);
    char* read_corner(char* at, char* end);
    char* read_index(IndexKind::Kind kind, char* at, char* end, int& index);
    int index_of(IndexKind::Kind kind, int number);
    int index_back(IndexKind::Kind kind, int number, std::string_view word);
    void read_name(char* at, char* end, bool library);
    void read_smoothing(char* at, char* end);
    void check_ignored(const char* begin, const char* keyword_end) const;

    std::string& text;
    const bool begins_file;
    int line = 1;          ///< number of the current line, from 1
    int further_lines = 0; ///< lines joined to the current one by a trailing '\'
    ParsedChunk chunk;
};

ParsedChunk Parser::run() {
    try {
        read_lines();
    } catch (ParseError& fault) {
        chunk.fault = std::move(fault);
    }
    chunk.lines = line - 1;
    return chunk; // a copy, without unused capacity: all chunks are kept until the last is read
}

void Parser::read_lines() {
    char* const text_end = text.data() + text.size();
    for (char* begin = text.data(); begin < text_end;) {
        char* const end = join_continued(begin, line_end(begin, text_end));
        read_line(begin, end);
        line += 1 + further_lines;
        further_lines = 0;
        begin = end + 1;
    }
}

/// Joins the next line where a line other than a comment ends in '\'. Returns the new end.
char* Parser::join_continued(char* begin, char* end) {
    char* const text_end = text.data() + text.size();
    const bool comment = *skip_blanks(begin, end) == '#';
    while (end < text_end && !comment) {
        char* last = end;
        while (last > begin && is_blank(last[-1])) --last;
        if (last == begin || last[-1] != '\\') break;
        std::fill(last - 1, end + 1, ' ');
        ++further_lines;
        begin = end + 1; // only a '\' of the line joined last can join another
        end = line_end(begin, text_end);
    }
    return end;
}

void Parser::read_line(char* begin, char* end) {
    char* const word = skip_blanks(begin, end);
    if (word == end) return;
    char* const rest = word_end(word, end);
    const std::string_view keyword = view(word, rest);
    if (keyword == "v")
        read_position(rest, end);
    else if (keyword == "vt")
        read_uv(rest, end);
    else if (keyword == "vn")
        read_normal(rest, end);
    else if (keyword == "f")
        read_face(rest, end);
    else if (keyword == "#MRGB")
        read_painted(rest, end);
    else if (keyword == "usemtl" || keyword == "mtllib")
        read_name(rest, end, keyword == "mtllib");
    else if (keyword == "s")
        read_smoothing(rest, end);
    else if (*word != '#')
        check_ignored(word, rest);
}

/// Reads up to `wanted.most` numbers and returns their count. A number that is not finite is an
/// error or, if allowed, NaN.
int Parser::read_numbers(char*& at, char* end, const Wanted& wanted, std::array<double, 3>& numbers) {
    int count = 0;
    for (; count < wanted.most; ++count) {
        at = skip_blanks(at, end);
        if (at == end || *at == '#') break;
        double& number = numbers[std::size_t(count)];
        const char* stop = read_number(at, end, number);
        if (!stop) {
            stop = word_end(at, end);
            const std::string_view word = view(at, stop), fault = number_fault(word, double_exponent);
            if (!wanted.or_nan || (fault == "is not a number" && !is_not_finite(word)))
                fail(in_quotes(word) + " " + std::string(fault));
            number = std::numeric_limits<double>::quiet_NaN();
        }
        at += stop - at;
    }
    if (count < wanted.least)
        fail("a vertex needs " + std::to_string(wanted.least) + (wanted.least == 1 ? " number" : " numbers") +
             " and has " + std::to_string(count));
    return count;
}

void Parser::read_position(char* at, char* end) {
    std::array<double, 3> p{};
    read_numbers(at, end, {.least = 3, .most = 3, .or_nan = false}, p);
    chunk.positions.emplace_back(p[0], p[1], p[2]);
    at = skip_blanks(at, end);
    if (at < end && *at != '#') read_color(at, end);
}

/// Reads what follows a position: three more numbers are a colour. A single one is a weight, and other words
/// have no meaning; both are ignored.
void Parser::read_color(const char* at, const char* end) {
    std::array<double, 3> color{};
    for (double& value : color) {
        while (at < end && is_blank(*at)) ++at;
        at = read_number(at, end, value);
        if (!at) return;
    }
    chunk.colors.resize(chunk.positions.size() - 1, no_color);
    chunk.colors.push_back(max(vec3(color[0], color[1], color[2]), vec3(0)));
}

void Parser::read_uv(char* at, char* end) {
    std::array<double, 3> uv{};
    read_numbers(at, end, {.least = 1, .most = 2, .or_nan = true}, uv);
    const vec2 value(uv[0], uv[1]);
    const bool finite = std::isfinite(value.x) && std::isfinite(value.y);
    chunk.uvs.push_back(finite ? value : vec2(not_finite));
    if (!finite) chunk.skipped.uvs.add(line);
}

void Parser::read_normal(char* at, char* end) {
    std::array<double, 3> n{};
    read_numbers(at, end, {.least = 3, .most = 3, .or_nan = true}, n);
    const vec3 value(n[0], n[1], n[2]);
    const bool finite = std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z);
    chunk.normals.push_back(finite ? value : vec3(not_finite));
    if (!finite) chunk.skipped.normals.add(line);
}

/// Reads a ZBrush comment: up to 64 colours per line, in the order of the positions, as MMRRGGBB in
/// hexadecimal. MM is a mask.
void Parser::read_painted(char* at, char* end) {
    at = skip_blanks(at, end);
    for (std::array<unsigned char, 8> digits{}; end - at >= 8; at += 8) {
        for (std::size_t i = 0; i < 8; ++i) {
            const char c = char(at[i] | ' '); // to lower case
            if (!is_digit(c) && (c < 'a' || c > 'f')) return;
            digits[i] = static_cast<unsigned char>(is_digit(c) ? c - '0' : c - 'a' + 10);
        }
        const auto byte = [&](std::size_t i) { return float(16 * digits[i] + digits[i + 1]) / 255; };
        chunk.painted.emplace_back(byte(2), byte(4), byte(6));
    }
}

void Parser::read_face(char* at, char* end) {
    const std::size_t before = chunk.corners.size(), face = chunk.face_sizes.size();
    for (at = skip_blanks(at, end); at < end && *at != '#'; at = skip_blanks(at, end)) {
        char* const stop = read_plain_corner(at, end);
        at = stop ? stop : read_corner(at, end);
    }
    const std::size_t size = chunk.corners.size() - before;
    if (size < 3) fail("a face needs three corners or more and has " + std::to_string(size));
    chunk.face_sizes.push_back(std::uint32_t(size));
    std::vector<FaceLines>& runs = chunk.face_lines;
    if (runs.empty() || std::size_t(line - runs.back().line) != face - runs.back().face)
        runs.push_back({face, line});
}

/// Reads an index of one to nine digits; returns 0 for anything else.
int plain_index(char*& at) {
    const char* const begin = at;
    unsigned value = 0; // may overflow, but is not used then
    for (; is_digit(*at); ++at) value = value * 10 + unsigned(*at - '0');
    return at - begin <= 9 ? int(value) : 0;
}

/// Reads a face vertex in its usual spelling and returns the position after it. Returns null, and records
/// nothing, for any other word.
char* Parser::read_plain_corner(char* at, const char* end) {
    std::array<int, 3> number{plain_index(at), 0, 0};
    if (number[IndexKind::position] == 0) return nullptr;
    if (*at == '/' && at[1] != '/' && (number[IndexKind::uv] = plain_index(++at)) == 0) return nullptr;
    if (*at == '/') {
        at += at[1] == '/' && number[IndexKind::uv] == 0 ? 2 : 1;
        if ((number[IndexKind::normal] = plain_index(at)) == 0) return nullptr;
    }
    if (at != end && !is_blank(*at)) return nullptr;
    chunk.corners.push_back({index_of(IndexKind::position, number[IndexKind::position]),
                             index_of(IndexKind::uv, number[IndexKind::uv]),
                             index_of(IndexKind::normal, number[IndexKind::normal])});
    return at;
}

/// Reads a face vertex: v, v/vt, v//vn or v/vt/vn, possibly with a trailing '/', as some programs write it.
char* Parser::read_corner(char* at, char* end) {
    char* const stop = word_end(at, end);
    char* last = stop;
    while (last > at && last[-1] == '/') --last;
    char* const begin = at;
    ObjIndex corner;
    at = read_index(IndexKind::position, at, last, corner.position);
    if (at < last && *at == '/' && at[1] != '/')
        at = read_index(IndexKind::uv, at + 1, last, corner.uv);
    else if (at < last && *at == '/')
        ++at;
    if (at < last && *at == '/') at = read_index(IndexKind::normal, at + 1, last, corner.normal);
    if (at != last)
        fail(in_quotes(view(begin, last)) + " is not a corner of the form v, v/vt, v//vn or v/vt/vn");
    chunk.corners.push_back(corner);
    return stop;
}

char* Parser::read_index(IndexKind::Kind kind, char* at, char* end, int& index) {
    char* const begin = at;
    const bool negative = at < end && *at == '-';
    if (negative || (at < end && *at == '+')) ++at;
    long long value = 0;
    char* const digits = at;
    for (; at < end && is_digit(*at); ++at) value = std::min<long long>(value * 10 + (*at - '0'), INT_MAX);
    if (at == digits)
        fail(in_quotes(view(begin, end)) + " is not a whole number where a face names a " + names[kind]);
    if (value == 0 && kind == IndexKind::position) fail("a face names position 0, but counting starts at 1");
    if (value == 0)
        (kind == IndexKind::uv ? chunk.skipped.uv_corners : chunk.skipped.normal_corners).add(line);
    const bool back = negative && value != 0;
    index = back ? index_back(kind, int(value), view(begin, at)) : index_of(kind, int(value));
    return at;
}

/// Converts a number of the file to an index: 0, which means none, becomes -1.
int Parser::index_of(IndexKind::Kind kind, int number) {
    if (number > chunk.largest[kind]) {
        chunk.largest[kind] = number;
        if (kind == IndexKind::position) chunk.largest_position_line = line;
    }
    return number - 1;
}

/// Returns the index that is `number` before the current end, relative to the beginning of this chunk.
int Parser::index_back(IndexKind::Kind kind, int number, std::string_view word) {
    const auto so_far = std::array{chunk.positions.size(), chunk.uvs.size(), chunk.normals.size()};
    const int count = int(so_far[kind]), missing = number - count;
    chunk.relative[kind].push_back(chunk.corners.size());
    if (kind == IndexKind::position && missing > 0 &&
        (chunk.relative_indices.empty() || missing > chunk.relative_indices.back().missing))
        chunk.relative_indices.push_back({missing, count, line, std::string(word)});
    return count - number;
}

/// Reads a name. It may contain spaces, which some programs write as "\ "; library paths may use '\' for '/'.
void Parser::read_name(char* at, char* end, bool library) {
    at = skip_blanks(at, end);
    while (end > at && is_blank(end[-1])) --end;
    std::string name(at, end);
    if (library) {
        for (std::size_t i = 0; (i = name.find("\\ ", i)) != std::string::npos;) name.erase(i, 1);
        std::ranges::replace(name, '\\', '/');
    }
    std::ranges::replace_if(name, is_blank, name_space);
    if (name.empty())
        (library ? chunk.skipped.libraries : chunk.skipped.materials).add(line);
    else if (library)
        chunk.names_library = true;
    else
        chunk.materials.emplace(name, line);
    if (!library || !name.empty())
        chunk.material_lines.push_back({chunk.face_sizes.size(), library, std::move(name)});
}

/// Reads a smoothing statement: s off, s 0, s 1 ... Any other word is ignored.
void Parser::read_smoothing(char* at, char* end) {
    at = skip_blanks(at, end);
    char* const stop = word_end(at, end);
    const bool number = at < stop && stop - at <= 9 && std::all_of(at, stop, is_digit);
    const std::string_view word = view(at, stop);
    if (!number && word != "off" && word != "on") return;
    const int group = number ? plain_index(at) : word == "on" ? 1 : 0;
    chunk.smoothing_lines.push_back({chunk.face_sizes.size(), group});
}

/// Checks an ignored keyword: groups, objects, lines, points, curves, and extensions of other programs. A
/// keyword with control characters means that the file is not text.
void Parser::check_ignored(const char* begin, const char* keyword_end) const {
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
    const bool end_of_dos_file = *begin == '\x1a' && (line > 1 || !begins_file);
    if (!end_of_dos_file && std::any_of(begin, keyword_end, is_control))
        fail("not text; is this an OBJ file?");
}

} // namespace

ParsedChunk parse_chunk(std::string& text, bool begins_file) {
    return Parser(text, begins_file).run();
}

int line_of_corner(const ParsedChunk& chunk, std::size_t corner) {
    std::size_t face = 0;
    for (std::size_t end = chunk.face_sizes[0]; end <= corner; end += chunk.face_sizes[face]) ++face;
    const auto behind = std::ranges::upper_bound(chunk.face_lines, face, {}, &FaceLines::face);
    const FaceLines& run = *std::prev(behind);
    return run.line + int(face - run.face);
}

} // namespace rt
