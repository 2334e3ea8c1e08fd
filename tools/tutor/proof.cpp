// Compiles, links and runs checks with changed headers, and caches the results.
#include "tools/tutor/proof.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/workshop.h"
#include "tools/tutor/build.h"
#include "tools/tutor/exercises.h"
#include "tools/tutor/catalogue.h"
#include "tools/tutor/record.h"
#include "tools/tutor/util.h"
#include "tools/tutor/system.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <set>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

/// Returns the optimisation level with the lowest total time, as measured. The checks of the early steps are
/// fast even without optimisation.
std::string optimisation(const std::string& step) {
    return step < "05" || step.starts_with("06") ? "-O0" : "-O1";
}

const std::string program_level = "-O1"; // of programs that render

/// Returns the limits for a program that runs checks or renders.
ProcessOptions limited(const fs::path& log) {
    return {.log = log, .cpu_seconds = 30, .seconds = 300, .memory = std::uint64_t(4) << 30};
}

/// Returns the text that an include finds: from the change, the reference, or the project.
std::string text_of(const Toolchain& tools, const Change& change, const std::string& name) {
    if (const auto found = change.headers.find(name); found != change.headers.end()) return found->second;
    std::error_code ignored; // a name that is too long does not exist
    for (const fs::path& folder : {tools.root / "steps", tools.root})
        if (fs::exists(folder / name, ignored)) return read_file((folder / name).string());
    return "";
}

/// The files that a source file depends on, and a hash of their contents.
struct Dependencies {
    std::set<std::string> names;
    Hash hash;
};

/// Adds a file and everything that it includes.
void add_file(const Toolchain& tools, const Change& change, const std::string& name, Dependencies& all) {
    if (name.empty() || !all.names.insert(name).second) return;
    const std::string text = text_of(tools, change, name), begin = "#include \"";
    all.hash.add(name);
    all.hash.add(code_only(text));
    for (const std::string& line : lines_of(text))
        if (line.starts_with(begin))
            add_file(tools, change, line.substr(begin.size(), line.find('"', begin.size()) - begin.size()),
                     all);
}

std::string step_of(const std::string& source) {
    return fs::path(source).parent_path().filename().string();
}

Dependencies dependencies(const Toolchain& tools, const Change& change, const std::string& source) {
    Dependencies all;
    all.hash.add(tools.fingerprint);
    all.hash.add(optimisation(step_of(source)));
    add_file(tools, change, source, all);
    return all;
}

/// Returns "tests/03_mirror/mirror.cpp" and the other checks of the step; those of the changed
/// headers come first.
Words check_sources(const Toolchain& tools, const Change& change) {
    Words sources;
    for (const std::string& file : check_files(tools.root, change.step))
        sources.push_back(check_source(change.step, file));
    std::stable_partition(sources.begin(), sources.end(), [&](const std::string& source) {
        const std::string file = fs::path(source).stem().string();
        return std::ranges::any_of(change.headers, [&](const auto& header) {
            const std::string own = fs::path(header.first).stem().string();
            return file == own || file.starts_with(own + "_"); // such as bvh_in_scenes
        });
    });
    return sources;
}

/// Runs the compiler with the changed headers first on the include path. Returns its first error as one
/// line, or "".
std::string compile(const Toolchain& tools, const fs::path& overlay, const Words& arguments) {
    Words command{tools.compiler, "-w", "-I" + overlay.string(), "-I" + (tools.root / "steps").string()};
    append(command, tools.flags);
    append(command, arguments);
    const fs::path log = overlay / "compiler.log";
    if (run_process(command, {.log = log}).code == 0) return "";
    const auto error = first_error(read_file(log.string()), "");
    return error ? error->file + ":" + std::to_string(error->line) + ": " + error->message
                 : "the compiler failed without an error message";
}

fs::path prefix_of(const Toolchain& tools, const std::string& header, const std::string& level) {
    return tools.work / fs::path(header).parent_path() / level / "pch.h";
}

/// Compiles a source file into an object file, using a precompiled header.
std::string compile_object(const Toolchain& tools, const fs::path& overlay, const fs::path& source,
                           const fs::path& prefix, const fs::path& object) {
    return compile(tools, overlay,
                   {prefix.parent_path().filename().string(), "-include", prefix.string(), "-c",
                    source.string(), "-o", object.string()});
}

/// Compiles and links a source of checks (tests/...) or a program (steps/...) with the change, as
/// `folder`/program. Returns the compiler's complaint, or "".
std::string build_program(const Toolchain& tools, const Change& change, const std::string& source,
                          const fs::path& folder) {
    for (const auto& [name, text] : change.headers) {
        fs::create_directories((folder / name).parent_path());
        write_file((folder / name).string(), text);
    }
    const fs::path object = folder / "main.o";
    const bool is_check = source.starts_with("tests/");
    Words link{object.string()};
    const fs::path prefix = is_check ? prefix_of(tools, "tests/pch.h", optimisation(step_of(source)))
                                     : prefix_of(tools, "common/pch.h", program_level);
    if (const auto complaint = compile_object(tools, folder, tools.root / source, prefix, object);
        !complaint.empty())
        return complaint;
    if (is_check) link.push_back(tools.test_main);
    append(link, tools.libraries);
    append(link, {"-pthread", "-o", (folder / "program").string()});
    return compile(tools, folder, link);
}

Outcome outcome_from(const std::string& kept) {
    Outcome outcome;
    outcome.timed_out = kept.starts_with("too long");
    outcome.results = parse_results(kept);
    return outcome;
}

/// Runs one file of checks, or returns the cached outcome.
Outcome run_source(const Toolchain& tools, const Change& change, const std::string& source) {
    const fs::path kept = tools.work / "cache" / (dependencies(tools, change, source).hash.text() + ".lines");
    if (fs::exists(kept)) return outcome_from(read_file(kept.string()));
    const TemporaryFolder scratch(tools.work);
    const std::string complaint = build_program(tools, change, source, scratch.path);
    if (!complaint.empty())
        return {.compiled = false, .timed_out = false, .complaint = complaint, .results = {}};
    const fs::path log = scratch.path / "checks.log";
    const bool timed_out =
        run_process({(scratch.path / "program").string(), "--reporters=lines"}, limited(log)).timed_out;
    const std::string lines = (timed_out ? "too long\n" : "ended\n") + read_file(log.string());
    write_file(kept.string(), lines);
    return outcome_from(lines);
}

/// Precompiles the header that most files include.
void precompile(const Toolchain& tools, const std::string& header, const std::string& level) {
    const fs::path prefix = prefix_of(tools, header, level), made = prefix.string() + ".gch",
                   stamp = prefix.parent_path() / "prefix.key";
    Dependencies all;
    all.hash.add(tools.fingerprint);
    add_file(tools, {}, header, all);
    if (fs::exists(made) && fs::exists(stamp) && read_file(stamp.string()) == all.hash.text()) return;
    fs::create_directories(prefix.parent_path());
    write_file(prefix.string(), read_file((tools.root / header).string()));
    const TemporaryFolder scratch(tools.work);
    const auto complaint =
        compile(tools, scratch.path, {level, "-x", "c++-header", prefix.string(), "-o", made.string()});
    if (!complaint.empty()) throw Error(header + " does not compile: " + complaint);
    write_file(stamp.string(), all.hash.text());
}

} // namespace

Toolchain read_toolchain(const fs::path& root, const fs::path& build) {
    Toolchain tools{.root = root,
                    .work = root / "build" / "prove",
                    .compiler = {},
                    .flags = {},
                    .test_main = {},
                    .libraries = {},
                    .fingerprint = {}};
    const fs::path path = build / "prove" / "toolchain.txt";
    if (!fs::exists(path))
        throw Error(path.string() + " does not exist; configure the build first (./learn test 03)");
    Hash hash;
    for (const std::string& line : lines_of(read_file(path.string()))) {
        const std::size_t space = line.find(' ');
        if (space == std::string::npos) continue;
        const std::string key = line.substr(0, space), value = line.substr(space + 1);
        if (key == "compiler") tools.compiler = value;
        if (key == "flag") tools.flags.push_back(value);
        if (key == "test_main") tools.test_main = value;
        if (key == "library") tools.libraries.push_back(value);
        hash.add(line);
    }
    Words objects = tools.libraries;
    objects.push_back(tools.test_main);
    for (const std::string& object : objects)
        if (!fs::exists(object)) throw Error(object + " is not built; ./learn prove builds it");
    hash.add(read_file((root / "tests/main.cpp").string()));
    tools.fingerprint = hash.text();
    fs::create_directories(tools.work / "cache");
    return tools;
}

std::string proof_key(const Toolchain& tools, const std::string& step) {
    Dependencies all;
    for (const std::string& source : check_sources(tools, Change{.step = step}))
        add_file(tools, {}, source, all);
    for (const Mistake& mistake : read_catalogue(tools.root, step)) {
        all.hash.add(mistake.id);
        all.hash.add(mistake.file);
        for (const PatchLine& line : mistake.patch) all.hash.add(line.kind + code_only(line.text));
    }
    return all.hash.text();
}

void precompile_headers(const Toolchain& tools, const std::string& step) {
    const BuildLock alone(tools.work);
    precompile(tools, "tests/pch.h", optimisation(step));
    precompile(tools, "common/pch.h", program_level);
}

Outcome run_checks(const Toolchain& tools, const Change& change) {
    Outcome outcome;
    for (const std::string& source : check_sources(tools, change)) {
        Outcome of_source = run_source(tools, change, source);
        const bool fails = std::ranges::any_of(of_source.results, has_failed);
        if (!of_source.compiled || of_source.timed_out || fails) return of_source;
        std::ranges::move(of_source.results, std::back_inserter(outcome.results));
    }
    return outcome;
}

bool render_picture(const Toolchain& tools, const Change& change, const fs::path& picture) {
    const std::string source = "steps/" + change.step + "/main.cpp";
    const fs::path stamp = fs::path(picture).replace_extension(".key");
    const std::string key = dependencies(tools, change, source).hash.text();
    if (fs::exists(stamp) && read_file(stamp.string()) == key) return fs::exists(picture);
    const TemporaryFolder scratch(tools.work);
    const std::string complaint = build_program(tools, change, source, scratch.path);
    if (!complaint.empty()) throw Error(change.step + " does not compile: " + complaint);
    fs::create_directories(picture.parent_path());
    fs::remove(picture);
    Words render{(scratch.path / "program").string(), "--quiet", "--threads", "1", "--out", picture.string()};
    append(render, gallery_flags(tools.root, change.step));
    run_process(render, limited(scratch.path / "log"));
    write_file(stamp.string(), key);
    return fs::exists(picture);
}

} // namespace rt::tutor
