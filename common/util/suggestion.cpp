// Finds the name that was probably meant: the candidate with the fewest edits, at most two.
#include "common/util/suggestion.h"

#include <string_view>

namespace rt {
namespace {

/// Returns whether `a` becomes `b` by at most `edits` edits: a letter inserted, deleted, replaced, or
/// swapped with its neighbour.
bool within(std::string_view a, std::string_view b, int edits) {
    while (!a.empty() && !b.empty() && a[0] == b[0]) a.remove_prefix(1), b.remove_prefix(1);
    if (a.empty() && b.empty()) return true;
    if (edits == 0) return false;
    const std::string_view a_rest = a.substr(!a.empty()), b_rest = b.substr(!b.empty());
    if (within(a_rest, b, edits - 1) || within(a, b_rest, edits - 1) || within(a_rest, b_rest, edits - 1))
        return true;
    const bool swapped = a.size() > 1 && b.size() > 1 && a[0] == b[1] && a[1] == b[0];
    return swapped && within(a.substr(2), b.substr(2), edits - 1);
}

} // namespace

std::string suggestion(const std::string& typed, const std::vector<std::string>& candidates,
                       const std::string& dashes) {
    for (const int edits : {0, 1, 2})
        for (const std::string& candidate : candidates) {
            const bool begins_it = edits == 1 && typed.size() >= 3 && candidate.rfind(typed, 0) == 0;
            const bool long_enough = 3 * std::size_t(edits) < 2 * candidate.size();
            if (begins_it || (long_enough && within(typed, candidate, edits)))
                return " (did you mean " + dashes + candidate + "?)";
        }
    return "";
}

} // namespace rt
