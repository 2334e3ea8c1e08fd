// Is this the same picture? compare A B: exit 0 if it is, 1 if it is not, 2 if one cannot be read.
#include "common/compare/judge.h"
#include "common/error.h"
#include "common/file_bytes.h"
#include "common/image_file.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <string>

namespace {

struct Question {
    std::string test, reference, test_variance, reference_variance, known, json, map;
};

void declare(CLI::App& app, Question& question) {
    app.add_option("A", question.test, "the picture to judge, .hdr or .png")->required();
    app.add_option("B", question.reference, "the reference, .hdr or .png")->required();
    CLI::Option* const a =
        app.add_option("--variance-a", question.test_variance,
                       "variance of A's pixels (.hdr): then only what noise does not explain counts");
    CLI::Option* const b =
        app.add_option("--variance-b", question.reference_variance, "variance of B's pixels (.hdr)");
    a->needs(b);
    b->needs(a);
    app.add_option("--known", question.known, "a folder of wrong pictures: is A one of them?");
    app.add_option("--json", question.json, "where to write the verdict as JSON; - is the standard output");
    app.add_option(
        "--map", question.map,
        "where to draw the differences (.png): FLIP from black to yellow, or, with variances, red where "
        "A is too bright and blue where it is too dark");
}

/// Better before the work than after it.
void check_outputs(const Question& question) {
    if (!question.map.empty()) rt::check_writable(question.map);
    if (!question.json.empty() && question.json != "-") rt::check_file_writable(question.json);
}

rt::Judgement answer(const Question& question) {
    const rt::StoredImage test = rt::read_stored(question.test);
    const rt::StoredImage reference = rt::read_stored(question.reference);
    rt::Variances variances;
    if (!question.test_variance.empty())
        variances = {rt::read_image(question.test_variance), rt::read_image(question.reference_variance)};
    std::vector<rt::KnownPicture> known;
    if (!question.known.empty()) known = rt::read_known(question.known);
    return rt::judge(test, reference, variances, known);
}

void report(const Question& question, const rt::Judgement& judgement) {
    const std::string json = rt::to_json(judgement) + "\n";
    if (!question.map.empty()) rt::write_image(question.map, rt::error_map(judgement));
    if (question.json == "-") {
        std::cout << json;
        return;
    }
    if (!question.json.empty()) rt::write_file(question.json, json);
    for (const std::string& line : judgement.lines) std::cout << line << "\n";
}

} // namespace

int main(int argc, char** argv) {
    Question question;
    CLI::App app("Is A the same picture as the reference B? Exit code: 0 same, 1 different, 2 an error.",
                 "compare");
    declare(app, question);
    try {
        app.parse(argc, argv);
        check_outputs(question);
        const rt::Judgement judgement = answer(question);
        report(question, judgement);
        return judgement.finding == rt::Finding::same || judgement.finding == rt::Finding::noise ? 0 : 1;
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const std::exception& problem) {
        std::cerr << "compare: " << problem.what() << "\n";
        return 2;
    }
}
