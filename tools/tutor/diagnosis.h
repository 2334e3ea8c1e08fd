// Finds the mistake that explains the results of the checks.
// Each mistake of the catalogue fails certain checks with certain values. Its signature, in
// exercises/NN_name/signatures.txt, records them; ./learn prove --write writes that file.
#pragma once

#include "tools/tutor/catalogue.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rt::tutor {

/// A failed assertion.
struct Failure {
    std::string place; ///< file:line
    std::string expression;
    std::string values; ///< the expression with its values in it
    Words notes;        ///< the check's explanations
};

/// The state of a check. `unfinished`: it crashed; `endless`: it was stopped because it took too long.
enum class CheckState { ok, failed, skipped, unfinished, endless };

/// The result of one test case.
struct CheckResult {
    std::string name;
    CheckState state = CheckState::unfinished;
    double seconds = 0;
    std::vector<Failure> failures;
    std::string cause{}; ///< what a second run found out, such as where the first NaN arose
};

/// Parses the output of `test_NN_name --reporters=lines`. A test case without an end is unfinished.
std::vector<CheckResult> parse_results(const std::string& lines);

bool has_failed(const CheckResult& result);

/// An assertion that fails in a check, one or more times.
struct FailedAssertion {
    std::string check;
    std::string expression;
    std::string values; ///< from the first failure, with all numbers rounded to four digits
    int times = 1;

    bool operator==(const FailedAssertion&) const = default;
};

/// The assertions that a mistake makes fail, in the order of the checks.
struct Signature {
    std::string id;
    std::vector<FailedAssertion> assertions;
};

/// Returns the text with its fractions, or all of its numbers, rounded to four significant digits.
std::string four_digits(std::string_view text, bool also_integers = false);

/// Returns the text with all numbers rounded to four significant digits, cut off after 100 characters.
std::string round_numbers(std::string_view values);

/// Builds the signature of the results of one file of checks.
Signature signature_of(const std::string& id, const std::vector<CheckResult>& results);

/// Write and parse the text of a signatures.txt. The second throws Error, which names `path` and the line.
std::string signatures_text(const std::string& step, const std::vector<Signature>& signatures);
std::vector<Signature> parse_signatures(const std::string& text, const std::string& path);

/// Returns the signatures in `root`/exercises/NN_name/signatures.txt; empty if there is no such file.
std::vector<Signature> read_signatures(const std::filesystem::path& root, const std::string& step);

/// How well a known signature fits the observed one.
struct SignatureMatch {
    std::string id;
    double score =
        0; ///< from 0 to 1: a weighted mean of the Jaccard indices of their checks, assertions and values
    bool may_be_named = false; ///< explains nine tenths of what is seen, half of it is seen, no value differs
    bool is_equal = false;     ///< nothing differs, not even how often an assertion fails
};

/// Returns all known mistakes, best match first.
std::vector<SignatureMatch> rank_signatures(const std::vector<Signature>& known, const Signature& seen);

enum class Confidence { none, perhaps, likely, certain };

struct Diagnosis {
    Confidence confidence = Confidence::none;
    Words ids;         ///< the likely mistake, or several that the checks cannot tell apart; may be empty
    CheckResult first; ///< the first check that failed; later failures may only follow from it
    std::optional<CheckResult> endless; ///< the first check that did not finish; if set, `ids` is empty
    Words suspects;                     ///< the functions in which that check may hang, if known
};

/// Diagnoses the results of the checks. The name of a mistake must explain what is red: nearly all failures
/// are its own, half of its own are there, and none of them has another value or comes much more or less
/// often. It is certain only if nothing differs. More than two names are none. If a check does not finish, no
/// mistake is named, because the results are incomplete.
Diagnosis diagnose(const std::vector<Signature>& known, const std::vector<CheckResult>& results);

/// Returns "certain", "likely", "possible" or "no known mistake".
std::string name_of(Confidence confidence);

/// Returns the diagnosis as several lines of text: the check that does not finish; or the likely
/// mistake, its cause and its fix; or, if no mistake is likely, the first failed check and its message.
/// Empty if nothing failed.
std::string explanation(const Diagnosis& diagnosis, const std::vector<Mistake>& catalogue);

} // namespace rt::tutor
