// Compiles, links and runs checks with changed headers, and keeps what came.
#include "tools/tutor/proof.h"

#include "common/error.h"
#include "common/file_bytes.h"
#include "tools/tutor/exercises.h"
#include "tools/tutor/process.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace rt {

namespace fs = std::filesystem;

namespace {

constexpr RunLimits check_limits{.cpu_seconds = 30, .seconds = 300, .memory = std::uint64_t(4) << 30};

/// Fowler, Noll and Vo, 64 bits, variant 1a.
class Hash {
  public:
    void add(std::string_view bytes) {
        for (const char c : bytes) state = (state ^ std::uint8_t(c)) * 0x100000001b3u;
        state = (state ^ 0xff) * 0x100000001b3u; // so that "a", "bc" is not "ab", "c"
    }
    std::string text() const {
        char digits[17];
        std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(state));
        return digits;
    }

  private:
    std::uint64_t state = 0xcbf29ce484222325u;
};

/// The name in #include "name", or nothing.
std::string included(const std::string& line) {
    const std::string begin = "#include \"";
    if (!line.starts_with(begin)) return "";
    return line.substr(begin.size(), line.find('"', begin.size()) - begin.size());
}

/// The text that an include finds: the change's, the reference's, or the project's.
std::string text_of(const Toolchain& tools, const Change& change, const std::string& name) {
    if (const auto found = change.headers.find(name); found != change.headers.end()) return found->second;
    for (const fs::path& folder : {tools.root / "steps", tools.root})
        if (fs::exists(folder / name)) return read_file((folder / name).string());
    return "";
}

void add_with_includes(const Toolchain& tools, const Change& change, const std::string& name,
                       std::set<std::string>& seen, Hash& hash) {
    if (!seen.insert(name).second) return;
    const std::string text = text_of(tools, change, name);
    hash.add(name);
    hash.add(text);
    for (const std::string& line : lines_of(text))
        if (const std::string other = included(line); !other.empty())
            add_with_includes(tools, change, other, seen, hash);
}

/// Of all that the object of a source depends on.
std::string object_key(const Toolchain& tools, const Change& change, const std::string& source) {
    Hash hash;
    std::set<std::string> seen;
    hash.add(tools.fixed);
    add_with_includes(tools, change, source, seen, hash);
    return hash.text();
}

/// "tests/03_mirror.cpp" and others of the step.
std::vector<std::string> check_sources(const Toolchain& tools, const std::string& step, bool statistics) {
    std::vector<std::string> sources;
    for (const auto& entry : fs::directory_iterator(tools.root / "tests")) {
        const std::string name = entry.path().filename().string();
        const bool slow = name.find("_statistics") != std::string::npos;
        if (name.starts_with(step) && name.ends_with(".cpp") && slow == statistics)
            sources.push_back("tests/" + name);
    }
    std::ranges::sort(sources);
    return sources;
}

fs::path write_overlay(const fs::path& folder, const Change& change) {
    for (const auto& [name, text] : change.headers) {
        fs::create_directories((folder / name).parent_path());
        write_file((folder / name).string(), text);
    }
    return folder;
}

std::vector<std::string> compile_command(const Toolchain& tools, const fs::path& overlay) {
    std::vector<std::string> command{tools.compiler, "-w", "-I" + overlay.string(),
                                     "-I" + (tools.root / "steps").string()};
    command.insert(command.end(), tools.flags.begin(), tools.flags.end());
    return command;
}

/// A folder that nobody else uses, gone with all that is in it in the end.
struct Scratch {
    fs::path path;
    Scratch(const Toolchain& tools, const Change& change, const std::string& kind)
        : path(tools.work / "scratch" / (change.step + "." + change.id + "." + kind)) {
        fs::remove_all(path);
        fs::create_directories(path);
    }
    ~Scratch() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
};

/// The compiler's first error, on one line.
std::string first_error(const fs::path& log) {
    for (const std::string& line : lines_of(read_file(log.string())))
        if (line.find("error") != std::string::npos) return line;
    return "the compiler failed and did not say why";
}

/// The object of one source; those that the change does not touch are kept. Empty, with a complaint, if it does not
/// compile.
fs::path object_of(const Toolchain& tools, const Change& change, const std::string& source,
                   const fs::path& scratch, std::string& complaint) {
    const std::string key = object_key(tools, change, source);
    const bool untouched = key == object_key(tools, {}, source);
    const fs::path kept = tools.work / "cache" / (key + ".o");
    if (untouched && fs::exists(kept)) return kept;
    const fs::path object = scratch / (fs::path(source).stem().string() + ".o");
    auto command = compile_command(tools, scratch);
    for (const std::string& word :
         {std::string("-O1"), std::string("-include"), (tools.work / "prefix.h").string(), std::string("-c"),
          (tools.root / source).string(), std::string("-o"), object.string()})
        command.push_back(word);
    const fs::path log = scratch / "compiler.log";
    if (run_process(command, log).code != 0) {
        complaint = first_error(log);
        return {};
    }
    if (!untouched) return object;
    fs::rename(object, kept);
    return kept;
}

/// Links and runs the objects; answers what the cache keeps: the exit code, then what the checks printed.
std::string run_objects(const Toolchain& tools, const std::vector<std::string>& objects,
                        const fs::path& scratch) {
    const fs::path program = scratch / "checks", log = scratch / "checks.log";
    std::vector<std::string> command{tools.compiler};
    command.insert(command.end(), tools.flags.begin(), tools.flags.end());
    command.insert(command.end(), objects.begin(), objects.end());
    for (const std::string& word :
         {tools.test_main, tools.library, std::string("-pthread"), std::string("-o"), program.string()})
        command.push_back(word);
    if (run_process(command, log).code != 0) throw Error("the checks do not link: " + first_error(log));
    const Ended ended = run_process({program.string(), "--reporters=lines"}, log, check_limits);
    return (ended.too_long ? "too long\n" : "ended\n") + read_file(log.string());
}

Outcome outcome_from(const std::string& kept) {
    Outcome outcome;
    outcome.too_long = kept.starts_with("too long");
    outcome.results = parse_results(kept);
    return outcome;
}

} // namespace

Toolchain read_toolchain(const fs::path& root, const fs::path& build) {
    Toolchain tools{.root = root,
                    .work = root / "build" / "prove",
                    .compiler = {},
                    .flags = {},
                    .test_main = {},
                    .library = {},
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
        if (key == "library") tools.library = value;
        hash.add(line);
    }
    for (const std::string& object : {tools.test_main, tools.library}) {
        if (!fs::exists(object)) throw Error(object + " is not built: ./learn prove builds it");
        hash.add(read_file(object));
    }
    tools.fixed = hash.text();
    fs::create_directories(tools.work / "cache");
    return tools;
}

void prepare(const Toolchain& tools) {
    const fs::path prefix = tools.work / "prefix.h", made = tools.work / "prefix.h.gch",
                   stamp = tools.work / "prefix.key";
    Hash hash;
    std::set<std::string> seen;
    hash.add(tools.fixed);
    add_with_includes(tools, {}, "tools/tutor/prefix.h", seen, hash);
    if (fs::exists(made) && fs::exists(stamp) && read_file(stamp.string()) == hash.text()) return;
    write_file(prefix.string(), read_file((tools.root / "tools/tutor/prefix.h").string()));
    auto command = compile_command(tools, tools.work);
    for (const std::string& word : {std::string("-O1"), std::string("-x"), std::string("c++-header"),
                                    prefix.string(), std::string("-o"), made.string()})
        command.push_back(word);
    const fs::path log = tools.work / "prefix.log";
    if (run_process(command, log).code != 0)
        throw Error("the checks' headers do not compile: " + first_error(log));
    write_file(stamp.string(), hash.text());
}

Outcome run_checks(const Toolchain& tools, const Change& change, bool statistics) {
    const std::vector<std::string> sources = check_sources(tools, change.step, statistics);
    Hash hash;
    for (const std::string& source : sources) hash.add(object_key(tools, change, source));
    const fs::path kept = tools.work / "cache" / (hash.text() + ".lines");
    if (fs::exists(kept)) return outcome_from(read_file(kept.string()));

    const Scratch scratch(tools, change, statistics ? "statistics" : "checks");
    write_overlay(scratch.path, change);
    std::vector<std::string> objects;
    Outcome broken{.compiled = false, .too_long = false, .complaint = {}, .results = {}};
    for (const std::string& source : sources) {
        objects.push_back(object_of(tools, change, source, scratch.path, broken.complaint).string());
        if (objects.back().empty()) return broken;
    }
    const std::string lines = run_objects(tools, objects, scratch.path);
    write_file(kept.string(), lines);
    return outcome_from(lines);
}

bool has_statistics(const Toolchain& tools, const std::string& step) {
    return !check_sources(tools, step, true).empty();
}

bool render_picture(const Toolchain& tools, const Change& change, const fs::path& picture) {
    const std::string source = "steps/" + change.step + "/main.cpp";
    const fs::path stamp = fs::path(picture).replace_extension(".key");
    const std::string key = object_key(tools, change, source);
    if (fs::exists(stamp) && read_file(stamp.string()) == key) return fs::exists(picture);
    const Scratch scratch(tools, change, "picture");
    write_overlay(scratch.path, change);
    const fs::path program = scratch.path / "program", log = scratch.path / "log";
    auto command = compile_command(tools, scratch.path);
    for (const std::string& word : {std::string("-O2"), (tools.root / source).string(), tools.library,
                                    std::string("-pthread"), std::string("-o"), program.string()})
        command.push_back(word);
    if (run_process(command, log).code != 0)
        throw Error(change.step + " does not compile: " + first_error(log));
    fs::create_directories(picture.parent_path());
    fs::remove(picture);
    run_process({program.string(), "--quiet", "--threads", "1", "--width", "240", "--height", "150",
                 "--samples", "16", "--out", picture.string()},
                log, check_limits);
    write_file(stamp.string(), key);
    return fs::exists(picture);
}

} // namespace rt
