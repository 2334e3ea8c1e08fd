// The text of an OBJ file, checked in one pass. tinyobjloader takes "nan" and "abc" for 0, lets indices run
// out of range and wrap at 2^31, and tells no line: whatever it would guess at is an error here.
#include "common/obj/scan.h"

#include "common/error.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cstring>

namespace rt {
namespace {

constexpr int most_corners = 1000;
constexpr int largest_decimal_exponent = 38; // FLT_MAX is 3.4e38

constexpr bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

void skip_sign(const char*& at, const char* end) {
    if (at < end && (*at == '+' || *at == '-')) ++at;
}

int skip_digits(const char*& at, const char* end) {
    const char* const begin = at;
    while (at < end && is_digit(*at)) ++at;
    return int(at - begin);
}

/// What follows the 'e' of a number; answers false where no digit does.
bool read_exponent(const char*& at, const char* end, int& exponent) {
    const bool negative = at < end && *at == '-';
    skip_sign(at, end);
    const char* const begin = at;
    for (; at < end && is_digit(*at); ++at) exponent = std::min(exponent * 10 + (*at - '0'), 100000);
    exponent = negative ? -exponent : exponent;
    return at > begin;
}

/// A kind of thing that faces name by number.
struct Numbered {
    const char* what = "";
    const char* keyword = "";
    int count = 0;   ///< so far
    int largest = 0; ///< the largest number that a face names
    int largest_line = 0;
};

class Scanner {
  public:
    Scanner(const std::string& path_, std::string& text_) : path(path_), text(text_) {}
    ObjScan run();

  private:
    [[noreturn]] void fail(const std::string& message) const { throw Error(at_line(path, line, message)); }
    char* join_continued(char* begin, char* end);
    void check_line(char* begin, char* end);
    void check_numbers(char* at, char* end, int least, int most);
    void check_face(char* at, char* end);
    char* check_corner(char* at, char* end);
    char* check_index(Numbered& numbered, char* at, char* end);
    void check_name(char* at, char* end, bool library);
    void check_ignored(char* begin, const char* keyword_end);
    void check_forward_references();

    const std::string& path;
    std::string& text;
    int line = 1;          ///< where the line that is being checked begins
    int further_lines = 0; ///< that a '\' at its end joined to it
    Numbered positions{"position", "v"}, uvs{"texture coordinate", "vt"}, normals{"normal", "vn"};
    ObjScan scan;
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

ObjScan Scanner::run() {
    char* const text_end = text.data() + text.size();
    for (char* begin = text.data(); begin < text_end;) {
        char* end = std::find(begin, text_end, '\n');
        end = join_continued(begin, end);
        check_line(begin, end);
        line += 1 + further_lines;
        further_lines = 0;
        begin = end + 1;
    }
    check_forward_references();
    if (scan.face_sizes.empty())
        throw Error(path + ": has no faces (lines such as \"f 1 2 3\"); is it an OBJ file?");
    return std::move(scan);
}

/// A '\' at the end of a line that is no comment joins the next one to it. Answers the new end.
char* Scanner::join_continued(char* begin, char* end) {
    char* const text_end = text.data() + text.size();
    const char* const first = skip_blanks(begin, end);
    while (end < text_end && *first != '#') {
        char* last = end;
        while (last > begin && is_blank(last[-1])) --last;
        if (last == begin || last[-1] != '\\') break;
        std::fill(last - 1, end + 1, ' ');
        ++further_lines;
        end = std::find(end + 1, text_end, '\n');
    }
    return end;
}

void Scanner::check_line(char* begin, char* end) {
    char* const word = skip_blanks(begin, end);
    if (word == end || *word == '#') return;
    char* const rest = word_end(word, end);
    const std::string_view keyword = view(word, rest);
    if (keyword == "v") {
        check_numbers(rest, end, 3, 3);
        ++positions.count;
    } else if (keyword == "vt") {
        check_numbers(rest, end, 1, 2);
        ++uvs.count;
    } else if (keyword == "vn") {
        check_numbers(rest, end, 3, 3);
        ++normals.count;
    } else if (keyword == "f") {
        check_face(rest, end);
    } else if (keyword == "usemtl" || keyword == "mtllib") {
        check_name(rest, end, keyword == "mtllib");
    } else {
        check_ignored(word, rest);
    }
}

/// What follows the numbers that are used (a weight, a colour, a comment) is blanked out.
void Scanner::check_numbers(char* at, char* end, int least, int most) {
    int count = 0;
    for (; count < most; ++count) {
        at = skip_blanks(at, end);
        if (at == end || *at == '#') break;
        char* const stop = word_end(at, end);
        if (const std::string_view fault = number_fault(view(at, stop)); !fault.empty())
            fail(in_quotes(view(at, stop)) + " " + std::string(fault));
        at = stop;
    }
    if (count < least)
        fail("a vertex needs " + std::to_string(least) + (least == 1 ? " number" : " numbers") + " and has " +
             std::to_string(count));
    std::fill(at, end, ' ');
}

void Scanner::check_face(char* at, char* end) {
    int corners = 0;
    for (at = skip_blanks(at, end); at < end && *at != '#'; at = skip_blanks(at, end)) {
        at = check_corner(at, end);
        if (++corners > most_corners)
            fail("a face of more than " + std::to_string(most_corners) +
                 " corners; cut it into smaller ones");
    }
    if (corners < 3) fail("a face needs three corners or more and has " + std::to_string(corners));
    std::fill(at, end, ' ');
    scan.face_sizes.push_back(std::uint16_t(corners));
}

/// v, v/vt, v//vn or v/vt/vn. A '/' with nothing behind it, as some programs write it, is blanked out.
char* Scanner::check_corner(char* at, char* end) {
    char* const stop = word_end(at, end);
    char* last = stop;
    while (last > at && last[-1] == '/') *--last = ' ';
    char* const begin = at;
    at = check_index(positions, at, last);
    if (at < last && *at == '/' && at[1] != '/')
        at = check_index(uvs, at + 1, last);
    else if (at < last && *at == '/')
        ++at;
    if (at < last && *at == '/') at = check_index(normals, at + 1, last);
    if (at != last)
        fail(in_quotes(view(begin, last)) + " is not a corner of the form v, v/vt, v//vn or v/vt/vn");
    return stop;
}

char* Scanner::check_index(Numbered& numbered, char* at, char* end) {
    char* const begin = at;
    const bool negative = at < end && *at == '-';
    if (negative || (at < end && *at == '+')) ++at;
    long long value = 0;
    char* const digits = at;
    for (; at < end && is_digit(*at); ++at) value = std::min<long long>(value * 10 + (*at - '0'), INT_MAX);
    if (at == digits)
        fail(in_quotes(view(begin, end)) + " is not a whole number where a face names a " + numbered.what);
    if (value == 0) fail("a face names " + std::string(numbered.what) + " 0, but counting starts at 1");
    if (negative && value > numbered.count)
        fail("a face names " + std::string(numbered.what) + " " + std::string(view(begin, at)) +
             ", but only " + std::to_string(numbered.count) + " stand before it");
    if (!negative && value > numbered.largest) {
        numbered.largest = int(value);
        numbered.largest_line = line;
    }
    return at;
}

/// Names may hold spaces; tinyobjloader takes '\' in a library's name for an escape.
void Scanner::check_name(char* at, char* end, bool library) {
    at = skip_blanks(at, end);
    while (end > at && is_blank(end[-1])) --end;
    if (at == end) fail(library ? "mtllib names no file" : "usemtl names no material");
    if (library) std::replace(at, end, '\\', '/');
    std::replace_if(at, end, is_blank, inner_space);
    if (library)
        scan.names_library = true;
    else
        scan.materials.emplace(view(at, end), line);
}

/// Groups, objects, smoothing, lines, points, curves and what other programs add. A word of control
/// characters is none of these.
void Scanner::check_ignored(char* begin, const char* keyword_end) {
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
    const bool end_of_dos_file = *begin == '\x1a' && line > 1;
    if (!end_of_dos_file && std::any_of(static_cast<const char*>(begin), keyword_end, is_control))
        fail("not text; is this an OBJ file?");
    *begin = '#';
}

/// A face may come before its vertices, so the largest number of each kind is looked at last.
void Scanner::check_forward_references() {
    for (const Numbered& numbered : {positions, uvs, normals}) {
        if (numbered.largest <= numbered.count) continue;
        line = numbered.largest_line;
        fail("a face names " + std::string(numbered.what) + " " + std::to_string(numbered.largest) +
             ", but the file has " + std::to_string(numbered.count) + " (lines that begin with " +
             numbered.keyword + ")");
    }
}

} // namespace

std::string at_line(const std::string& path, int line, const std::string& message) {
    return path + ":" + std::to_string(line) + ": " + message;
}

void unify_text(std::string& text) {
    if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.replace(0, 3, "   ");
    for (std::size_t i = text.find('\r'); i != std::string::npos; i = text.find('\r', i + 1))
        text[i] = i + 1 < text.size() && text[i + 1] == '\n' ? ' ' : '\n';
}

std::string_view number_fault(std::string_view word) {
    const char* at = word.data();
    const char* const end = at + word.size();
    skip_sign(at, end);
    while (at + 1 < end && *at == '0' && is_digit(at[1])) // leading zeros say nothing about the size
        ++at;
    const int whole_digits = skip_digits(at, end);
    int fraction_digits = 0;
    if (at < end && *at == '.') fraction_digits = skip_digits(++at, end);
    if (whole_digits + fraction_digits == 0) return "is not a number";
    int exponent = 0;
    if (at < end && (*at == 'e' || *at == 'E') && !read_exponent(++at, end, exponent))
        return "is not a number";
    if (at != end) return "is not a number";
    return whole_digits + exponent > largest_decimal_exponent ? "is too large a number" : "";
}

std::string in_quotes(std::string_view word) {
    std::string text = "\"" + std::string(word.substr(0, 40)) + (word.size() > 40 ? "..." : "") + "\"";
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; }, '?');
    return text;
}

ObjScan scan_obj(const std::string& path, std::string& text) {
    unify_text(text);
    return Scanner(path, text).run();
}

} // namespace rt
