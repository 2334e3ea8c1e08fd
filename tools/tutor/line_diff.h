// Two texts, line by line, as `diff -u` shows them.
#pragma once

#include <string>
#include <vector>

namespace rt {

/// One line of both texts (' '), of the first alone ('-') or of the second alone ('+').
struct DiffLine {
    char kind;
    std::string text;
};

/// As few changes as there can be (the longest common subsequence), unless what lies between the first and the last
/// difference is thousands of lines: then all of that counts as changed.
std::vector<DiffLine> line_diff(const std::vector<std::string>& first,
                                const std::vector<std::string>& second);

/// The changes with three lines around them, below a head that names both; empty if there are none. In colour:
/// red what goes, green what comes.
std::string unified(const std::vector<DiffLine>& diff, const std::string& first_name,
                    const std::string& second_name, bool colour);

} // namespace rt
