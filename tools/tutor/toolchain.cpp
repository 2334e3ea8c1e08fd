// Runs the compiler directly: no build system stands between a saved file and the result of its checks.
#include "tools/tutor/toolchain.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/build.h"
#include "tools/tutor/check_parts.h"
#include "tools/tutor/record.h"
#include "tools/tutor/system.h"
#include "tools/tutor/util.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

/// Returns the optimisation level with the lowest total time, as measured. The checks of the early steps are
/// fast even without optimisation.
std::string check_level(const std::string& step) {
    return step < "05" || step.starts_with("06") ? "-O0" : "-O1";
}

/// -O2 takes 1.5 s longer to compile a program of 05 to 08, and saves .1 s of a preview. The bits are the same.
const std::string program_level = "-O1";

/// Returns the text that an include finds: from the change, the reference, or the project.
std::string included_text(const Toolchain& tools, const Change& change, const std::string& name) {
    if (const auto found = change.headers.find(name); found != change.headers.end()) return found->second;
    std::error_code ignored; // a name that is too long does not exist
    for (const fs::path& folder : {tools.root / "steps", tools.root})
        if (fs::is_regular_file(folder / name, ignored)) return read_file(text_of(folder / name));
    return "";
}

/// Adds the file and everything that it includes.
void add_file(const Toolchain& tools, const Change& change, const std::string& name,
              std::set<std::string>& names, Hash& hash) {
    if (name.empty() || !names.insert(name).second) return;
    const std::string text = included_text(tools, change, name), begin = "#include \"";
    hash.add(name);
    hash.add(code_only(text));
    for (const std::string& line : lines_of(text))
        if (const std::string code = trimmed(line); code.starts_with(begin))
            add_file(tools, change, code.substr(begin.size(), code.find('"', begin.size()) - begin.size()),
                     names, hash);
}

std::string step_of(const std::string& source) {
    return text_of(path_of(source).parent_path().filename());
}

bool has_meshes(const std::string& step) {
    return step >= "05";
}

/// Warnings that are mistakes in a learner's file. Clang ignores those that it does not know.
const Words learner_flags{"-Werror=return-type",         "-Werror=uninitialized",
                          "-Werror=maybe-uninitialized", "-Werror=parentheses",
                          "-Werror=dangling-pointer",    "-Werror=return-local-addr",
                          "-Wno-unknown-warning-option"};

/// Runs the compiler with the changed headers first on the include path.
Outcome compile(const Toolchain& tools, const fs::path& overlay, const Words& arguments) {
    Words command{tools.compiler, "-I" + text_of(overlay), "-I" + text_of(tools.root / "steps")};
    append(command, tools.flags);
    append(command, tools.strictness == Strictness::proof ? Words{"-w"} : learner_flags);
    append(command, arguments);
    const fs::path log = overlay / "compiler.log";
    Outcome outcome;
    outcome.compiled = run_process(command, {.log = log}).code == 0;
    outcome.log = read_file(text_of(log));
    if (outcome.compiled) return outcome;
    const auto error = first_error(outcome.log, "workshop/");
    outcome.complaint = error ? error->file + ":" + std::to_string(error->line) + ": " + error->message
                              : "the compiler failed without an error message";
    return outcome;
}

fs::path prefix_of(const Toolchain& tools, const std::string& header, const std::string& level) {
    return tools.work / path_of(header).parent_path() / level / "pch.h";
}

/// How a source is compiled and linked.
struct BuildPlan {
    std::string source;
    Words flags; ///< further flags: the precompiled header and its level, or sanitizers
    bool is_check = false;
};

BuildPlan plan_for(const Toolchain& tools, const std::string& source) {
    const bool is_check = source.starts_with("tests/");
    const std::string level = is_check ? check_level(step_of(source)) : program_level;
    const fs::path prefix = prefix_of(tools, is_check ? "tests/pch.h" : "common/pch.h", level);
    return {source, {level, "-include", text_of(prefix)}, is_check};
}

/// Compiles and links with the change, as `folder`/program.
Outcome build_program(const Toolchain& tools, const Change& change, const BuildPlan& plan,
                      const fs::path& folder) {
    for (const auto& [name, text] : change.headers) {
        fs::create_directories((folder / name).parent_path());
        write_file(text_of(folder / name), text);
    }
    const fs::path object = folder / "main.o";
    Words arguments = plan.flags;
    append(arguments, {"-c", text_of(tools.root / plan.source), "-o", text_of(object)});
    if (Outcome compiled = compile(tools, folder, arguments); !compiled.compiled) return compiled;
    Words link = plan.flags[0].starts_with("-fsanitize") ? Words{plan.flags[0]} : Words();
    link.push_back(text_of(object));
    if (plan.is_check) link.push_back(tools.test_main);
    append(link, libraries_for(tools, step_of(plan.source)));
    append(link, {"-pthread", "-o", text_of(folder / made_program)});
    return compile(tools, folder, link);
}

/// Runs the checks for ./learn prove, which does not go on after a crash. Their output goes to `log`.
Outcome run_once(const fs::path& program, const fs::path& log) {
    const ProcessResult result =
        run_process({text_of(program), "--reporters=lines"},
                    {.log = log, .cpu_seconds = 30, .seconds = 300, .memory = std::uint64_t(4) << 30});
    Outcome outcome;
    outcome.timed_out = result.timed_out;
    outcome.results = parse_results(read_file(text_of(log)));
    return outcome;
}

/// Runs the checks for a learner, whatever crashes or hangs.
Outcome run_patiently(const fs::path& program, const fs::path& log) {
    Outcome outcome;
    outcome.results = run_all_checks(program, log);
    outcome.timed_out =
        std::ranges::find(outcome.results, CheckState::endless, &CheckResult::state) != outcome.results.end();
    return outcome;
}

/// Precompiles the header that most files include. Its "#pragma once" is a warning in a file that is compiled itself.
void precompile(const Toolchain& tools, const std::string& header, const std::string& level) {
    const fs::path prefix = prefix_of(tools, header, level), made = path_of(text_of(prefix) + ".gch"),
                   stamp = prefix.parent_path() / "prefix.key";
    const std::string key = dependency_key(tools, {}, header);
    if (fs::exists(made) && fs::exists(stamp) && read_file(text_of(stamp)) == key) return;
    fs::create_directories(prefix.parent_path());
    write_file(text_of(prefix), read_file(text_of(tools.root / header)));
    const TemporaryFolder scratch(tools.work);
    const Outcome compiled = compile(
        tools, scratch.path, {level, "-Wno-error", "-x", "c++-header", text_of(prefix), "-o", text_of(made)});
    if (!compiled.compiled) throw Error(header + " does not compile: " + compiled.complaint);
    write_file(text_of(stamp), key);
}

} // namespace

Words targets_for(const std::string& step) {
    if (!has_meshes(step)) return {"test_main", "common"};
    return {"test_main", "common", "raysteps_accel", "built_assets", "models"};
}

Words libraries_for(const Toolchain& tools, const std::string& step) {
    Words libraries = has_meshes(step) ? tools.mesh_libraries : Words();
    append(libraries, tools.libraries);
    return libraries;
}

std::string program_source(const std::string& step) {
    return "steps/" + step + "/main.cpp";
}

void add_sources(const Toolchain& tools, const Words& sources, Hash& hash) {
    std::set<std::string> names;
    for (const std::string& source : sources) add_file(tools, {}, source, names, hash);
}

std::string dependency_key(const Toolchain& tools, const Change& change, const std::string& source) {
    std::set<std::string> names;
    Hash hash;
    hash.add(tools.fingerprint);
    hash.add(check_level(step_of(source)));
    add_file(tools, change, source, names, hash);
    return hash.text();
}

Words check_sources(const Toolchain& tools, const Change& change) {
    Words sources;
    for (const std::string& file : check_files(tools.root, change.step))
        sources.push_back(check_source(change.step, file));
    std::stable_partition(sources.begin(), sources.end(), [&](const std::string& source) {
        const std::string file = text_of(path_of(source).stem());
        return std::ranges::any_of(change.headers, [&](const auto& header) {
            const std::string own = text_of(path_of(header.first).stem());
            return file == own || file.starts_with(own + "_"); // such as bvh_in_scenes
        });
    });
    return sources;
}

Toolchain read_toolchain(const fs::path& root, const fs::path& build, const fs::path& work,
                         Strictness strictness) {
    Toolchain tools{.root = root,
                    .work = work,
                    .strictness = strictness,
                    .compiler = {},
                    .flags = {},
                    .test_main = {},
                    .libraries = {},
                    .mesh_libraries = {},
                    .fingerprint = {}};
    const fs::path path = build / "prove" / "toolchain.txt";
    if (!fs::exists(path))
        throw Error(text_of(path) + " does not exist; configure the build first (./learn test 03)");
    Hash hash;
    hash.add(strictness == Strictness::proof ? "proof" : "learner");
    for (const std::string& line : lines_of(read_file(text_of(path)))) {
        const std::size_t space = line.find(' ');
        if (space == std::string::npos) continue;
        const std::string key = line.substr(0, space), value = line.substr(space + 1);
        if (key == "compiler") tools.compiler = value;
        if (key == "flag") tools.flags.push_back(value);
        if (key == "test_main") tools.test_main = value;
        if (key == "library") tools.libraries.push_back(value);
        if (key == "mesh_library") tools.mesh_libraries.push_back(value);
        hash.add(line);
    }
    Words objects = tools.libraries;
    objects.push_back(tools.test_main);
    for (const std::string& object : objects)
        if (!fs::exists(path_of(object))) throw Error(object + " is not built; ./learn prove builds it");
    hash.add(read_file(text_of(root / "tests/main.cpp")));
    tools.fingerprint = hash.text();
    fs::create_directories(tools.work / "cache");
    return tools;
}

void precompile_headers(const Toolchain& tools, const std::string& step) {
    const BuildLock alone(tools.work);
    in_parallel(2, 2, [&](std::size_t i) {
        i == 0 ? precompile(tools, "common/pch.h", program_level)
               : precompile(tools, "tests/pch.h", check_level(step));
    });
}

Outcome run_source(const Toolchain& tools, const Change& change, const std::string& source) {
    const fs::path kept = tools.work / "cache" / (dependency_key(tools, change, source) + ".lines");
    if (fs::exists(kept)) {
        const std::string text = read_file(text_of(kept));
        Outcome outcome;
        outcome.timed_out = text.starts_with("too long");
        outcome.results = parse_results(text);
        return outcome;
    }
    const TemporaryFolder scratch(tools.work);
    if (Outcome built = build_program(tools, change, plan_for(tools, source), scratch.path); !built.compiled)
        return built;
    const fs::path program = scratch.path / made_program, log = scratch.path / "checks.log";
    if (tools.strictness == Strictness::learner) {
        Outcome outcome = run_patiently(program, log);
        const bool plain = std::ranges::none_of(outcome.results, [](const CheckResult& result) {
            return result.state == CheckState::unfinished || result.state == CheckState::endless;
        });
        if (plain) write_file(text_of(kept), "ended\n" + read_file(text_of(log)));
        return outcome;
    }
    Outcome outcome = run_once(program, log);
    write_file(text_of(kept), (outcome.timed_out ? "too long\n" : "ended\n") + read_file(text_of(log)));
    return outcome;
}

Outcome build_step(const Toolchain& tools, const Change& change, const fs::path& folder) {
    return build_program(tools, change, plan_for(tools, program_source(change.step)), folder);
}

namespace {

/// "radiance" of "rt::radiance(rt::Scene const&, rt::Ray const&, int)" or of "vec3 rt::radiance<rt::Scene>(...)".
std::string bare_name(std::string function) {
    function.resize(std::min(function.find('('), function.size()));
    function.resize(std::min(function.find('<'), function.size()));
    return function.substr(function.find_last_of(": ") + 1); // npos + 1 is 0
}

/// "in radiance (workshop/03_mirror/radiance.h:34)" for a line of a stack trace in one of the learner's files, such as
/// "#2 0x1f in rt::radiance(...) workshop/...:34:5"; empty for others.
std::string learners_frame(const std::string& line) {
    const std::size_t in = line.find(" in "), path = line.find("workshop/");
    if (line.find('#') > 8 || in == line.npos || path == line.npos) return "";
    const std::size_t begin = line.rfind(' ', path) + 1;
    std::string place = line.substr(path);
    if (std::ranges::count(place, ':') > 1) place.resize(place.rfind(':')); // without the column
    return "in " + bare_name(line.substr(in + 4, begin - in - 5)) + " (" + place + ")";
}

/// The first of the learner's frames.
std::string first_frame(const std::string& report) {
    for (const std::string& line : lines_of(report))
        if (const std::string frame = learners_frame(line); !frame.empty()) return frame;
    return "";
}

/// What a report of a sanitizer or of the library's assertions is about, in a learner's words.
std::string crash_cause(const std::string& report) {
    static const std::pair<const char*, const char*> causes[] = {
        {"__n < this->size()", "an index beyond the end of a std::vector or std::array"},
        {"!this->empty()", "front() or back() of an empty container"},
        {"this->_M_is_engaged()", "the value of an empty std::optional"},
        {"stack-overflow", "endless recursion: the stack is full"},
        {"heap-buffer-overflow", "memory beyond the end of an array or std::vector"},
        {"stack-buffer-overflow", "memory beyond the end of a local array"},
        {"heap-use-after-free", "memory that was already freed"},
        {"stack-use-after", "a variable that no longer exists"},
        {"division by zero", "a division of integers by zero"},
        {"null pointer", "a null pointer"},
        {"reached the end of a value-returning function",
         "a function that returns nothing although it promises to"},
        {"outside the range of representable values", "a float too large for an int, or NaN"},
        {"signed integer overflow", "an int that became too large"},
        {"out of bounds", "an index beyond the end of an array"}};
    for (const auto& [mark, cause] : causes)
        if (report.find(mark) != report.npos) return cause;
    const std::string error = line_after(report, "SUMMARY: ");
    return error.empty() ? "" : error;
}

} // namespace

std::string first_nan(const std::string& stacks) {
    bool is_open = true; // all frames of this stack so far are of libraries
    for (const std::string& line : lines_of(stacks)) {
        if (line.find("#0 ") != line.npos) is_open = true;
        const std::string frame = learners_frame(line);
        if (is_open && !frame.empty()) return frame;
        const bool is_other = line.find("steps/0") != line.npos || line.find("tests/0") != line.npos;
        if (!frame.empty() || is_other) is_open = false;
    }
    return "";
}

namespace {

/// Compiles a check or program again with sanitizers and runs it. Returns what it prints.
std::string run_sanitized(const Toolchain& tools, const Change& change, const std::string& source,
                          const Words& flags, const Words& arguments) {
    const TemporaryFolder scratch(tools.work);
    BuildPlan plan{source,
                   {"-fsanitize=address,undefined", "-O0", "-g1", "-D_GLIBCXX_ASSERTIONS",
                    "-fno-sanitize=vptr", "-fno-omit-frame-pointer"},
                   source.starts_with("tests/")};
    append(plan.flags, flags);
    if (!build_program(tools, change, plan, scratch.path).compiled) return "";
    const fs::path log = scratch.path / "checks.log";
    set_environment("ASAN_OPTIONS", "detect_leaks=0:handle_abort=1:allocator_may_return_null=1");
    set_environment("UBSAN_OPTIONS", "halt_on_error=1:print_stacktrace=1");
    Words command{text_of(scratch.path / made_program)};
    append(command, arguments);
    run_process(command, {.log = log, .cpu_seconds = 30});
    return read_file(text_of(log));
}

} // namespace

std::string explain_crash(const Toolchain& tools, const Change& change, const std::string& source) {
    const std::string report = run_sanitized(tools, change, source, {}, {"--reporters=lines"}),
                      cause = crash_cause(report), place = first_frame(report);
    if (cause.empty()) return "";
    return place.empty() ? cause : cause + ", " + place;
}

std::string explain_nan(const Toolchain& tools, const Change& change, const std::string& source,
                        const Words& arguments) {
    const fs::path trap = tools.root / "tools/tutor/nan_trap.h";
    return first_nan(run_sanitized(tools, change, source, {"-include", text_of(trap)}, arguments));
}

} // namespace rt::tutor
