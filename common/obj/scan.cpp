// The text of an OBJ file, checked in one pass. tinyobjloader takes "nan" and "abc" for 0, lets indices run
// out of range and wrap at 2^31, and tells no line: whatever it would guess at is an error here.
#include "common/obj/scan.h"

#include "common/error.h"

#include <algorithm>
#include <climits>
#include <cstring>
#include <utility>

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

constexpr std::array<const char*, 3> names{"position", "texture coordinate", "normal"}; // one a kind
constexpr std::array<const char*, 3> keywords{"v", "vt", "vn"};

class Scanner {
  public:
    Scanner(std::string& text_, bool begins_file_) : text(text_), begins_file(begins_file_) {}
    ChunkScan run();

  private:
    [[noreturn]] void fail(const std::string& message) const { throw Fault{line, message}; }
    void check_lines();
    char* join_continued(char* begin, char* end);
    void check_line(char* begin, char* end);
    void check_numbers(char* at, char* end, int least, int most);
    void check_face(char* at, char* end);
    char* check_plain_corner(char* at, const char* end);
    char* check_corner(char* at, char* end);
    char* check_index(Numbered::Kind kind, char* at, char* end);
    void note_index(Numbered::Kind kind, int number);
    void note_backward(Numbered::Kind kind, int number, std::string_view word);
    void check_name(char* at, char* end, bool library);
    void check_ignored(char* begin, const char* keyword_end) const;

    std::string& text;
    const bool begins_file;
    int line = 1;          ///< where the line that is being checked begins
    int further_lines = 0; ///< that a '\' at its end joined to it
    ChunkScan scan;
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

ChunkScan Scanner::run() {
    try {
        check_lines();
    } catch (Fault& fault) {
        scan.fault = std::move(fault);
    }
    scan.lines = line - 1;
    return std::move(scan);
}

void Scanner::check_lines() {
    char* const text_end = text.data() + text.size();
    for (char* begin = text.data(); begin < text_end;) {
        char* const end = join_continued(begin, line_end(begin, text_end));
        check_line(begin, end);
        line += 1 + further_lines;
        further_lines = 0;
        begin = end + 1;
    }
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
        end = line_end(end + 1, text_end);
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
        ++scan.counts[Numbered::position];
    } else if (keyword == "vt") {
        check_numbers(rest, end, 1, 2);
        ++scan.counts[Numbered::uv];
    } else if (keyword == "vn") {
        check_numbers(rest, end, 3, 3);
        ++scan.counts[Numbered::normal];
    } else if (keyword == "f") {
        check_face(rest, end);
    } else if (keyword == "usemtl" || keyword == "mtllib") {
        check_name(rest, end, keyword == "mtllib");
    } else {
        check_ignored(word, rest);
    }
}

/// Behind a number in its usual spelling, digits with perhaps a sign and a point; null for any other word.
/// Here and below: what `end` points to is a '\n' or the text's last '\0', so that no digit need be compared
/// with it.
char* after_plain_number(char* at, const char* end) {
    if (*at == '-') ++at;
    const char* const begin = at;
    while (is_digit(*at)) ++at;
    const auto whole_digits = at - begin;
    auto digits = whole_digits;
    if (*at == '.') {
        const char* const fraction = ++at;
        while (is_digit(*at)) ++at;
        digits += at - fraction;
    }
    const bool fits = digits > 0 && whole_digits <= largest_decimal_exponent;
    return fits && (at == end || is_blank(*at)) ? at : nullptr;
}

/// What follows the numbers that are used (a weight, a colour, a comment) is blanked out.
void Scanner::check_numbers(char* at, char* end, int least, int most) {
    int count = 0;
    for (; count < most; ++count) {
        at = skip_blanks(at, end);
        if (at == end || *at == '#') break;
        char* stop = after_plain_number(at, end);
        if (!stop) {
            stop = word_end(at, end);
            if (const std::string_view fault = number_fault(view(at, stop)); !fault.empty())
                fail(in_quotes(view(at, stop)) + " " + std::string(fault));
        }
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
        char* const stop = check_plain_corner(at, end);
        at = stop ? stop : check_corner(at, end);
        if (++corners > most_corners)
            fail("a face of more than " + std::to_string(most_corners) +
                 " corners; cut it into smaller ones");
    }
    if (corners < 3) fail("a face needs three corners or more and has " + std::to_string(corners));
    std::fill(at, end, ' ');
    scan.corners += corners;
    ++scan.faces;
}

/// One to nine digits; 0 for anything else.
int plain_index(char*& at) {
    const char* const begin = at;
    unsigned value = 0; // may wrap round, and counts for nothing then
    for (; is_digit(*at); ++at) value = value * 10 + unsigned(*at - '0');
    return at - begin <= 9 ? int(value) : 0;
}

/// Behind a corner in its usual spelling; null, and nothing noted, for any other word.
char* Scanner::check_plain_corner(char* at, const char* end) {
    std::array<int, 3> number{plain_index(at), 0, 0};
    if (number[Numbered::position] == 0) return nullptr;
    if (*at == '/' && at[1] != '/' && (number[Numbered::uv] = plain_index(++at)) == 0) return nullptr;
    if (*at == '/') {
        at += at[1] == '/' && number[Numbered::uv] == 0 ? 2 : 1;
        if ((number[Numbered::normal] = plain_index(at)) == 0) return nullptr;
    }
    if (at != end && !is_blank(*at)) return nullptr;
    for (const auto kind : {Numbered::position, Numbered::uv, Numbered::normal})
        note_index(kind, number[kind]);
    return at;
}

/// v, v/vt, v//vn or v/vt/vn. A '/' with nothing behind it, as some programs write it, is blanked out.
char* Scanner::check_corner(char* at, char* end) {
    char* const stop = word_end(at, end);
    char* last = stop;
    while (last > at && last[-1] == '/') *--last = ' ';
    char* const begin = at;
    at = check_index(Numbered::position, at, last);
    if (at < last && *at == '/' && at[1] != '/')
        at = check_index(Numbered::uv, at + 1, last);
    else if (at < last && *at == '/')
        ++at;
    if (at < last && *at == '/') at = check_index(Numbered::normal, at + 1, last);
    if (at != last)
        fail(in_quotes(view(begin, last)) + " is not a corner of the form v, v/vt, v//vn or v/vt/vn");
    return stop;
}

char* Scanner::check_index(Numbered::Kind kind, char* at, char* end) {
    char* const begin = at;
    const bool negative = at < end && *at == '-';
    if (negative || (at < end && *at == '+')) ++at;
    long long value = 0;
    char* const digits = at;
    for (; at < end && is_digit(*at); ++at) value = std::min<long long>(value * 10 + (*at - '0'), INT_MAX);
    if (at == digits)
        fail(in_quotes(view(begin, end)) + " is not a whole number where a face names a " + names[kind]);
    if (value == 0) fail("a face names " + std::string(names[kind]) + " 0, but counting starts at 1");
    if (negative)
        note_backward(kind, int(value), view(begin, at));
    else
        note_index(kind, int(value));
    return at;
}

void Scanner::note_index(Numbered::Kind kind, int number) {
    if (number <= scan.largest[kind]) return;
    scan.largest[kind] = number;
    scan.largest_line[kind] = line;
}

void Scanner::note_backward(Numbered::Kind kind, int number, std::string_view word) {
    const int missing = number - scan.counts[kind];
    if (missing <= scan.missing[kind]) return;
    scan.missing[kind] = missing;
    scan.backward.push_back({kind, missing, scan.counts[kind], line, std::string(word)});
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
void Scanner::check_ignored(char* begin, const char* keyword_end) const {
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
    const bool end_of_dos_file = *begin == '\x1a' && (line > 1 || !begins_file);
    if (!end_of_dos_file && std::any_of(static_cast<const char*>(begin), keyword_end, is_control))
        fail("not text; is this an OBJ file?");
    *begin = '#';
}

} // namespace

std::string at_line(const std::string& path, int line, const std::string& message) {
    return path + ":" + std::to_string(line) + ": " + message;
}

void blank_byte_order_mark(std::string& text) {
    if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.replace(0, 3, "   ");
}

void unify_line_ends(std::string& text) {
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

ChunkScan scan_chunk(std::string& text, bool begins_file) {
    return Scanner(text, begins_file).run();
}

void ObjScan::add(const std::string& path, const ChunkScan& chunk) {
    for (const Backward& b : chunk.backward) {
        if (b.missing > counts[b.kind])
            throw Error(at_line(path, lines + b.line,
                                "a face names " + std::string(names[b.kind]) + " " + b.number +
                                    ", but only " + std::to_string(counts[b.kind] + b.count) +
                                    " stand before it"));
    }
    if (chunk.fault) throw Error(at_line(path, lines + chunk.fault->line, chunk.fault->message));
    for (const auto kind : {Numbered::position, Numbered::uv, Numbered::normal}) {
        counts[kind] += chunk.counts[kind];
        if (chunk.largest[kind] <= largest[kind]) continue;
        largest[kind] = chunk.largest[kind];
        largest_line[kind] = lines + chunk.largest_line[kind];
    }
    for (const auto& [name, line] : chunk.materials) materials.emplace(name, lines + line);
    names_library = names_library || chunk.names_library;
    lines += chunk.lines;
    faces += chunk.faces;
    corners += chunk.corners;
}

/// A face may come before its vertices, so the largest number of each kind is looked at last.
void ObjScan::finish(const std::string& path) const {
    for (const auto kind : {Numbered::position, Numbered::uv, Numbered::normal}) {
        if (largest[kind] <= counts[kind]) continue;
        throw Error(at_line(path, largest_line[kind],
                            "a face names " + std::string(names[kind]) + " " + std::to_string(largest[kind]) +
                                ", but the file has " + std::to_string(counts[kind]) +
                                " (lines that begin with " + keywords[kind] + ")"));
    }
    if (faces == 0) throw Error(path + ": has no faces (lines such as \"f 1 2 3\"); is it an OBJ file?");
}

} // namespace rt
