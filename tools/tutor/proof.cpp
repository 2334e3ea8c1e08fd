// Compiles, links and runs checks with changed headers, and keeps what came.
#include "tools/tutor/proof.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/build_lock.h"
#include "tools/tutor/check_files.h"
#include "tools/tutor/compile.h"
#include "tools/tutor/exercises.h"
#include "tools/tutor/gallery.h"
#include "tools/tutor/hash.h"
#include "tools/tutor/process.h"
#include "tools/tutor/temporary.h"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <set>

namespace rt {

namespace fs = std::filesystem;

namespace {

/// What takes least time in all, measured: the checks of the early steps are quick even if they are compiled quickly.
std::string optimisation(const std::string& step) {
    return step < "05" || step.starts_with("06") ? "-O0" : "-O1";
}

const std::string part_level = "-O1"; // of programs for pictures, too

constexpr RunLimits check_limits{.cpu_seconds = 30, .seconds = 300, .memory = std::uint64_t(4) << 30};

/// The name in #include "name", or nothing.
std::string included(const std::string& line) {
    const std::string begin = "#include \"";
    if (!line.starts_with(begin)) return "";
    return line.substr(begin.size(), line.find('"', begin.size()) - begin.size());
}

/// The text that an include finds: the change's, the reference's, or the project's.
std::string text_of(const Toolchain& tools, const Change& change, const std::string& name) {
    if (const auto found = change.headers.find(name); found != change.headers.end()) return found->second;
    std::error_code ignored; // a name that is too long is none that is there
    for (const fs::path& folder : {tools.root / "steps", tools.root})
        if (fs::exists(folder / name, ignored)) return read_file((folder / name).string());
    return "";
}

/// "05_mesh_bvh/shapes.cpp" for shapes.h, if a part of the step stands there that is compiled by itself; or nothing.
std::string part_beside(const Toolchain& tools, const std::string& header) {
    const std::string part = fs::path(header).replace_extension(".cpp").string();
    std::error_code ignored;
    return header.ends_with(".h") && fs::exists(tools.root / "steps" / part, ignored) ? part : "";
}

/// `seen` grows by the name and whatever belongs to it.
void add_with_includes(const Toolchain& tools, const Change& change, const std::string& name,
                       std::set<std::string>& seen, Hash& hash) {
    if (name.empty() || !seen.insert(name).second) return;
    const std::string text = text_of(tools, change, name);
    hash.add(name);
    hash.add(text);
    for (const std::string& line : lines_of(text))
        if (const std::string other = included(line); !other.empty())
            add_with_includes(tools, change, other, seen, hash);
    add_with_includes(tools, change, part_beside(tools, name), seen, hash);
}

/// A source of checks or of a program: a hash of all that it depends on, and the parts to link it with.
struct Source {
    std::string key;
    std::vector<std::string> parts; ///< "05_mesh_bvh/shapes.cpp"
};

Source look_at(const Toolchain& tools, const Change& change, const std::string& source) {
    Hash hash;
    std::set<std::string> seen;
    hash.add(tools.fixed);
    hash.add(optimisation(fs::path(source).parent_path().filename().string()));
    add_with_includes(tools, change, source, seen, hash);
    Source looked{hash.text(), {}};
    for (const std::string& name : seen)
        if (name != source && name.ends_with(".cpp")) looked.parts.push_back(name);
    return looked;
}

/// "tests/03_mirror/mirror.cpp" and the others of the step; those of the changed headers come first.
std::vector<std::string> check_sources(const Toolchain& tools, const Change& change) {
    std::vector<std::string> sources;
    for (const std::string& file : check_files(tools.root, change.step))
        sources.push_back(check_source(change.step, file));
    std::stable_partition(sources.begin(), sources.end(), [&](const std::string& source) {
        const std::string file = fs::path(source).stem().string();
        return std::ranges::any_of(change.headers, [&](const auto& header) {
            const std::string own = fs::path(header.first).stem().string();
            return file == own || file.starts_with(own + "_"); // as in bvh_in_scenes
        });
    });
    return sources;
}

void write_overlay(const fs::path& folder, const Change& change) {
    for (const auto& [name, text] : change.headers) {
        fs::create_directories((folder / name).parent_path());
        write_file((folder / name).string(), text);
    }
}

std::vector<std::string> compile_command(const Toolchain& tools, const fs::path& overlay) {
    std::vector<std::string> command{tools.compiler, "-w", "-I" + overlay.string(),
                                     "-I" + (tools.root / "steps").string()};
    command.insert(command.end(), tools.flags.begin(), tools.flags.end());
    return command;
}

/// The compiler's first error, on one line.
std::string complaint_in(const fs::path& log) {
    const auto error = first_error(read_file(log.string()), "");
    if (!error) return "the compiler failed and did not say why";
    return error->file + ":" + std::to_string(error->line) + ": " + error->message;
}

/// Compiles a part of a step; its object is kept, as few changes touch it. The compiler's complaint if that fails.
std::string compile_part(const Toolchain& tools, const Change& change, const std::string& part,
                         const fs::path& scratch, std::vector<std::string>& objects) {
    const fs::path kept = tools.work / "cache" / (look_at(tools, change, part).key + ".o");
    objects.push_back(kept.string());
    if (fs::exists(kept)) return "";
    const fs::path object = scratch / "part.o", log = scratch / "compiler.log";
    auto command = compile_command(tools, scratch);
    for (const std::string& word :
         {part_level, std::string("-include"), (tools.work / "common" / part_level / "pch.h").string(),
          std::string("-c"), (tools.root / "steps" / part).string(), std::string("-o"), object.string()})
        command.push_back(word);
    if (run_process(command, log).code != 0) return complaint_in(log);
    fs::rename(object, kept);
    return "";
}

/// Compiles and links one file of checks; the compiler's complaint if that fails.
std::string build_checks(const Toolchain& tools, const Change& change, const std::string& source,
                         const fs::path& scratch, const fs::path& program) {
    std::vector<std::string> objects;
    for (const std::string& part : look_at(tools, change, source).parts)
        if (const auto complaint = compile_part(tools, change, part, scratch, objects); !complaint.empty())
            return complaint;
    const std::string level = optimisation(fs::path(source).parent_path().filename().string());
    const fs::path object = scratch / "checks.o", log = scratch / "compiler.log";
    auto compile = compile_command(tools, scratch);
    for (const std::string& word :
         {level, std::string("-include"), (tools.work / "tests" / level / "pch.h").string(),
          std::string("-c"), (tools.root / source).string(), std::string("-o"), object.string()})
        compile.push_back(word);
    if (run_process(compile, log).code != 0) return complaint_in(log);
    auto link = compile_command(tools, scratch);
    link.push_back(object.string());
    std::ranges::copy(objects, std::back_inserter(link));
    link.push_back(tools.test_main);
    std::ranges::copy(tools.libraries, std::back_inserter(link));
    for (const std::string& word : {std::string("-pthread"), std::string("-o"), program.string()})
        link.push_back(word);
    return run_process(link, log).code != 0 ? complaint_in(log) : "";
}

Outcome outcome_from(const std::string& kept) {
    Outcome outcome;
    outcome.too_long = kept.starts_with("too long");
    outcome.results = parse_results(kept);
    return outcome;
}

/// One file of checks. What came is kept.
Outcome run_source(const Toolchain& tools, const Change& change, const std::string& source) {
    const fs::path kept = tools.work / "cache" / (look_at(tools, change, source).key + ".lines");
    if (fs::exists(kept)) return outcome_from(read_file(kept.string()));
    const TemporaryFolder scratch(tools.work);
    write_overlay(scratch.path, change);
    const fs::path program = scratch.path / "checks", log = scratch.path / "checks.log";
    if (const std::string complaint = build_checks(tools, change, source, scratch.path, program);
        !complaint.empty())
        return {.compiled = false, .too_long = false, .complaint = complaint, .results = {}};
    const Ended ended = run_process({program.string(), "--reporters=lines"}, log, check_limits);
    const std::string lines = (ended.too_long ? "too long\n" : "ended\n") + read_file(log.string());
    write_file(kept.string(), lines);
    return outcome_from(lines);
}

/// What most files include, compiled once.
void parse_ahead(const Toolchain& tools, const std::string& header, const std::string& level) {
    const fs::path folder = tools.work / fs::path(header).parent_path() / level;
    const fs::path prefix = folder / "pch.h", made = folder / "pch.h.gch", stamp = folder / "prefix.key";
    Hash hash;
    std::set<std::string> seen;
    hash.add(tools.fixed);
    add_with_includes(tools, {}, header, seen, hash);
    if (fs::exists(made) && fs::exists(stamp) && read_file(stamp.string()) == hash.text()) return;
    fs::create_directories(folder);
    write_file(prefix.string(), read_file((tools.root / header).string()));
    auto command = compile_command(tools, tools.work);
    for (const std::string& word : {level, std::string("-x"), std::string("c++-header"), prefix.string(),
                                    std::string("-o"), made.string()})
        command.push_back(word);
    const fs::path log = folder / "prefix.log";
    if (run_process(command, log).code != 0) throw Error(header + " does not compile: " + complaint_in(log));
    write_file(stamp.string(), hash.text());
}

} // namespace

Toolchain read_toolchain(const fs::path& root, const fs::path& build) {
    Toolchain tools{.root = root,
                    .work = root / "build" / "prove",
                    .compiler = {},
                    .flags = {},
                    .test_main = {},
                    .libraries = {},
                    .fixed = {}};
    const fs::path path = build / "prove" / "toolchain.txt";
    if (!fs::exists(path))
        throw Error(path.string() + " is not there: configure the build first (./learn test 03)");
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
    std::vector<std::string> objects = tools.libraries;
    objects.push_back(tools.test_main);
    for (const std::string& object : objects)
        if (!fs::exists(object)) throw Error(object + " is not built: ./learn prove builds it");
    hash.add(read_file((root / "tests/main.cpp").string()));
    tools.fixed = hash.text();
    fs::create_directories(tools.work / "cache");
    return tools;
}

std::string proof_key(const Toolchain& tools, const std::string& step) {
    Hash hash;
    std::set<std::string> seen;
    for (const std::string& source : check_sources(tools, Change{.step = step}))
        add_with_includes(tools, {}, source, seen, hash);
    hash.add(read_file((tools.root / "exercises" / step / "mistakes.md").string()));
    return hash.text();
}

void prepare(const Toolchain& tools, const std::string& step) {
    const BuildLock alone(tools.work);
    parse_ahead(tools, "tests/pch.h", optimisation(step));
    parse_ahead(tools, "common/pch.h", part_level);
}

Outcome run_checks(const Toolchain& tools, const Change& change) {
    Outcome outcome;
    for (const std::string& source : check_sources(tools, change)) {
        Outcome of_source = run_source(tools, change, source);
        const bool fails = std::ranges::any_of(of_source.results, has_failed);
        if (!of_source.compiled || of_source.too_long || fails) return of_source;
        std::ranges::move(of_source.results, std::back_inserter(outcome.results));
    }
    return outcome;
}

bool render_picture(const Toolchain& tools, const Change& change, const fs::path& picture) {
    const std::string source = "steps/" + change.step + "/main.cpp";
    const fs::path stamp = fs::path(picture).replace_extension(".key");
    const auto [key, parts] = look_at(tools, change, source);
    if (fs::exists(stamp) && read_file(stamp.string()) == key) return fs::exists(picture);
    const TemporaryFolder scratch(tools.work);
    write_overlay(scratch.path, change);
    const fs::path program = scratch.path / "program", log = scratch.path / "log";
    std::vector<std::string> objects;
    std::string complaint;
    for (const std::string& part : parts)
        if (complaint.empty()) complaint = compile_part(tools, change, part, scratch.path, objects);
    auto command = compile_command(tools, scratch.path);
    for (const std::string& word :
         {part_level, std::string("-include"), (tools.work / "common" / part_level / "pch.h").string(),
          (tools.root / source).string()})
        command.push_back(word);
    std::ranges::copy(objects, std::back_inserter(command));
    std::ranges::copy(tools.libraries, std::back_inserter(command));
    for (const std::string& word : {std::string("-pthread"), std::string("-o"), program.string()})
        command.push_back(word);
    if (complaint.empty() && run_process(command, log).code != 0) complaint = complaint_in(log);
    if (!complaint.empty()) throw Error(change.step + " does not compile: " + complaint);
    fs::create_directories(picture.parent_path());
    fs::remove(picture);
    std::vector<std::string> render{program.string(), "--quiet", "--threads", "1", "--out", picture.string()};
    std::ranges::copy(gallery_flags(tools.root, change.step), std::back_inserter(render));
    run_process(render, log, check_limits);
    write_file(stamp.string(), key);
    return fs::exists(picture);
}

} // namespace rt
