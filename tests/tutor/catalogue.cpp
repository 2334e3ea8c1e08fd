// Facts about the catalogue of mistakes: errors name file and line, and every mistake can be applied.
#include "tests/tutor/folder.h"

#include "common/util/error.h"
#include "tools/tutor/catalogue.h"

#include <doctest/doctest.h>

#include <set>

using namespace rt;
using namespace rt::tutor;

namespace {

const std::string header = "// A header.\n"
                           "inline float half(float x) {\n"
                           "    const float y = x;\n"
                           "    return y / 2;\n"
                           "}\n"
                           "inline float twice(float x) {\n"
                           "    const float y = x;\n"
                           "    return y * 2;\n"
                           "}\n";

const std::string good = "# Mistakes of step 01: numbers\n"
                         "\n"
                         "## not-halved: the half is the whole\n"
                         "```diff\n"
                         "01_one/half.h\n"
                         "     const float y = x;\n"
                         "-    return y / 2;\n"
                         "+    return y;\n"
                         "```\n"
                         "* Shows: all is twice\n"
                         "  as large.\n"
                         "* Why: a half is half.\n"
                         "* Fix: divide by 2.\n";

/// Returns the error for the catalogue in which `part` is replaced.
std::string complaint(const std::string& part, const std::string& instead) {
    std::string text = good;
    text.replace(text.find(part), part.size(), instead);
    try {
        for (const Mistake& mistake : parse_catalogue(text, "exercises/01_one/mistakes.md"))
            with_patch(mistake, header);
    } catch (const Error& error) {
        return error.what();
    }
    return "no complaint";
}

} // namespace

TEST_CASE("a mistake is read with all of its fields") {
    const auto mistakes = parse_catalogue(good, "exercises/01_one/mistakes.md");
    REQUIRE(mistakes.size() == 1);
    CHECK(mistakes[0].step == "01_one");
    CHECK(mistakes[0].id == "not-halved");
    CHECK(mistakes[0].title == "the half is the whole");
    CHECK(mistakes[0].file == "01_one/half.h");
    CHECK(mistakes[0].shows == "all is twice as large.");
    CHECK(mistakes[0].fix == "divide by 2.");
    CHECK(mistakes[0].place == "exercises/01_one/mistakes.md:3");
}

TEST_CASE("a mistake can have a view in which its effect is easier to see") {
    std::string text = good;
    text.insert(text.find("* Shows"), "* Closer: --fov 4 --at 0,1,2\n");
    const auto mistakes = parse_catalogue(text, "exercises/01_one/mistakes.md");
    REQUIRE(mistakes.size() == 1);
    CHECK(mistakes[0].closer == Words{"--fov", "4", "--at", "0,1,2"});
    CHECK(mistakes[0].shows == "all is twice as large.");
}

TEST_CASE("a right variant is read with its form") {
    const std::string text =
        "# Right variants of step 01: numbers\n## times-half: a product\n```diff\n"
        "01_one/half.h\n-    return y / 2;\n+    return .5f * y;\n```\n* Form: a book.\n";
    const auto variants = parse_variants(text, "exercises/01_one/variants.md");
    REQUIRE(variants.size() == 1);
    CHECK(variants[0].id == "times-half");
    CHECK(variants[0].form == "a book.");
    CHECK(with_patch(variants[0], header).find("return .5f * y;") != std::string::npos);
    CHECK_THROWS_AS(parse_catalogue(text, "exercises/01_one/mistakes.md"), Error);
}

TEST_CASE("a mistake changes its lines and nothing else") {
    std::string expected = header;
    expected.replace(expected.find("return y / 2;"), 13, "return y;");
    CHECK(with_patch(parse_catalogue(good, "exercises/01_one/mistakes.md")[0], header) == expected);
}

TEST_CASE("an error in the catalogue is one line with file and line number") {
    CHECK(complaint("# Mistakes of step 01", "# Mistakes of step 02")
              .starts_with("exercises/01_one/mistakes.md:1: "));
    CHECK(complaint("not-halved: ", "not-halved ")
              .starts_with("exercises/01_one/mistakes.md:3: an entry must begin with"));
    CHECK(complaint("not-halved", "Not halved")
              .starts_with("exercises/01_one/mistakes.md:3: the id 'Not halved'"));
    CHECK(complaint("```diff", "```").starts_with("exercises/01_one/mistakes.md:4: "));
    CHECK(complaint("01_one/half.h", "half.h").starts_with("exercises/01_one/mistakes.md:5: "));
    CHECK(complaint("01_one/half.h", "02_two/half.h").find("later step") != std::string::npos);
    CHECK(complaint("```\n*", "*").find("a line of a diff must begin with") != std::string::npos);
    CHECK(complaint("* Why: a half is half.\n", "")
              .starts_with("exercises/01_one/mistakes.md:12: expected '* Why: ...'"));
    CHECK(complaint("divide by 2.\n", "divide by 2.\n\n" + good.substr(good.find("##")))
              .find("there are two entries not-halved") != std::string::npos);
}

TEST_CASE("a change that applies nowhere or in two places is an error") {
    CHECK(complaint("y / 2", "y / 3").find("does not apply to 01_one/half.h") != std::string::npos);
    CHECK(complaint("-    return y / 2;\n+    return y;", "-    const float y = x;\n+    return y;")
              .find("does not apply") != std::string::npos);
    CHECK(complaint("     const float y = x;\n-    return y / 2;\n+    return y;",
                    "-    const float y = x;\n+    return y;")
              .find("occur twice in 01_one/half.h, at lines 3 and 7") != std::string::npos);
}

TEST_CASE("every mistake and right variant of the project applies to the reference") {
    int count = 0;
    for (const char* step : {"01_spheres", "02_shadows", "03_mirror", "04_refraction", "05_mesh_bvh",
                             "06_textures", "07_antialias", "08_indirect"}) {
        const auto mistakes = read_catalogue(RT_ROOT, step);
        CHECK_MESSAGE(mistakes.size() >= 14, std::string(step), " has too few mistakes");
        read_variants(RT_ROOT, step); // throws if one does not apply
        count += int(mistakes.size());
    }
    CHECK(count >= 120);
}
