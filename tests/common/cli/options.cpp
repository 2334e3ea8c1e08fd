// Facts about the command line: valid input is read, invalid input is rejected with one line that states why.
#include "common/cli/options.h"

#include "common/util/error.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <iostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

enum class View { light, normal, depth };

/// A program with one option of each type.
struct Program {
    rt::Options options;
    const float& ior;
    const int& depth;
    const rt::dvec3& from;
    const bool& bare;
    const std::string& mesh;
    const rt::Choice<View> view;

    Program()
        : options("03_test", "What is asked here?", {}),
          ior(options.option("ior", 1.5f, 1.0f, 2.5f, "index of refraction")),
          depth(options.option("depth", 5, 1, 20, "most bounces of a path")),
          from(options.option("from", rt::vec3(0, 1.25f, -4), "where the camera stands, metres")),
          bare(options.flag("bare", "the model alone")), mesh(options.file("mesh", "an OBJ to render")),
          view(options.choice("view", {"light", "normal", "depth"}, View::normal, "what a ray shows")) {}

    bool parse(const std::vector<std::string>& words) {
        std::vector<const char*> argv{"03_test"};
        for (const std::string& word : words) argv.push_back(word.c_str());
        return options.parse(int(argv.size()), argv.data());
    }
};

/// Returns the message that rejects `words`, or "" if they are accepted.
std::string refusal(const std::vector<std::string>& words) {
    Program program;
    try {
        program.parse(words);
    } catch (const rt::Error& error) {
        return error.what();
    }
    return "";
}

bool contains(const std::string& text, const std::string& fragment) {
    return text.find(fragment) != std::string::npos;
}

struct Wrong {
    std::vector<std::string> words;
    std::vector<std::string> fragments; ///< that the message contains
};

void check_refused(const std::vector<Wrong>& all) {
    for (const Wrong& wrong : all) {
        std::string line;
        for (const std::string& word : wrong.words) line += word + " ";
        CAPTURE(line);
        const std::string message = refusal(wrong.words);
        CAPTURE(message);
        CHECK_FALSE(message.empty());
        CHECK_FALSE(contains(message, "\n"));
        for (const std::string& fragment : wrong.fragments) {
            CAPTURE(fragment);
            CHECK(contains(message, fragment));
        }
    }
}

std::string help_text(const std::vector<std::string>& words) {
    std::ostringstream text;
    std::streambuf* const old = std::cout.rdbuf(text.rdbuf());
    Program program;
    const bool goes_on = program.parse(words);
    std::cout.rdbuf(old);
    CHECK_FALSE(goes_on);
    return text.str();
}

} // namespace

TEST_CASE("an empty command line gives the defaults") {
    Program program;
    CHECK(program.parse({}));
    CHECK(program.ior == 1.5f);
    CHECK(program.depth == 5);
    CHECK(program.from == rt::dvec3(0, 1.25, -4));
    CHECK_FALSE(program.bare);
    CHECK(program.mesh.empty());
    CHECK(View(program.view) == View::normal);
    const rt::RenderSettings& settings = program.options.settings();
    CHECK(settings.width == 640);
    CHECK(settings.height == 400);
    CHECK(settings.samples == 1);
    CHECK(settings.threads == 0);
    CHECK(settings.seed == 1);
    CHECK((settings.crop.x0 == 0 && settings.crop.y0 == 0 && settings.crop.x1 == 640 &&
           settings.crop.y1 == 400));
    CHECK(settings.out == "03_test");
    CHECK(settings.variance.empty());
    CHECK_FALSE(settings.quiet);
}

TEST_CASE("each option sets the value that it names") {
    Program program;
    CHECK(program.parse({"--ior",
                         "2.25",
                         "--depth",
                         "7",
                         "--from",
                         "1,2,3.5",
                         "--bare",
                         "--view",
                         "depth",
                         "--width",
                         "300",
                         "--height",
                         "200",
                         "--samples",
                         "9",
                         "--threads",
                         "3",
                         "--seed",
                         "18446744073709551615",
                         "--crop",
                         "10,20,300,81",
                         "--out",
                         "a b/c.png",
                         "--variance",
                         "v.hdr",
                         "--quiet",
                         "--mesh",
                         __FILE__}));
    CHECK(program.ior == 2.25f);
    CHECK(program.depth == 7);
    CHECK(program.from == rt::dvec3(1, 2, 3.5));
    CHECK(program.bare);
    CHECK(program.mesh == __FILE__);
    CHECK(View(program.view) == View::depth);
    const rt::RenderSettings& settings = program.options.settings();
    CHECK(settings.width == 300);
    CHECK(settings.height == 200);
    CHECK(settings.samples == 9);
    CHECK(settings.threads == 3);
    CHECK(settings.seed == 18446744073709551615u);
    CHECK((settings.crop.x0 == 10 && settings.crop.y0 == 20 && settings.crop.x1 == 300 &&
           settings.crop.y1 == 81));
    CHECK(settings.out == "a b/c.png");
    CHECK(settings.variance == "v.hdr");
    CHECK(settings.quiet);
}

TEST_CASE("a value may be negative and may follow an equals sign") {
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"--from", "-1,-0.5,-2e1"}, {"--from=-1,-.5,-20"}, {"--from", "-1,-0.5,-20.0"}}) {
        Program program;
        CHECK(program.parse(words));
        CHECK(program.from == rt::dvec3(-1, -0.5, -20));
    }
    Program dotted;
    CHECK(dotted.parse({"--from", "-.5,+.25,1.", "--depth=+6"}));
    CHECK(dotted.from == rt::dvec3(-0.5, 0.25, 1));
    Program far;
    CHECK(far.parse({"--from", "500000.125,4649776.22,12.5"}));
    CHECK_MESSAGE(far.from == rt::dvec3(500000.125, 4649776.22, 12.5),
                  "no digit may be lost: a float has 7, these have 9");
    CHECK(dotted.depth == 6);
}

TEST_CASE("the ends of a range are inside it") {
    Program low, high;
    CHECK(low.parse(
        {"--ior", "1", "--depth", "1", "--width", "1", "--height", "1", "--samples", "1", "--seed", "0"}));
    CHECK(low.ior == 1);
    CHECK(low.options.settings().seed == 0);
    CHECK(high.parse({"--ior", "2.5", "--depth", "20", "--width", "65536", "--height", "65536", "--crop",
                      "65535,65530,65536,65536", "--samples", "1048576", "--threads", "1024"}));
    CHECK(high.ior == 2.5f);
    CHECK(high.options.settings().crop.x1 == 65536);
}

TEST_CASE("is_set distinguishes explicit values from defaults") {
    Program program;
    CHECK(program.parse(
        {"--ior", "1.5", "--bare", "--width", "640"})); // the default values, but given explicitly
    CHECK(program.options.is_set("ior"));
    CHECK(program.options.is_set("bare"));
    CHECK(program.options.is_set("width"));
    CHECK_FALSE(program.options.is_set("depth"));
    CHECK_FALSE(program.options.is_set("height"));
    CHECK_THROWS_AS(program.options.is_set("no_such_option"), std::logic_error);
}

TEST_CASE("a number out of its range is rejected with the range") {
    check_refused({
        {{"--ior", "7"}, {"--ior \"7\" is not a number from 1 to 2.5"}},
        {{"--ior", "0.999"}, {"--ior \"0.999\" is not a number from 1 to 2.5"}},
        {{"--ior", "-2"}, {"--ior \"-2\" is not a number from 1 to 2.5"}},
        {{"--ior", "1e99"}, {"--ior \"1e99\" is not a number from 1 to 2.5"}},
        {{"--ior", "2.5000003"}, {"is not a number from 1 to 2.5"}},
        {{"--depth", "0"}, {"--depth \"0\" is not a whole number from 1 to 20"}},
        {{"--depth", "21"}, {"--depth \"21\" is not a whole number from 1 to 20"}},
        {{"--depth", "4294967301"}, {"is not a whole number from 1 to 20"}}, // 5 + 2^32
        {{"--width", "0"}, {"--width \"0\" is not a whole number from 1 to 65536"}},
        {{"--width", "65537"}, {"is not a whole number from 1 to 65536"}},
        {{"--height", "-4"}, {"--height \"-4\" is not a whole number from 1 to 65536"}},
        {{"--samples", "0"}, {"--samples \"0\" is not a whole number from 1 to 1048576"}},
        {{"--samples", "99999999999999999999"}, {"--samples", "is not a whole number from 1 to 1048576"}},
        {{"--threads", "-1"}, {"--threads \"-1\" is not a whole number from 0 to 1024"}},
        {{"--seed", "-1"}, {"--seed \"-1\" is not a whole number from 0 to 18446744073709551615"}},
        {{"--seed", "18446744073709551616"},
         {"--seed", "is not a whole number from 0 to 18446744073709551615"}},
    });
}

TEST_CASE("a value that is not a number is rejected with the range") {
    check_refused({
        {{"--ior", "glass"}, {"--ior \"glass\" is not a number from 1 to 2.5"}},
        {{"--ior", "1.5x"}, {"--ior \"1.5x\" is not a number from 1 to 2.5"}},
        {{"--ior", "1.5 "}, {"--ior", "is not a number from 1 to 2.5"}},
        {{"--ior", " 1.5"}, {"--ior", "is not a number from 1 to 2.5"}},
        {{"--ior", "1,5"}, {"--ior \"1,5\" is not a number from 1 to 2.5"}},
        {{"--ior", "nan"}, {"--ior \"nan\" is not a number from 1 to 2.5"}},
        {{"--ior", "inf"}, {"--ior \"inf\" is not a number from 1 to 2.5"}},
        {{"--ior", "0x1p0"}, {"--ior \"0x1p0\" is not a number from 1 to 2.5"}},
        {{"--ior", "1.5.5"}, {"is not a number from 1 to 2.5"}},
        {{"--ior", "."}, {"is not a number from 1 to 2.5"}},
        {{"--ior", ""}, {"--ior \"\" is not a number from 1 to 2.5"}},
        {{"--depth", "1.5"}, {"--depth \"1.5\" is not a whole number from 1 to 20"}},
        {{"--depth", "5x"}, {"--depth \"5x\" is not a whole number from 1 to 20"}},
        {{"--depth", "-"}, {"--depth \"-\" is not a whole number from 1 to 20"}},
        {{"--depth", "--5"}, {"--depth"}},
        {{"--width", "640px"}, {"--width \"640px\" is not a whole number from 1 to 65536"}},
        {{"--seed", "1e3"}, {"--seed \"1e3\" is not a whole number from 0 to 18446744073709551615"}},
    });
}

TEST_CASE("a point is three finite numbers") {
    for (const std::string text : {"1,2", "1,2,3,4", "1,,3", "1,2,", "1,2,3,", ",1,2", "", "1,2,up", "1,2,3z",
                                   "0,nan,0", "0,-inf,0", "0,1e39,0", "0,1e999,0"})
        check_refused({{{"--from", text},
                        {"--from \"" + text + "\" is not three finite numbers x,y,z, as in 0,1.5,-2"}}});
}

TEST_CASE("a crop is a rectangle inside the picture") {
    const std::string right =
        "is not four whole numbers x0,y0,x1,y1 with 0 <= x0 < x1 <= 640 and 0 <= y0 < y1 <= 400";
    for (const std::string text :
         {"10,20,641,80", "10,20,60,401", "10,20,10,80", "10,20,60,20", "60,20,10,80", "700,0,800,10",
          "-1,0,10,10", "10,20,60", "1,2,3,4,5", "1,2,3.5,4", "a,b,c,d", ""})
        check_refused({{{"--crop", text}, {"--crop \"" + text + "\" " + right}}});
    Program program; // the order of the options does not matter
    CHECK(program.parse({"--crop", "0,0,1000,900", "--width", "1000", "--height", "900"}));
}

TEST_CASE("an unknown option is rejected with a suggestion of the likely one") {
    check_refused({
        {{"--sampels", "4"}, {"\"--sampels\" is not an option of 03_test", "did you mean --samples?"}},
        {{"--sample=4"}, {"\"--sample\" is not an option", "did you mean --samples?"}},
        {{"--widht", "4"}, {"did you mean --width?"}},
        {{"-width", "4"}, {"did you mean --width?"}},
        {{"--hieght", "4"}, {"did you mean --height?"}},
        {{"--var", "a.hdr"}, {"did you mean --variance?"}},
        {{"--Quiet"}, {"did you mean --quiet?"}},
        {{"--helpp"}, {"did you mean --help?"}},
        {{"--smaplse", "4"}, {"did you mean --samples?"}}, // letters swapped twice
        {{"--teapot"}, {"\"--teapot\" is not an option of 03_test: --help lists them all"}},
        {{"-x"}, {"\"-x\" is not an option"}},
        {{"---"}, {"\"---\" is not an option"}},
    });
    CHECK_FALSE(contains(refusal({"--teapot"}), "did you mean"));
}

TEST_CASE("a word without an option is rejected") {
    check_refused({
        {{"settings.png"}, {"\"settings.png\" has no option before it"}},
        {{"--bare", "yes"}, {"\"yes\" has no option before it"}},
        {{"--width", "4", "5"}, {"\"5\" has no option before it"}},
        {{"--", "5"}, {"\"--\" is not an option"}},
        {{"-1,2,3"}, {"-1,2,3"}},
    });
}

TEST_CASE("an option without its value is rejected with the form that it takes") {
    check_refused({
        {{"--width"}, {"--width needs a value: --width N"}},
        {{"--crop"}, {"--crop needs a value: --crop X0,Y0,X1,Y1"}},
        {{"--out"}, {"--out needs a value: --out FILE"}},
        {{"--from", "--bare"}, {"--from needs a value: --from X,Y,Z"}},
        {{"--width", "--height", "7"}, {"--width needs a value"}},
    });
}

TEST_CASE("a value for an option that takes none is rejected") {
    check_refused({{{"--bare=no"}, {"--bare takes no value"}}, {{"--quiet=5"}, {"--quiet takes no value"}}});
}

TEST_CASE("an option that is given twice is rejected") {
    check_refused({
        {{"--width", "4", "--width", "5"}, {"--width is given twice"}},
        {{"--ior", "1.2", "--ior=1.3"}, {"--ior is given twice"}},
        {{"--bare", "--bare"}, {"--bare is given twice"}},
        {{"--out", "a", "--quiet", "--out", "a"}, {"--out is given twice"}},
    });
}

TEST_CASE("an unknown choice is rejected with the list of valid choices") {
    check_refused({
        {{"--view", "wire"}, {"--view \"wire\" is not a choice", "one of light, normal, depth"}},
        {{"--view", "dpeth"}, {"did you mean depth?", "one of light, normal, depth"}},
        {{"--view", "2"}, {"--view \"2\"", "one of light, normal, depth"}},
        {{"--view", ""}, {"--view \"\"", "one of light, normal, depth"}},
    });
}

TEST_CASE("an input file must exist and be a file; an output file must have a name") {
    check_refused({
        {{"--mesh", "no/such.obj"}, {"--mesh: File does not exist: no/such.obj"}},
        {{"--mesh", "/"}, {"--mesh: File is actually a directory: /"}},
        {{"--mesh", ""}, {"--mesh: File does not exist: "}},
        {{"--out", ""}, {"--out: the name of the file is empty"}},
        {{"--variance", ""}, {"--variance: the name of the file is empty"}},
    });
}

TEST_CASE("a picture that exceeds memory or the file formats is rejected") {
    check_refused({
        {{"--width", "65536", "--height", "65536"}, {"65536 x 65536", "--crop"}},
        {{"--width", "16385", "--height", "1"}, {"16385 x 1", "--width", "--crop"}},
        {{"--width", "16384", "--height", "16384"}, {"16384 x 16384", "--crop"}},
    });
    Program part; // a crop of a picture that is too large as a whole
    CHECK(part.parse({"--width", "65536", "--height", "65536", "--crop", "65000,65000,65536,65536"}));
}

TEST_CASE("help begins with the name and the question and explains every option with range and default") {
    const std::string help = help_text({"--help"});
    CHECK(help.rfind("03_test: What is asked here?\n", 0) == 0);
    std::string flat; // lines are wrapped, so a searched text may be split
    for (const char c : help)
        if (c != ' ' && c != '\n') flat += c;
    for (const char* const expected :
         {"--iorXindexofrefraction[1to2.5;default1.5]", "--depthNmostbouncesofapath[1to20;default5]",
          "--fromX,Y,Zwherethecamerastands,metres[threenumbers;default0,1.25,-4]", "--barethemodelalone",
          "--meshFILEanOBJtorender[defaultnone]",
          "--viewNAMEwhatarayshows[oneoflight,normal,depth;defaultnormal]", "[1to65536;default640]",
          "[1to65536;default400]", "--samplesNsamplesperpixel[1to1048576;default1]", "[0to1024;default0]",
          "[0to18446744073709551615;default1]", "--cropX0,Y0,X1,Y1", "default03_test", "--varianceFILE",
          "--quiet", "--help"}) {
        CAPTURE(std::string(expected));
        CHECK(contains(flat, expected));
    }
}

TEST_CASE("help fits into 80 columns and works even if other options are wrong") {
    std::istringstream lines(help_text({"--help", "--ior", "99", "--nonsense"}));
    std::string line;
    std::size_t longest = 0;
    while (std::getline(lines, line)) longest = std::max(longest, line.size());
    CHECK(longest <= 80);
    CHECK(longest > 60);
    CHECK(help_text({"-h"}).size() > 500);
}

TEST_CASE("an invalid declaration of an option is a logic error that is reported immediately") {
    Program program;
    CHECK_THROWS_AS(program.options.option("ior", 1.5f, 1.0f, 2.0f, "again"), std::logic_error);
    CHECK_THROWS_AS(program.options.option("width", 3, 1, 9, "a standard flag's name"), std::logic_error);
    CHECK_THROWS_AS(program.options.option("hot", 9.0f, 1.0f, 2.0f, "default out of range"),
                    std::logic_error);
    CHECK_THROWS_AS(program.options.option("cold", 0, 1, 2, "default out of range"), std::logic_error);
}
