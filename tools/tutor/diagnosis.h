// From what the checks say to the mistake that makes them say it: each mistake of the catalogue fails its own
// checks with its own values, and its signature (exercises/NN_name/signatures.txt, written by prove) holds
// which.
#pragma once

#include "tools/tutor/catalogue.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rt::tutor {

/// An assertion that did not hold.
struct Failure {
    std::string place; ///< file:line
    std::string expression;
    std::string values; ///< the expression with its values in it
    Words notes;        ///< what the check says to explain it
};

/// `unfinished`: it crashed; `endless`: it was stopped because it took too long.
enum class CheckState { ok, failed, skipped, unfinished, endless };

/// What came of one test case.
struct CheckResult {
    std::string name;
    CheckState state = CheckState::unfinished;
    double seconds = 0;
    std::vector<Failure> failures;
};

/// Reads what `test_NN_name --reporters=lines` prints. A test case without an end is unfinished.
std::vector<CheckResult> parse_results(const std::string& lines);

bool has_failed(const CheckResult& result);

/// One assertion that fails in one check, however often.
struct FailedAssertion {
    std::string check;
    std::string expression;
    std::string values; ///< of the first time, all numbers rounded to four digits
    int times = 1;
};

/// What a mistake does to the checks of its step, in their order.
struct Signature {
    std::string id;
    std::vector<FailedAssertion> assertions;
};

/// Numbers with four significant digits, at most 100 characters.
std::string rounded(std::string_view values);

/// Of one file of checks.
Signature signature_of(const std::string& id, const std::vector<CheckResult>& results);

/// The text of a .signatures file, and back. The second throws Error, which names `path` and the line.
std::string signatures_text(const std::string& step, const std::vector<Signature>& signatures);
std::vector<Signature> parse_signatures(const std::string& text, const std::string& path);

/// From `root`/exercises/NN_name/signatures.txt; none if there is no such file.
std::vector<Signature> read_signatures(const std::filesystem::path& root, const std::string& step);

/// How well a known signature fits what is seen, from 0 to 1: the shares of the checks, of their assertions
/// and of their values that both have, weighed; 1 only if nothing differs.
struct SignatureMatch {
    std::string id;
    double score = 0;
};

/// All known mistakes, those that fit best first.
std::vector<SignatureMatch> ranked(const std::vector<Signature>& known, const Signature& seen);

enum class Confidence { none, perhaps, likely, certain };

struct Diagnosis {
    Confidence confidence = Confidence::none;
    Words ids;         ///< one mistake, or those that cannot be told apart; none if none is likely
    CheckResult first; ///< the first check that failed: later ones may only follow from it
    std::optional<CheckResult> endless; ///< the first one that did not end; then no mistake is guessed at
    Words suspects;                     ///< the functions that it may hang in, if somebody knows
};

/// Of what came of each file of checks, in their order. One that fits a known mistake counts, whatever else
/// fails: other functions may still be empty. Where a check does not end no mistake is named: what it breaks
/// off says nothing.
Diagnosis diagnose(const std::vector<Signature>& known, const std::vector<std::vector<CheckResult>>& files);

/// "certainly", "most likely", "perhaps", "none that we know".
std::string name_of(Confidence confidence);

/// In finished words, over some lines: the check that does not end; or the likely mistake, why it is one and
/// what to do; or, if none is likely, the first check that failed and what it says. Empty if nothing failed.
std::string explanation(const Diagnosis& diagnosis, const std::vector<Mistake>& catalogue);

} // namespace rt::tutor
