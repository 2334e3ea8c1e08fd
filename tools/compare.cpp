// Is this the same picture? compare A B: exit 0 if it is, 1 if it is not, 2 if one cannot be read.
#include "common/compare/compare.h"
#include "common/error.h"
#include "common/image_file.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <string>

namespace {

struct Question {
    std::string test, reference, test_variance, reference_variance;
};

rt::Verdict answer(const Question& question) {
    const rt::Image test = rt::read_image(question.test);
    const rt::Image reference = rt::read_image(question.reference);
    if (question.test_variance.empty()) return rt::verdict(rt::difference(test, reference));
    return rt::verdict(rt::tile_difference(test, reference, rt::read_image(question.test_variance),
                                           rt::read_image(question.reference_variance)));
}

} // namespace

int main(int argc, char** argv) {
    Question question;
    CLI::App app("Is A the same picture as the reference B? Exit code: 0 same, 1 different, 2 an error.",
                 "compare");
    app.add_option("A", question.test, "the picture to judge, .hdr or .png")->required();
    app.add_option("B", question.reference, "the reference, .hdr or .png")->required();
    CLI::Option* const a =
        app.add_option("--variance-a", question.test_variance,
                       "variance of A's pixels (.hdr): then only what noise does not explain counts");
    CLI::Option* const b =
        app.add_option("--variance-b", question.reference_variance, "variance of B's pixels (.hdr)");
    a->needs(b);
    b->needs(a);
    try {
        app.parse(argc, argv);
        const rt::Verdict verdict = answer(question);
        std::cout << verdict.words << "\n";
        return verdict.same ? 0 : 1;
    } catch (const CLI::CallForHelp& help) {
        return app.exit(help);
    } catch (const std::exception& problem) {
        std::cerr << "compare: " << problem.what() << "\n";
        return 2;
    }
}
