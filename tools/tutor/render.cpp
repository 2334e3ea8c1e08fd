// ./learn run, references and figures: renders steps and compares them, or renders references and figures.
#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/build.h"
#include "tools/tutor/check_parts.h"
#include "tools/tutor/commands.h"
#include "tools/tutor/gaps.h"
#include "tools/tutor/system.h"
#include "tools/tutor/util.h"

#include <iostream>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

/// Returns the flags of a reference; most use the program's defaults. A noisy step gets more samples
/// and another seed, so that the reference is less noisy than the pictures compared with it, and
/// independent of them.
Words reference_flags(const std::string& step) {
    if (step.starts_with("07_")) return {"--samples", "256", "--seed", "2"};
    if (step.starts_with("08_")) return {"--samples", "1024", "--seed", "2"};
    return {};
}

/// Returns the flags of the picture that is compared with the reference: the defaults, unless they
/// are too slow.
Words test_flags(const std::string& step) {
    return step.starts_with("08_") ? Words{"--samples", "16"} : Words{};
}

/// Returns the command that renders a step's picture, and for noisy steps also the variance.
Words render_command(const Preset& preset, const std::string& step, const fs::path& folder) {
    const std::string out = text_of(folder / step);
    Words command{text_of(preset.program(step)), "--out", out};
    if (!reference_flags(step).empty()) append(command, {"--variance", out + ".variance.hdr"});
    return command;
}

/// A row of the table of ./learn run.
struct Row {
    std::string step, verdict, remark, log;
};

/// Compares renders/STEP.hdr with the reference.
void compare(const Project& project, Row& row) {
    std::error_code ignored;
    row.verdict = "no reference";
    if (!fs::exists(project.root / "assets/reference" / (row.step + ".hdr"), ignored)) return;
    try {
        const compare::Comparison comparison = compare_render({.root = project.root,
                                                               .step = row.step,
                                                               .program = {},
                                                               .references = reference_folder(project.root),
                                                               .out = project.root / "renders"});
        row.verdict = compare::is_same(comparison.verdict) ? "matches" : "DIFFERS";
        row.remark = joined(comparison.lines, "\n    ");
    } catch (const Error& error) {
        row.verdict = "ERROR";
        row.remark = error.what();
    }
}

/// Returns the flags to render with the learner's own tree, and says so; nothing if the user chooses one.
Words tree_flags(const Project& project, const std::string& step, const Words& given) {
    const Words own = own_tree_flags(project, step, given);
    if (!own.empty()) std::cout << step << " renders with your bvh.h (--accel wide is faster)" << std::endl;
    return own;
}

void print_head() {
    std::cout << cell("step", -16) << cell("seconds", 8) << cell("Mrays/s", 12) << "  "
              << cell("verdict", -14) << "picture\n";
}

/// Prints a row. Returns false if the picture differs or an error occurred.
bool print_row(const Project& project, const Row& row) {
    const Words time = words_in(line_after(row.log, "time "));
    const auto word = [&](std::size_t i) { return i < time.size() ? time[i] : "-"; };
    std::cout << cell(row.step, -16) << cell(word(0), 8) << cell(word(4), 12) << "  "
              << cell(row.verdict, -14) << display_path(project.root / "renders" / (row.step + ".png"))
              << std::endl;
    const bool well = row.verdict != "DIFFERS" && row.verdict != "ERROR";
    if (!well) std::cout << "    " << printable_lines(row.remark) << std::endl;
    return well;
}

/// Runs a command and returns its exit code. Throws Stop if a signal ended it.
int run_unless_stopped(const Words& command, const ProcessOptions& options) {
    const int code = run_process(command, options).code;
    if (code == 129 || code == 130 || code == 143) throw Stop{code};
    return code;
}

void make_contact_sheet(const Preset& preset, const fs::path& sheet, const Words& pictures) {
    Words command{text_of(preset.program("contact_sheet")), text_of(sheet)};
    append(command, pictures);
    std::string output;
    if (run_process(command, {.output = &output}).code != 0)
        throw CommandFailed("the contact sheet could not be created");
}

int run_all(const Project& project, const Preset& preset) {
    bool well = true;
    Words pictures;
    print_head();
    for (const std::string& step : all_steps(project)) {
        Row row{step, "ERROR", "", ""};
        wait_for_program(preset.program(step));
        Words command = render_command(preset, step, project.root / "renders");
        append(command, tree_flags(project, step, {}));
        const int code = run_unless_stopped(command, {.output = &row.log});
        if (code == 0) {
            compare(project, row);
            pictures.push_back(text_of(project.root / "renders" / (step + ".png")));
        } else {
            row.remark = "the program failed with exit code " + std::to_string(code);
        }
        well = print_row(project, row) && well;
    }
    if (!pictures.empty()) {
        const fs::path sheet = project.root / "renders/contact_sheet.png";
        make_contact_sheet(preset, sheet, pictures);
        std::cout << "contact sheet: " << display_path(sheet) << "\n";
    }
    return well ? 0 : 1;
}

/// What a step's flags do: `change`: they may change the picture (all but --threads and --quiet);
/// `name_file`: they set the output file; `help`: they request help.
struct FlagKinds {
    bool change = false, name_file = false, help = false;
};

FlagKinds kinds_of(const Words& flags) {
    FlagKinds kinds;
    for (std::size_t i = 0; i < flags.size(); ++i) {
        const std::string& flag = flags[i];
        if (flag == "--threads")
            ++i;
        else if (flag == "-h" || flag == "--help")
            kinds.help = true;
        else if (flag != "--quiet" && !flag.starts_with("--threads="))
            kinds.change = true;
        if (flag == "--out" || flag.starts_with("--out=")) kinds.name_file = true;
    }
    return kinds;
}

int run_one(const Project& project, const Preset& preset, const std::string& step, const Words& flags) {
    const FlagKinds kinds = kinds_of(flags);
    const std::string program = text_of(preset.program(step));
    wait_for_program(path_of(program));
    if (kinds.help) replace_process({program, "--help"});
    Words command = kinds.name_file ? Words{program} : render_command(preset, step, project.root / "renders");
    append(command, flags);
    append(command, tree_flags(project, step, flags));
    Row row{step, "own settings", "", ""}; // with changed settings there is no reference to compare with
    const int code = run_unless_stopped(command, {.output = &row.log, .echo = true});
    if (code == 2) return 2; // the program has printed the error
    if (code != 0) throw CommandFailed(step + " failed with exit code " + std::to_string(code));
    if (kinds.name_file) return 0; // the program has printed the path
    if (!kinds.change) compare(project, row);
    print_head();
    return print_row(project, row) ? 0 : 1;
}

/// Returns the text of assets/reference/NN_name.txt: how the reference was rendered.
std::string facts(const Preset& preset, const std::string& step, const std::string& log) {
    const std::string cache = read_file(text_of(preset.folder() / "CMakeCache.txt"));
    std::string compiler = line_after(cache, "CMAKE_CXX_COMPILER:");
    compiler.erase(0, compiler.find('=') + 1);
    std::string version, system;
    run_process({compiler, "--version"}, {.output = &version});
    run_process({"uname", "-sm"}, {.output = &system});
    // 640 x 400, 16 samples a pixel, seed 1, ...
    const Words words = words_in(log.substr(0, log.find('\n')));
    if (words.size() < 9) throw CommandFailed(step + " did not print its settings");
    const auto labelled = [](const std::string& label, const Words& flags) {
        return label + ":" + (flags.empty() ? "" : " ") + joined(flags, " ") + "\n";
    };
    return "# How the reference pictures of " + step +
           " were made. Written by ./learn references, read by cmake/reference.cmake.\nprogram: " + step +
           "\n" + labelled("flags", reference_flags(step)) + labelled("test flags", test_flags(step)) +
           "width: " + words[0] + "\nheight: " + std::to_string(std::atoi(words[2].c_str())) +
           "\nsamples: " + words[3] + "\nseed: " + std::to_string(std::atoi(words[8].c_str())) +
           "\nmade by: " + version.substr(0, version.find('\n')) + ", " + system;
}

void make_reference(const Preset& preset, const std::string& step, const fs::path& folder) {
    Words command = render_command(preset, step, folder);
    append(command, reference_flags(step));
    std::string log;
    if (run_unless_stopped(command, {.output = &log}) != 0)
        throw CommandFailed(step + " could not be rendered");
    write_file(text_of(folder / (step + ".txt")), facts(preset, step, log));
    for (const fs::path& file : entries_of(folder)) {
        write_file(text_of(preset.root / "assets/reference" / file.filename()), read_file(text_of(file)));
        fs::remove(file);
    }
    std::cout << step << ": " << line_after(log, "time ") << std::endl;
}

} // namespace

namespace {

/// Takes --scene NAME out of the flags and returns the name, unless it is one of the program's own scenes; then, and
/// without --scene, nothing.
std::string take_scene(const Project& project, const std::string& step, Words& flags) {
    const std::string begin = "--scene=";
    const auto option = std::ranges::find_if(
        flags, [&](const std::string& flag) { return flag == "--scene" || flag.starts_with(begin); });
    const bool joined = option != flags.end() && option->starts_with(begin);
    if (option == flags.end() || (!joined && option + 1 == flags.end())) return "";
    const std::string name = joined ? option->substr(begin.size()) : option[1];
    const bool has_others = step.starts_with("08_");
    if (has_others && !has_scene(project, name)) return "";
    flags.erase(option, option + (joined ? 1 : 2));
    return name;
}

} // namespace

int run_steps(const Project& project, const std::string& step, const Words& given) {
    Words flags = given;
    if (const std::string scene = take_scene(project, step, flags); !scene.empty())
        return run_scene(project, step, scene, flags);
    const Preset preset{project.root};
    make_folder(project.root / "renders");
    make(preset, {step.empty() ? "programs" : step});
    return step.empty() ? run_all(project, preset) : run_one(project, preset, step, flags);
}

void make_references(const Project& project, const std::string& step) {
    const Preset preset{project.root};
    make(preset, {"programs"});
    const fs::path references = project.root / "assets/reference";
    make_folder(references);
    const TemporaryFolder folder(preset.folder());
    for (const std::string& each : step.empty() ? all_steps(project) : Words{step})
        make_reference(preset, each, folder.path);
    Words pictures;
    for (const std::string& each : all_steps(project))
        if (fs::exists(references / (each + ".png")))
            pictures.push_back(text_of(references / (each + ".png")));
    make_folder(project.root / "docs");
    make_contact_sheet(preset, project.root / "docs/contact_sheet.png", pictures);
    std::cout << "written into " << display_path(references)
              << "; look at every one of them before you commit\n";
}

void make_figures(const Project& project, const Words& steps) {
    const Preset preset{project.root};
    make(preset, {"programs"});
    set_environment("ROOT", text_of(project.root));
    set_environment("BUILD", text_of(preset.folder()));
    for (const std::string& step : all_steps(project)) {
        const fs::path script = project.root / "tools/figures" / (step + ".sh");
        if ((!steps.empty() && !contains(steps, step)) || !fs::exists(script)) continue;
        if (run_process({"bash", text_of(script)}).code != 0)
            throw CommandFailed("the figures of " + step + " could not be created");
    }
}

} // namespace rt::tutor
