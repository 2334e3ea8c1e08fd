// The longest common subsequence by the usual table, and the changes gathered into hunks.
#include "tools/tutor/line_diff.h"

#include "common/util/report_error.h"

#include <algorithm>
#include <cstdint>

namespace rt {

namespace {

using Lines = std::vector<std::string>;

constexpr std::size_t context = 3;
constexpr std::size_t largest_table = std::size_t(1) << 24;

/// length[i][j]: of the longest common subsequence of a[i...] and b[j...].
class Table {
  public:
    Table(const Lines& a, const Lines& b) : width(b.size() + 1), lengths((a.size() + 1) * width) {
        for (std::size_t i = a.size(); i-- > 0;)
            for (std::size_t j = b.size(); j-- > 0;)
                lengths[i * width + j] =
                    a[i] == b[j] ? at(i + 1, j + 1) + 1 : std::max(at(i + 1, j), at(i, j + 1));
    }
    std::uint32_t at(std::size_t i, std::size_t j) const { return lengths[i * width + j]; }

  private:
    std::size_t width;
    std::vector<std::uint32_t> lengths;
};

void add_all(std::vector<DiffLine>& diff, char kind, const Lines& lines, std::size_t first = 0) {
    for (std::size_t i = first; i < lines.size(); ++i) diff.push_back({kind, lines[i]});
}

void add_changes(std::vector<DiffLine>& diff, const Lines& a, const Lines& b) {
    std::size_t i = 0, j = 0;
    if (a.size() < largest_table / (b.size() + 1)) {
        const Table table(a, b);
        while (i < a.size() && j < b.size()) {
            if (a[i] == b[j]) {
                diff.push_back({' ', a[i++]});
                ++j;
            } else if (table.at(i + 1, j) >= table.at(i, j + 1)) {
                diff.push_back({'-', a[i++]});
            } else {
                diff.push_back({'+', b[j++]});
            }
        }
    }
    add_all(diff, '-', a, i);
    add_all(diff, '+', b, j);
}

struct Hunk {
    std::size_t begin, end; ///< of the lines of the diff
};

/// The changes and what is near them; those that touch are one.
std::vector<Hunk> hunks_of(const std::vector<DiffLine>& diff) {
    std::vector<Hunk> hunks;
    for (std::size_t i = 0; i < diff.size(); ++i) {
        if (diff[i].kind == ' ') continue;
        const std::size_t begin = i < context ? 0 : i - context;
        const std::size_t end = std::min(diff.size(), i + 1 + context);
        if (hunks.empty() || begin > hunks.back().end)
            hunks.push_back({begin, end});
        else
            hunks.back().end = end;
    }
    return hunks;
}

std::string painted(const char* code, const std::string& line, bool colour) {
    const std::string text = printable_lines(line);
    return colour ? std::string("\x1b[") + code + "m" + text + "\x1b[0m\n" : text + "\n";
}

/// "12,7": the first of these lines and how many, as diff -u says it.
std::string range(std::size_t before, std::size_t count) {
    const std::string first = std::to_string(count == 0 ? before : before + 1);
    return count == 1 ? first : first + "," + std::to_string(count);
}

std::size_t count_of(const std::vector<DiffLine>& diff, std::size_t begin, std::size_t end, char kind) {
    const auto counts = [kind](const DiffLine& line) { return line.kind == ' ' || line.kind == kind; };
    return std::size_t(
        std::count_if(diff.begin() + std::ptrdiff_t(begin), diff.begin() + std::ptrdiff_t(end), counts));
}

std::string head(const std::vector<DiffLine>& diff, const Hunk& hunk) {
    const auto side = [&](char kind) {
        return range(count_of(diff, 0, hunk.begin, kind), count_of(diff, hunk.begin, hunk.end, kind));
    };
    return "@@ -" + side('-') + " +" + side('+') + " @@";
}

} // namespace

std::vector<DiffLine> line_diff(const Lines& first, const Lines& second) {
    const auto [a, b] = std::ranges::mismatch(first, second);
    const std::size_t before = std::size_t(a - first.begin());
    std::size_t behind = 0;
    while (behind < first.size() - before && behind < second.size() - before &&
           first[first.size() - 1 - behind] == second[second.size() - 1 - behind])
        ++behind;
    std::vector<DiffLine> diff;
    add_all(diff, ' ', Lines(first.begin(), a));
    add_changes(diff, Lines(a, first.end() - std::ptrdiff_t(behind)),
                Lines(b, second.end() - std::ptrdiff_t(behind)));
    add_all(diff, ' ', Lines(first.end() - std::ptrdiff_t(behind), first.end()));
    return diff;
}

std::string unified(const std::vector<DiffLine>& diff, const std::string& first_name,
                    const std::string& second_name, bool colour) {
    std::string text;
    for (const Hunk& hunk : hunks_of(diff)) {
        if (text.empty())
            text = painted("1", "--- " + first_name, colour) + painted("1", "+++ " + second_name, colour);
        text += painted("36", head(diff, hunk), colour);
        for (std::size_t i = hunk.begin; i < hunk.end; ++i) {
            const auto& [kind, line] = diff[i];
            if (kind == ' ')
                text += ' ' + printable_lines(line) + "\n";
            else
                text += painted(kind == '-' ? "31" : "32", kind + line, colour);
        }
    }
    return text;
}

} // namespace rt
