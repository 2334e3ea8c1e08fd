// ./learn test and ./learn trace: runs ctest, and prints the rays of one pixel.
#include "common/util/report_error.h"
#include "common/util/cores.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/build.h"
#include "tools/tutor/commands.h"
#include "tools/tutor/system.h"
#include "tools/tutor/util.h"

#include <iostream>
#include <set>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

/// Groups of checks, and whether the group has its own build target checks_NAME.
const std::vector<std::pair<std::string, bool>> groups{
    {"common", true}, {"compare", true}, {"guards", true},      {"bench", true},   {"tutor", true},
    {"docs", true},   {"fuzz", true},    {"statistics", false}, {"faults", false}, {"reference", false}};

/// Prints why checks were skipped.
void print_skipped(const fs::path& log) {
    std::error_code ignored;
    std::set<std::string> reasons;
    if (!fs::exists(log, ignored)) return;
    for (const std::string& line : lines_of(read_file(text_of(log))))
        if (line.starts_with("skipped:") || line.find("[skipped]") != line.npos) reasons.insert(line);
    for (const std::string& reason : reasons) std::cout << printable(reason) << "\n";
}

} // namespace

int run_tests(const Project& project, const std::string& word, const std::string& junit) {
    const Preset preset{project.root};
    std::string label = word, target = "checks";
    const auto group = std::ranges::find(groups, word, &std::pair<std::string, bool>::first);
    if (!word.empty() && group == groups.end()) label = find_step(project, word);
    if (!word.empty() && (group == groups.end() || group->second)) target += "_" + label;
    if (!junit.empty()) check_file_writable(junit);
    make(preset, {target});
    Words ctest{"ctest", "--test-dir", text_of(preset.folder())};
    if (!label.empty()) append(ctest, {"-L", "^" + label + "$"});
    Words list = ctest;
    list.push_back("-N");
    std::string listed;
    run_process(list, {.output = &listed});
    if (std::atoi(line_after(listed, "Total Tests: ").c_str()) == 0)
        throw Error("there are no checks with the name '" + word + "'");
    append(ctest, {"-j", std::to_string(usable_cores()), "--no-label-summary", "--output-on-failure"});
    if (is_terminal(1)) ctest.push_back("--progress");
    if (!junit.empty()) append(ctest, {"--output-junit", text_of(fs::absolute(path_of(junit)))});
    const int code = run_process(ctest).code;
    print_skipped(preset.folder() / "Testing/Temporary/LastTest.log");
    return code == 0 ? 0 : 1;
}

void trace_pixel(const Project& project, const std::string& step, const Pixel& pixel, const Words& flags) {
    const Preset preset{project.root};
    const auto [x, y, sample] = pixel;
    make(preset, {"trace_" + step}, true);
    const std::string program = text_of(preset.program("trace_" + step));
    wait_for_program(path_of(program));
    const TemporaryFolder folder(preset.folder());
    std::ostringstream crop;
    crop << x << "," << y << "," << x + 1 << "," << y + 1;
    Words command{program, "--crop",  crop.str(), "--threads",
                  "1",     "--quiet", "--out",    text_of(folder.path / step)};
    append(command, flags);
    std::cout << step << ", pixel " << x << "," << y << ", sample " << sample << std::endl;
    set_environment("RAYSTEPS_TRACE_SAMPLE", std::to_string(sample));
    std::string output;
    if (run_process(command, {.output = &output}).code != 0)
        throw Stop{2}; // the program has printed the error
    bool found = false;
    for (const std::string& line : lines_of(output))
        if (!line.starts_with("wrote")) {
            std::cout << line << "\n";
            found = true;
        }
    if (!found) throw Error("this pixel has no sample " + std::to_string(sample));
}

} // namespace rt::tutor
