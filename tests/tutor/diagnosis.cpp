// Facts about the diagnosis: from the output of checks to the name of a mistake.
#include "tests/tutor/folder.h"

#include "common/util/error.h"
#include "tools/tutor/catalogue.h"
#include "tools/tutor/diagnosis.h"

#include <doctest/doctest.h>

using namespace rt;
using namespace rt::tutor;

namespace {

const std::string lines = "case\ta ball is met at t = 4\n"
                          "fail\ttests/01_one.cpp:7\tt == approx(4)\t6.00000001 == 4 within 1e-05\n"
                          "note\tthat is the far root\n"
                          "fail\ttests/01_one.cpp:7\tt == approx(4)\t8 == 4 within 1e-05\n"
                          "end\ta ball is met at t = 4\tfailed\t0.002\n"
                          "case\ta plane has two sides\n"
                          "end\ta plane has two sides\tok\t0.001\n"
                          "case\tmeshes of this machine\n"
                          "end\tmeshes of this machine\tskipped\t0\n"
                          "case\ta ray that never ends\n";

Signature known(const std::string& id, const std::vector<std::string>& checks, const std::string& values) {
    Signature signature{id, {}};
    for (const std::string& check : checks) signature.assertions.push_back({check, "t == 4", values, 1});
    return signature;
}

std::vector<CheckResult> seen(const std::vector<std::string>& checks, const std::string& values) {
    std::vector<CheckResult> results;
    for (const std::string& check : checks)
        results.push_back(
            {check, CheckState::failed, 0, {{"tests/01_one.cpp:3", "t == 4", values, {"why"}}}});
    return results;
}

} // namespace

TEST_CASE("the output of checks is parsed and a check without an end is unfinished") {
    const auto results = parse_results(lines);
    REQUIRE(results.size() == 4);
    CHECK(results[0].state == CheckState::failed);
    CHECK(results[0].seconds == doctest::Approx(0.002));
    REQUIRE(results[0].failures.size() == 2);
    CHECK(results[0].failures[0].place == "tests/01_one.cpp:7");
    CHECK(results[0].failures[0].notes == std::vector<std::string>{"that is the far root"});
    CHECK(results[1].state == CheckState::ok);
    CHECK(results[2].state == CheckState::skipped);
    CHECK(results[3].state == CheckState::unfinished);
    CHECK(has_failed(results[3]));
    CHECK_FALSE(has_failed(results[2]));
}

TEST_CASE("numbers are rounded to four digits and other text is unchanged") {
    CHECK(round_numbers("6.00000001 == 4 within 1e-05") == "6 == 4 within 1e-05");
    CHECK(round_numbers("(0.123456, -12345.6, 7)") == "(0.1235, -1.235e+04, 7)");
    CHECK(round_numbers("vec3 x2 {?} -nan") == "vec3 x2 {?} nan");
    CHECK(four_digits("256000 rays, got 3.58578634 within 1e-05") == "256000 rays, got 3.586 within 1e-05");
    CHECK(round_numbers(std::string(500, 'x')).size() == 100);
    CHECK(round_numbers("1.50000 1. 2e 2e+ 3e-07x 4E2 .5 x5 -0") == "1.5 1 2e 2e+ 3e-07x 400 .5 x5 -0");
}

TEST_CASE("a signature contains each assertion once with the number of its failures") {
    const Signature signature = signature_of("far", parse_results(lines));
    REQUIRE(signature.assertions.size() == 2);
    CHECK(signature.assertions[0].times == 2);
    CHECK(signature.assertions[0].values == "6 == 4 within 1e-05");
    CHECK(signature.assertions[1].check == "a ray that never ends");
}

TEST_CASE("signatures are written and read back") {
    const Signature signature = signature_of("far", parse_results(lines));
    const auto back =
        parse_signatures(signatures_text("01_one", {signature}), "exercises/01_one/signatures.txt");
    REQUIRE(back.size() == 1);
    CHECK(back[0].id == "far");
    REQUIRE(back[0].assertions.size() == 2);
    CHECK(back[0].assertions[0].check == "a ball is met at t = 4");
    CHECK(back[0].assertions[0].expression == "t == approx(4)");
    CHECK(back[0].assertions[0].times == 2);
    CHECK_THROWS_WITH_AS(parse_signatures("far\n    nonsense\n", "exercises/01_one/signatures.txt"),
                         "exercises/01_one/signatures.txt:2: this line has the wrong format; run ./learn "
                         "prove --write to write the file again",
                         Error);
    for (const char* damaged :
         {" ", "far\n ", "far\n a check", "far\n    ", "  a check\n", "    1\ta\tb\n"}) {
        CAPTURE(std::string(damaged));
        CHECK_THROWS_AS(parse_signatures(damaged, "x"), Error);
    }
}

TEST_CASE("a check that does not terminate is reported with its function and no mistake is guessed") {
    const std::vector<Signature> all{known("far", {"a", "b"}, "6 == 4")};
    auto broken_off = seen({"a", "b"}, "6 == 4");
    broken_off[1].state = CheckState::endless;
    Diagnosis diagnosis = diagnose(all, broken_off);
    CHECK(diagnosis.ids.empty());
    CHECK(diagnosis.confidence == Confidence::none);
    REQUIRE(diagnosis.endless);
    CHECK(diagnosis.endless->name == "b");
    diagnosis.suspects = {"half (workshop/01_one/shape.h:5)"};
    const std::string words = explanation(diagnosis, {});
    for (const char* part :
         {"does not finish", "  b\n", "endless loop or recursion", "half (workshop/01_one/shape.h:5)"})
        CHECK_MESSAGE(words.find(part) != std::string::npos, words);
}

TEST_CASE("a mistake whose signature is seen is named with certainty") {
    const std::vector<Signature> all{known("near", {"a", "b"}, "2 == 4"), known("far", {"a", "b"}, "6 == 4"),
                                     known("none", {"a", "b", "c"}, "6 == 4")};
    const Diagnosis diagnosis = diagnose(all, seen({"a", "b"}, "6 == 4"));
    CHECK(diagnosis.confidence == Confidence::certain);
    CHECK(diagnosis.ids == std::vector<std::string>{"far"});
    CHECK(diagnosis.first.name == "a");
    CHECK(diagnosis.first.failures[0].notes[0] == "why");
}

TEST_CASE("mistakes that cannot be distinguished are named together") {
    const std::vector<Signature> all{known("one", {"a"}, "6 == 4"), known("two", {"a"}, "6 == 4"),
                                     known("three", {"b"}, "6 == 4")};
    CHECK(diagnose(all, seen({"a"}, "6 == 4")).ids == std::vector<std::string>{"one", "two"});
}

TEST_CASE("more than two names are none") {
    const std::vector<Signature> all{known("one", {"a"}, "6 == 4"), known("two", {"a"}, "6 == 4"),
                                     known("three", {"a"}, "6 == 4")};
    CHECK(diagnose(all, seen({"a"}, "6 == 4")).ids.empty());
}

TEST_CASE("the same checks with other values are no name: a value that differs is a contradiction") {
    const std::vector<Signature> all{known("far", {"a", "b", "c"}, "6 == 4")};
    CHECK(diagnose(all, seen({"a", "b", "c"}, "5 == 4")).ids.empty());
    auto mostly = seen({"a", "b", "c"}, "6 == 4");
    mostly[2].failures[0].values = "5 == 4";
    CHECK(diagnose(all, mostly).ids.empty());
}

TEST_CASE("a name is certain only if each assertion fails as often and none if one fails twice as often") {
    const auto fails = [](int times) {
        auto results = seen({"a"}, "6 == 4");
        results[0].failures.resize(std::size_t(times), results[0].failures[0]);
        return results;
    };
    const std::vector<Signature> all{signature_of("far", fails(20))};
    CHECK(diagnose(all, fails(20)).confidence == Confidence::certain);
    CHECK(diagnose(all, fails(19)).confidence == Confidence::likely);
    CHECK(diagnose(all, fails(19)).ids == std::vector<std::string>{"far"});
    CHECK(diagnose(all, fails(40)).ids.empty());
    CHECK(diagnose(all, fails(10)).ids.empty());
}

TEST_CASE("a name explains all that is red and half of its own failures are there") {
    const std::vector<Signature> all{known("far", {"a", "b", "c", "d"}, "6 == 4")};
    CHECK(diagnose(all, seen({"a", "b"}, "6 == 4")).ids == std::vector<std::string>{"far"});
    CHECK(diagnose(all, seen({"a"}, "6 == 4")).ids.empty());
    CHECK(diagnose(all, seen({"a", "b", "c", "d", "x"}, "6 == 4")).ids.empty());
}

TEST_CASE("an unknown mistake is not named but its first failing check is") {
    const std::vector<Signature> all{known("far", {"a", "b"}, "6 == 4")};
    const Diagnosis diagnosis = diagnose(all, seen({"c", "d"}, "1 == 4"));
    CHECK(diagnosis.confidence == Confidence::none);
    CHECK(diagnosis.ids.empty());
    CHECK(diagnosis.first.name == "c");
}

TEST_CASE("a signature that lacks a check is named as likely") {
    const std::vector<Signature> all{known("far", {"a", "b", "c", "d"}, "6 == 4"),
                                     known("other", {"a", "x", "y"}, "6 == 4")};
    const Diagnosis diagnosis = diagnose(all, seen({"a", "b", "c"}, "6 == 4"));
    CHECK(diagnosis.confidence == Confidence::likely);
    CHECK(diagnosis.ids == std::vector<std::string>{"far"});
}

TEST_CASE(
    "a diagnosis is explained by the mistake, its cause and its fix, or else by the first failing check") {
    Mistake far;
    far.id = "far";
    far.title = "the far root";
    far.why = "it is farther";
    far.fix = "take the near one";
    const std::vector<Mistake> catalogue{far};
    const std::vector<Signature> all{known("far", {"a"}, "6 == 4")};
    const std::string named = explanation(diagnose(all, seen({"a"}, "6 == 4")), catalogue);
    for (const char* part : {"the far root (certain)", "Why: it is farther", "Fix: take the near one"})
        CHECK_MESSAGE(named.find(part) != std::string::npos, named);
    const std::string unnamed = explanation(diagnose(all, seen({"c"}, "1 == 4")), catalogue);
    for (const char* part : {"No known mistake fits", "  c\n", "t == 4: 1 == 4", "why"})
        CHECK_MESSAGE(unnamed.find(part) != std::string::npos, unnamed);
    CHECK(explanation({}, catalogue).empty());
}

TEST_CASE("without failures, nothing is diagnosed") {
    auto results = seen({"a"}, "6 == 4");
    results[0].state = CheckState::ok;
    CHECK(diagnose({known("far", {"a"}, "6 == 4")}, results).confidence == Confidence::none);
}

TEST_CASE("every mistake of the project with a recorded signature is diagnosed as itself or in its group") {
    for (const char* step : {"01_spheres", "02_shadows", "03_mirror", "04_refraction", "05_mesh_bvh",
                             "06_textures", "07_antialias", "08_indirect"}) {
        const auto signatures = read_signatures(RT_ROOT, step);
        const auto mistakes = read_catalogue(RT_ROOT, step);
        CHECK_MESSAGE(signatures.size() == mistakes.size(), std::string(step), ": run ./learn prove --write");
        for (const Signature& signature : signatures) {
            const std::vector<SignatureMatch> matches = rank_signatures(signatures, signature);
            CHECK_MESSAGE(matches[0].score == doctest::Approx(1), signature.id);
        }
    }
}
