// Parses the output of checks, stores failures as signatures, and finds the signature that fits best.
#include "tools/tutor/diagnosis.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/exercises.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <set>

namespace rt::tutor {

namespace {

const std::string not_ended = "(the check did not end)"; // signatures.txt contains this text
constexpr std::size_t max_values_length = 100;
constexpr double nearly = 0.9;

bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Returns how much of two sets with so many things is in both: the Jaccard index, 1 if both are empty.
double overlap(std::size_t both, std::size_t here, std::size_t there) {
    const std::size_t either = here + there - both;
    return either == 0 ? 1 : double(both) / double(either);
}

std::set<std::string> checks_of(const Signature& signature) {
    std::set<std::string> checks;
    for (const FailedAssertion& assertion : signature.assertions) checks.insert(assertion.check);
    return checks;
}

/// Whether two failures of an assertion agree: rounding may change how often by a few rays of many.
bool agree(const FailedAssertion& a, const FailedAssertion& b) {
    return a.values == b.values && double(std::min(a.times, b.times)) >= nearly * std::max(a.times, b.times);
}

SignatureMatch match_of(const Signature& known, const Signature& seen) {
    const std::set<std::string> here = checks_of(seen), there = checks_of(known);
    const auto checks =
        std::size_t(std::ranges::count_if(here, [&](const auto& check) { return there.contains(check); }));
    std::size_t shared = 0, agreeing = 0, equal = 0;
    for (const FailedAssertion& assertion : seen.assertions)
        for (const FailedAssertion& other : known.assertions)
            if (assertion.check == other.check && assertion.expression == other.expression) {
                ++shared;
                agreeing += agree(assertion, other);
                equal += assertion == other;
            }
    const std::size_t all_seen = seen.assertions.size(), all_known = known.assertions.size();
    return {.id = known.id,
            .score = 0.3 * overlap(checks, here.size(), there.size()) +
                     0.3 * overlap(shared, all_seen, all_known) +
                     0.4 * overlap(agreeing, all_seen, all_known),
            .may_be_named = agreeing == shared && double(agreeing) >= nearly * double(all_seen) &&
                            2 * agreeing >= all_known,
            .is_equal = equal == all_seen && equal == all_known};
}

void read_event(const Words& parts, std::vector<CheckResult>& results) {
    const auto part = [&](std::size_t i) { return i < parts.size() ? parts[i] : std::string(); };
    if (parts[0] == "case") results.push_back({part(1), CheckState::unfinished, 0, {}});
    if (results.empty()) return;
    CheckResult& result = results.back();
    if (parts[0] == "fail") result.failures.push_back({part(1), part(2), part(3), {}});
    if (parts[0] == "note" && !result.failures.empty()) result.failures.back().notes.push_back(part(1));
    if (parts[0] != "end") return;
    const std::string state = part(2);
    result.state = state == "ok"        ? CheckState::ok
                   : state == "skipped" ? CheckState::skipped
                                        : CheckState::failed;
    result.seconds = std::atof(part(3).c_str());
}

/// Returns the end of the number that begins at `begin`, or `begin` if there is no number.
std::size_t end_of_number(std::string_view text, std::size_t begin) {
    const auto behind_digits = [&](std::size_t at) {
        while (at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) != 0) ++at;
        return at;
    };
    const auto is_at = [&](std::size_t at, std::string_view signs) {
        return at < text.size() && signs.find(text[at]) != signs.npos;
    };
    if (begin > 0 && is_word(text[begin - 1])) return begin;
    std::size_t end = behind_digits(begin);
    if (end == begin) return begin;
    if (is_at(end, ".")) end = behind_digits(end + 1);
    if (!is_at(end, "eE")) return end;
    const std::size_t exponent = end + (is_at(end + 1, "+-") ? 2 : 1);
    return behind_digits(exponent) > exponent ? behind_digits(exponent) : end;
}

} // namespace

std::vector<CheckResult> parse_results(const std::string& lines) {
    std::vector<CheckResult> results;
    for (const std::string& line : lines_of(lines)) read_event(fields_of(line), results);
    return results;
}

bool has_failed(const CheckResult& result) {
    return result.state != CheckState::ok && result.state != CheckState::skipped;
}

std::string four_digits(std::string_view text, bool also_integers) {
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t end = end_of_number(text, i);
        const std::string number(text.substr(i, end - i));
        if (number.empty()) {
            out += text[i++];
            continue;
        }
        char rounded[32];
        std::snprintf(rounded, sizeof rounded, "%.4g", std::atof(number.c_str()));
        out += also_integers || number.find('.') != number.npos ? rounded : number;
        i = end;
    }
    for (std::size_t at; (at = out.find("-nan")) != std::string::npos;)
        out.erase(at, 1); // the sign of a NaN is random
    return out;
}

std::string round_numbers(std::string_view values) {
    return four_digits(values, true).substr(0, max_values_length);
}

Signature signature_of(const std::string& id, const std::vector<CheckResult>& results) {
    Signature signature{id, {}};
    const auto add = [&](const std::string& check, const std::string& expression, const std::string& values) {
        const auto same = std::ranges::find_if(signature.assertions, [&](const FailedAssertion& assertion) {
            return assertion.check == check && assertion.expression == expression;
        });
        if (same == signature.assertions.end())
            signature.assertions.push_back({check, expression, round_numbers(values), 1});
        else
            ++same->times;
    };
    for (const CheckResult& result : results) {
        if (!has_failed(result)) continue;
        for (const Failure& failure : result.failures) add(result.name, failure.expression, failure.values);
        if (result.state != CheckState::failed) add(result.name, not_ended, "");
    }
    return signature;
}

std::string signatures_text(const std::string& step, const std::vector<Signature>& signatures) {
    std::string out =
        "# How the checks of " + step +
        " fail for each of its mistakes: the mistake, the check, how often an assertion fails, the\n"
        "# assertion, and its values the first time. Written by ./learn prove --write.\n";
    for (const Signature& signature : signatures) {
        out += signature.id + "\n";
        std::string check;
        for (const FailedAssertion& assertion : signature.assertions) {
            if (assertion.check != check) out += "  " + assertion.check + "\n";
            check = assertion.check;
            out += "    " + std::to_string(assertion.times) + "\t" + assertion.expression + "\t" +
                   assertion.values + "\n";
        }
    }
    return out;
}

std::vector<Signature> parse_signatures(const std::string& text, const std::string& path) {
    std::vector<Signature> signatures;
    std::string check;
    int number = 0;
    for (const std::string& line : lines_of(text)) {
        ++number;
        if (line.empty() || line[0] == '#') continue;
        if (line[0] != ' ') {
            signatures.push_back({line, {}});
            continue;
        }
        const bool names_check = !line.starts_with("    ");
        const auto parts = fields_of(std::string_view(line).substr(std::min<std::size_t>(line.size(), 4)));
        if (signatures.empty() || !line.starts_with("  ") || (!names_check && parts.size() != 3))
            throw Error(
                path + ":" + std::to_string(number) +
                ": this line has the wrong format; run ./learn prove --write to write the file again");
        if (names_check) {
            check = line.substr(2);
        } else {
            signatures.back().assertions.push_back({check, parts[1], parts[2], std::atoi(parts[0].c_str())});
        }
    }
    return signatures;
}

std::vector<Signature> read_signatures(const std::filesystem::path& root, const std::string& step) {
    const std::filesystem::path path = root / "exercises" / step / "signatures.txt";
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) return {};
    return parse_signatures(read_file(text_of(path)), "exercises/" + step + "/signatures.txt");
}

std::vector<SignatureMatch> rank_signatures(const std::vector<Signature>& known, const Signature& seen) {
    std::vector<SignatureMatch> matches;
    for (const Signature& signature : known) matches.push_back(match_of(signature, seen));
    std::ranges::stable_sort(matches, std::greater(), &SignatureMatch::score);
    return matches;
}

Diagnosis diagnose(const std::vector<Signature>& known, const std::vector<CheckResult>& results) {
    constexpr double likely_score = 0.65;
    Diagnosis diagnosis;
    const auto failed = std::ranges::find_if(results, has_failed);
    if (failed == results.end()) return diagnosis;
    diagnosis.first = *failed;
    const auto endless = std::ranges::find(results, CheckState::endless, &CheckResult::state);
    if (endless != results.end()) {
        diagnosis.endless = *endless;
        return diagnosis;
    }
    std::vector<SignatureMatch> matches = rank_signatures(known, signature_of("", results));
    std::erase_if(matches, [](const SignatureMatch& match) { return !match.may_be_named; });
    for (const SignatureMatch& match : matches)
        if (match.score > matches[0].score - 1e-9) diagnosis.ids.push_back(match.id);
    if (diagnosis.ids.size() > 2) diagnosis.ids.clear();
    diagnosis.confidence = diagnosis.ids.empty()             ? Confidence::none
                           : matches[0].is_equal             ? Confidence::certain
                           : matches[0].score > likely_score ? Confidence::likely
                                                             : Confidence::perhaps;
    return diagnosis;
}

std::string name_of(Confidence confidence) {
    switch (confidence) {
    case Confidence::certain: return "certain";
    case Confidence::likely: return "likely";
    case Confidence::perhaps: return "possible";
    default: return "no known mistake";
    }
}

namespace {

std::string endless_text(const Diagnosis& diagnosis) {
    std::string out = "A check does not finish, so the other results say little:\n  " +
                      diagnosis.endless->name + "\n  Look for an endless loop or recursion";
    for (std::size_t i = 0; i < diagnosis.suspects.size(); ++i)
        out += (i == 0 ? " in " : " or ") + diagnosis.suspects[i];
    return out + ".\n";
}

} // namespace

std::string explanation(const Diagnosis& diagnosis, const std::vector<Mistake>& catalogue) {
    if (diagnosis.first.name.empty()) return "";
    if (diagnosis.endless) return endless_text(diagnosis);
    std::string out;
    if (diagnosis.ids.size() > 1) out += "One of these; the checks cannot tell them apart:\n";
    for (const std::string& id : diagnosis.ids) {
        const auto mistake = std::ranges::find(catalogue, id, &Mistake::id);
        if (mistake == catalogue.end()) continue;
        out += mistake->title + " (" + name_of(diagnosis.confidence) + ")\n  Why: " + mistake->why +
               "\n  Fix: " + mistake->fix + "\n";
    }
    if (!out.empty()) return out;
    out = "No known mistake fits. Start with the first check that fails; later failures may only\n"
          "be consequences of it:\n  " +
          diagnosis.first.name + "\n";
    if (diagnosis.first.failures.empty()) return out + "  it does not finish\n";
    const Failure& failure = diagnosis.first.failures[0];
    out += "  " + failure.expression + ": " + failure.values + "\n";
    for (const std::string& note : failure.notes) out += "  " + note + "\n";
    return out;
}

} // namespace rt::tutor
