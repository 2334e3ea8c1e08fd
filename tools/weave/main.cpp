// weave: updates the code and the outputs in the chapters, and reports what is out of date.
// Exit code: 0 everything is up to date, 1 something is not, 2 a page cannot be read, written or parsed.
#include "tools/weave/pages.h"
#include "tools/weave/weave.h"

#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/util/version.h"
#include "tools/tutor/exercises.h"
#include "tools/tutor/record.h"
#include "tools/tutor/system.h"
#include "tools/tutor/util.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <exception>
#include <iostream>

namespace {

namespace fs = std::filesystem;

struct Options {
    std::string root = ".";
    std::vector<std::string> pages;
    bool check = false, commands = false, changed = false, outputs = false;
};

/// Returns the paths of the pages, relative to the root: those named, or else all in the root,
/// docs/ and accel/.
std::vector<std::string> pages_of(const Options& options) {
    if (!options.pages.empty()) return options.pages;
    std::vector<std::string> pages;
    for (const std::string folder : {"", "docs/", "accel/"})
        for (const fs::path& entry : rt::tutor::entries_of(rt::path_of(options.root) / folder))
            if (entry.extension() == ".md") pages.push_back(folder + rt::text_of(entry.filename()));
    std::ranges::sort(pages);
    return pages;
}

/// Prints findings, one per line.
struct Report {
    bool up_to_date = true;
    void add(const std::string& line) {
        up_to_date = false;
        std::cout << rt::printable_lines(line) << std::endl;
    }
};

/// Removes what differs between clones: the path of the project and build times.
std::string without_local_parts(const std::string& root, const std::string& output) {
    std::string result;
    for (std::string line : rt::tutor::lines_of(output)) {
        if (line.starts_with("building...")) continue;
        for (std::size_t at; (at = line.find(root + "/")) != std::string::npos;)
            line.erase(at, root.size() + 1);
        result += line + '\n';
    }
    return result;
}

/// Runs a bash command in the project's folder, whose name may contain any characters. `log`
/// receives the output.
rt::tutor::ProcessResult run_line(const Options& options, const std::string& line, const fs::path& log) {
    const std::string command = "cd -- \"$1\" && shift && " + line;
    return rt::tutor::run_process({"bash", "-c", command, "weave", options.root},
                                  {.log = log, .seconds = 600});
}

/// Returns the standard output of a command. Throws Error if its exit code is not 0.
std::string output_of(const Options& options, const std::string& command) {
    const rt::tutor::TemporaryFolder scratch;
    const fs::path log = scratch.path / "log";
    const rt::tutor::ProcessResult result = run_line(options, "{ " + command + "\n} 2>/dev/null", log);
    const std::string output = rt::read_file(rt::text_of(log));
    if (result.code != 0)
        throw rt::Error("`" + command + "` exits with code " + std::to_string(result.code) + ":\n" + output);
    return without_local_parts(options.root, output);
}

bool is_run(const rt::weave::Block& block) {
    return block.kind == "output" || block.kind == "measured";
}

/// Updates a page if it is out of date.
void weave(const Options& options, const std::string& page) {
    const fs::path path = rt::path_of(options.root) / page;
    const std::string old = rt::read_file(rt::text_of(path));
    const std::string fresh =
        rt::weave::weave_page(old, page, [&](const rt::weave::Block& block, const std::string& now) {
            if (!is_run(block)) return rt::weave::block_text(rt::path_of(options.root), block);
            return now.empty() || options.outputs ? rt::weave::fence(output_of(options, block.what)) : now;
        });
    if (fresh == old) return;
    rt::write_file(rt::text_of(path), fresh);
    std::cout << page << ": updated\n";
}

/// Reports the blocks of a page that are out of date, and its dead links.
void check(const Options& options, const std::string& page, Report& report) {
    const std::string text = rt::read_file(rt::text_of(rt::path_of(options.root) / page));
    rt::weave::weave_page(text, page, [&](const rt::weave::Block& block, const std::string& now) {
        const std::string where = page + ":" + std::to_string(block.begin) + ": ";
        if (is_run(block) ? now.empty() : now != rt::weave::block_text(rt::path_of(options.root), block))
            report.add(where + block.kind + " " + block.what + " is out of date; ./learn weave updates it");
        return now;
    });
    for (const std::string& line : rt::weave::dead_links(rt::path_of(options.root), text, page))
        report.add(line);
    for (const std::string& line : rt::weave::unshowable_math(text, page)) report.add(line);
}

/// Compares the outputs that a page shows with the actual outputs.
void run_outputs(const Options& options, const std::string& page, const std::string& text, Report& report) {
    rt::weave::weave_page(text, page, [&](const rt::weave::Block& block, const std::string& now) {
        if (!is_run(block)) return now;
        std::cout << page << ":" << block.begin << ": " << block.what << std::endl;
        const std::string fresh = rt::weave::fence(output_of(options, block.what));
        if (block.kind == "output" && fresh != now)
            report.add(page + ":" + std::to_string(block.begin) + ": the output has changed to:\n" + fresh);
        return now;
    });
}

/// Runs the commands of the outputs, then the commands that a page tells its reader to type. The workshop
/// must not exist before, and is removed afterwards.
void run_commands(const Options& options, const std::string& page, Report& report) {
    const std::string text = rt::read_file(rt::text_of(rt::path_of(options.root) / page));
    const fs::path workshop = rt::path_of(options.root) / "workshop";
    const rt::tutor::TemporaryFolder scratch;
    const fs::path log = scratch.path / "log";
    std::error_code ignored;
    if (fs::exists(workshop, ignored))
        throw rt::Error(
            "workshop/ exists, and its files would change the output of the commands; move it away");
    run_outputs(options, page, text, report);
    for (const rt::weave::Command& command : rt::weave::find_commands(rt::tutor::lines_of(text), page)) {
        std::cout << page << ":" << command.number << ": " << command.line << std::endl;
        const rt::tutor::ProcessResult result = run_line(options, command.line, log);
        if (result.code != command.code || result.timed_out)
            report.add(page + ":" + std::to_string(command.number) + ": exits with code " +
                       std::to_string(result.code) + ", not " + std::to_string(command.code) + ":\n" +
                       rt::read_file(rt::text_of(log)));
    }
    fs::remove_all(workshop, ignored);
}

/// Writes docs/ran.txt: for each page with commands, a hash of what was run when all of it succeeded.
void note_keys(const Options& options, rt::tutor::Record record) {
    const fs::path root = rt::path_of(options.root);
    std::erase_if(record, [&](const auto& page) { return !fs::exists(root / page.first); });
    rt::tutor::write_record(
        root / "docs" / "ran.txt",
        "# For each page whose commands all succeeded, a hash of its commands and outputs, ./learn and the "
        "steps.\n# Written by ./learn weave --commands, read by ./learn weave --commands --changed.\n",
        record);
}

/// Runs the commands of all pages, or with --changed only of pages that changed since they last succeeded.
/// Returns the exit code.
int run_all_commands(const Options& options) {
    rt::tutor::Record keys = rt::tutor::read_record(rt::path_of(options.root) / "docs" / "ran.txt");
    bool up_to_date = true;
    for (const std::string& page : pages_of(options)) {
        const std::string key = rt::weave::page_key(rt::path_of(options.root), page);
        if (key.empty()) keys.erase(page);
        if (key.empty() || (options.changed && keys[page] == key)) continue;
        Report report;
        run_commands(options, page, report);
        up_to_date = up_to_date && report.up_to_date;
        if (!report.up_to_date) continue;
        keys[page] = key;
        note_keys(options, keys);
    }
    return up_to_date ? 0 : 1;
}

int run(const Options& options) {
    if (options.commands) return run_all_commands(options);
    Report report;
    for (const std::string& page : pages_of(options)) {
        if (options.check)
            check(options, page, report);
        else
            weave(options, page);
    }
    return report.up_to_date ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Updates the listings, diffs, galleries and outputs in the chapters.\n"
                 "Exit code: 0 everything is up to date, 1 something is not, 2 an error.",
                 "weave");
    Options options;
    app.allow_windows_style_options(false); // a path may begin with a slash
    app.set_version_flag("--version", rt::version());
    app.add_option(
        "PAGES", options.pages,
        "such as docs/03_mirror.md; by default all pages in the project's folder, docs/ and accel/");
    CLI::Option* const check_flag =
        app.add_flag("--check", options.check, "write nothing; report what is out of date, and dead links");
    CLI::Option* const commands_flag =
        app.add_flag("--commands", options.commands,
                     "write nothing; run every command of the pages, and compare the outputs that they show");
    app.add_flag("--changed", options.changed,
                 "with --commands: skip pages that have not changed since they last succeeded (docs/ran.txt)")
        ->needs(commands_flag);
    app.add_flag("--outputs", options.outputs,
                 "run the commands of all outputs again, not only of those that are empty")
        ->excludes(check_flag)
        ->excludes(commands_flag);
    check_flag->excludes(commands_flag);
    app.add_option("--root", options.root, "the project's folder")->required();
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        return run(options);
    } catch (const std::exception& error) {
        return rt::report_error("weave", error.what());
    }
}
