// ./learn fuzz: searches for inputs that break a parser, with clang's libFuzzer.
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/build.h"
#include "tools/tutor/commands.h"
#include "tools/tutor/system.h"
#include "tools/tutor/util.h"

#include <iostream>
#include <mutex>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

bool has_libfuzzer(const fs::path& folder) {
    const std::string source = text_of(folder / "empty.cpp");
    write_file(source, "extern \"C\" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }\n");
    try {
        return run_process({"clang++", "-fsanitize=fuzzer,address", "-o", text_of(folder / "empty"), source},
                           {.log = folder / "log"})
                   .code == 0;
    } catch (const Error&) {
        return false; // no clang++
    }
}

/// Returns a folder in memory if the system has one, because the targets write many small files.
fs::path quick_folder() {
    std::error_code ignored;
    return fs::is_directory("/dev/shm", ignored) ? "/dev/shm" : fs::temp_directory_path();
}

void print_row(const Words& cells) {
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    std::cout << cell(cells[0], -12) << cell(cells[1], 12) << cell(cells[2], 9) << "  " << cells[3]
              << std::endl;
}

/// Returns the text after `mark` in the last line that contains it, or "0".
std::string last_after(const std::string& text, const std::string& mark) {
    const std::size_t at = text.rfind(mark);
    if (at == text.npos) return "0";
    return trimmed(text.substr(at + mark.size(), text.find('\n', at) - at - mark.size()));
}

/// Returns the files of past findings and the seeds, from tests/fuzz.
Words past_inputs(const fs::path& root, const std::string& target) {
    Words files;
    for (const char* kind : {"findings", "corpus"})
        for (const fs::path& file : entries_of(root / "tests/fuzz" / kind / target))
            files.push_back(text_of(file));
    return files;
}

/// Replays the known inputs, then searches for new ones. Returns whether all of them passed.
bool fuzz_target(const Preset& preset, const std::string& target, const FuzzOptions& options) {
    const fs::path build = preset.folder(), log = build / (target + ".log"),
                   corpus = build / "corpus" / target, found = build / "found" / target;
    const Words past = past_inputs(preset.root, target);
    make_folder(corpus);
    make_folder(found);
    Words command{text_of(preset.program("fuzz")), "--target=" + target};
    Words replay = command;
    append(replay, past);
    if (run_process(replay, {.log = log}).code != 0) {
        print_row({target, "-", "-",
                   "known input fails: " + last_after(read_file(text_of(log)), "Running: ") + ", see " +
                       text_of(log)});
        return false;
    }
    for (const std::string& file : past)
        fs::copy_file(path_of(file), corpus / path_of(file).filename(), fs::copy_options::overwrite_existing);
    append(command,
           {"-max_total_time=" + std::to_string(options.seconds), "-seed=" + std::to_string(options.seed),
            "-timeout=20", "-rss_limit_mb=3000", "-max_len=4096", "-print_final_stats=1",
            "-artifact_prefix=" + text_of(found / ""), text_of(corpus)});
    const ProcessResult result = run_process(command, {.log = log});
    const std::string text = read_file(text_of(log));
    print_row({target, last_after(text, "stat::number_of_executed_units:"),
               std::to_string(int(result.cpu_seconds + .5)),
               result.code == 0 ? "0" : last_after(text, "Test unit written to ") + ", see " + text_of(log)});
    return result.code == 0;
}

} // namespace

Words fuzz_targets(const Project& project) {
    Words targets;
    for (const fs::path& folder : entries_of(project.root / "tests/fuzz/corpus"))
        targets.push_back(text_of(folder.filename()));
    return targets;
}

int fuzz(const Project& project, const FuzzOptions& options) {
    const Preset preset{project.root, "fuzz"};
    const TemporaryFolder folder(quick_folder());
    set_environment("TMPDIR", text_of(folder.path));
    if (!has_libfuzzer(folder.path))
        throw Error("fuzz needs clang++ with libFuzzer; on Debian: apt-get install clang libclang-rt-14-dev");
    make(preset, {"fuzz"});
    const Words targets = options.target.empty() ? fuzz_targets(project) : Words{options.target};
    print_row({"target", "executions", "CPU s", "findings"});
    std::vector<char> good(targets.size(), 0);
    in_parallel(targets.size(), 2,
                [&](std::size_t i) { good[i] = fuzz_target(preset, targets[i], options); });
    return contains(good, 0) ? 1 : 0;
}

} // namespace rt::tutor
