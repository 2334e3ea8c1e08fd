// Fuzz targets for the project's own files: the catalogue, and the inputs of tutor and weaver.
#include "tests/fuzz/fuzz.h"
#include "tools/tutor/catalogue.h"
#include "tools/tutor/build.h"
#include "tools/tutor/diagnosis.h"
#include "tools/tutor/exercises.h"
#include "tools/tutor/hints.h"
#include "tools/weave/region.h"
#include "tools/weave/weave.h"

#include <algorithm>
#include <filesystem>

namespace rt::fuzz {

using namespace tutor;

namespace {

void check_results(const std::string& text) {
    const std::vector<CheckResult> results = parse_results(text);
    const Signature seen = signature_of("seen", results);
    const Diagnosis diagnosis = diagnose({seen}, {results});
    require(seen.assertions.empty() || diagnosis.confidence == Confidence::certain,
            "a mistake is diagnosed as itself");
    const auto known = parse_signatures(signatures_text("03_mirror", {seen}), "x.signatures");
    require(known.size() == 1 && known[0].assertions.size() == seen.assertions.size(),
            "signatures are read back");
}

void check_exercises(const std::string& text) {
    const std::vector<Exercise> exercises = find_exercises(text, "steps/03_mirror/mirror.h");
    const std::string stub = make_stub(text, exercises);
    without_markers(text);
    for (const Exercise& exercise : exercises) {
        const int place = line_of(exercise, stub);
        require(place >= 1, "lines count from 1");
        is_untouched(exercise, text, stub);
    }
}

void check_page(const std::string& page) {
    const std::vector<std::string> lines = lines_of(page);
    for (const weave::Block& block : weave::find_blocks(lines, "docs/x.md"))
        require(block.begin <= block.end && block.end <= lines.size(), "a block is inside its page");
    const auto as_it_is = [](const weave::Block&, const std::string& now) { return now; };
    const std::string once = weave::weave_page(page, "docs/x.md", as_it_is);
    require(weave::weave_page(once, "docs/x.md", as_it_is) == once, "weaving a page twice changes nothing");
    weave::fence(page);
}

} // namespace

/// The input is the catalogue's text and, after a line %%, the header to which its changes are applied.
void run_catalogue(std::string_view bytes) {
    const std::size_t mark = std::min(bytes.find("\n%%\n"), bytes.size());
    const std::string text(bytes.substr(0, mark));
    const std::string header(bytes.substr(std::min(mark + 4, bytes.size())));
    std::vector<Mistake> mistakes;
    refusal([&] { mistakes = parse_catalogue(text, "exercises/03_mirror/mistakes.md"); });
    for (const Mistake& mistake : mistakes) refusal([&] { with_patch(mistake, header); });
}

/// The first letter selects the parser; the lines after the first are its input.
void run_tutor(std::string_view bytes) {
    const auto [first, text] = first_line(bytes);
    refusal([&, &what = first, &read = text] {
        switch (what.empty() ? ' ' : what[0]) {
        case 'r': return check_results(read);
        case 'h': return void(parse_hints(read, "exercises/03_mirror/hints.md"));
        case 's': return void(parse_signatures(read, "exercises/03_mirror/signatures.txt"));
        case 'e': return check_exercises(read);
        case 'c': return void(first_error(read, "workshop/"));
        case 'n': return require(round_numbers(read).size() <= 100, "values are short");
        }
    });
}

/// Like run_tutor(); for a region, its name follows the letter.
void run_weave(std::string_view bytes) {
    static const bool has_pages = std::filesystem::create_directories(folder() + "/docs");
    require(has_pages, "the new folder is empty");
    const auto [first, text] = first_line(bytes);
    refusal([&, &what = first, &read = text] {
        switch (what.empty() ? ' ' : what[0]) {
        case 'r': return void(weave::region(read, what.substr(1), "x.h"));
        case 'c': return void(weave::find_commands(lines_of(read)));
        case 'l': return void(weave::dead_links(folder(), read, "docs/x.md"));
        case 'p': return check_page(read);
        }
    });
}

} // namespace rt::fuzz
