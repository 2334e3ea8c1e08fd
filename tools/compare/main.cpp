// compare A B: is A the same picture as B? Exit code: 0 yes, 1 no, 2 one cannot be read.
#include "tools/compare/comparison.h"
#include "common/util/report_error.h"
#include "common/util/system.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/util/version.h"
#include "common/image/image_file.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>
#include <string>

namespace {

struct Command {
    std::string test, reference, test_variance, reference_variance, known, json, map;
    int step = 0;
};

void declare(CLI::App& app, Command& command) {
    app.add_option("A", command.test, "the picture to compare, .hdr or .png")->required();
    app.add_option("B", command.reference, "the reference, .hdr or .png")->required();
    CLI::Option* const a =
        app.add_option("--variance-a", command.test_variance,
                       "variance of A's pixels (.hdr): differences that noise explains do not count");
    CLI::Option* const b =
        app.add_option("--variance-b", command.reference_variance, "variance of B's pixels (.hdr)");
    a->needs(b);
    b->needs(a);
    app.add_option("--known", command.known, "a folder of known wrong pictures: is A one of them?");
    app.add_option("--step", command.step, "use the limits of this step")->check(CLI::Range(1, 8));
    app.add_option("--json", command.json, "write the verdict as JSON to this file; - is stdout");
    app.add_option(
        "--map", command.map,
        "write an error map to this file (.png): FLIP from black to yellow; with variances, red where A "
        "is too bright and blue where it is too dark");
}

/// Fails early if an output cannot be written.
void check_outputs(const Command& command) {
    if (!command.map.empty()) rt::check_writable(command.map);
    if (!command.json.empty() && command.json != "-") rt::check_file_writable(command.json);
}

rt::compare::Comparison run_comparison(const Command& command) {
    rt::compare::ComparisonInput input{rt::compare::read_encoded(command.test),
                                       rt::compare::read_encoded(command.reference)};
    if (!command.test_variance.empty())
        input.variances = {rt::read_image(command.test_variance), rt::read_image(command.reference_variance)};
    if (!command.known.empty()) input.catalogue = rt::compare::read_catalogue_images(command.known);
    input.step = command.step;
    return rt::compare::compare_images(input);
}

void report(const Command& command, const rt::compare::Comparison& comparison) {
    const std::string json = rt::compare::to_json(comparison) + "\n";
    if (!command.map.empty()) rt::write_image(command.map, rt::compare::error_map(comparison));
    if (!command.json.empty() && command.json != "-") rt::write_file(command.json, json);
    if (command.json == "-")
        std::cout << json;
    else
        for (const std::string& line : comparison.lines) std::cout << rt::printable(line) << "\n";
    if (!std::cout.flush()) throw rt::Error("cannot write to stdout (is the disk full?)");
}

} // namespace

int main(int argc, char** argv) {
    rt::prepare_streams();
    Command command;
    CLI::App app("Is A the same picture as the reference B? Exit code: 0 same, 1 different, 2 an error.",
                 "compare");
    app.allow_windows_style_options(false); // a path may begin with a slash
    app.set_version_flag("--version", rt::version());
    declare(app, command);
    try {
        app.parse(argc, argv);
        check_outputs(command);
        const rt::compare::Comparison comparison = run_comparison(command);
        report(command, comparison);
        return rt::compare::is_same(comparison.verdict) ? 0 : 1;
    } catch (const CLI::Success& help) {
        return app.exit(help);
    } catch (const std::exception& problem) {
        return rt::report_error("compare", problem.what());
    }
}
