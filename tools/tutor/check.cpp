// ./learn check: builds, runs the checks, compares the picture, and prints a diagnosis and the next command.
#include "tools/tutor/commands.h"

#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/catalogue.h"
#include "tools/tutor/workshop.h"
#include "tools/tutor/check_parts.h"
#include "tools/tutor/build.h"
#include "tools/tutor/diagnosis.h"
#include "tools/tutor/hints.h"
#include "tools/tutor/report.h"
#include "tools/tutor/util.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <sstream>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

/// The results of one file of checks.
struct CheckedFile {
    std::string name; ///< "03_mirror_quad"
    std::vector<CheckResult> results;
};

/// Everything that one run finds out.
struct Findings {
    fs::path scratch; ///< a temporary folder for this run
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
    std::vector<Exercise> exercises;
    Words untouched;                 ///< exercises whose code is still that of the stub
    std::vector<CheckedFile> files;  ///< in the order in which they are reported
    std::vector<CheckResult> checks; ///< of all files
    Words earlier;                   ///< one line per step
    bool earlier_hold = true;
    PictureFinding picture;
    Diagnosis diagnosis;
    std::optional<Mistake> mistake; ///< the most likely mistake
    Words similar_mistakes;         ///< mistakes that produce the same picture
    std::string next;
};

/// Returns the time since the check began, in seconds, rounded down to one decimal.
double seconds_since(const Findings& findings) {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - findings.begin;
    return int(took.count() * 10) / 10.0;
}

std::size_t failures(const std::vector<CheckResult>& checks) {
    return std::size_t(std::ranges::count_if(checks, has_failed));
}

std::string passed_text(const std::vector<CheckResult>& checks) {
    return std::to_string(checks.size() - failures(checks)) + " of " + std::to_string(checks.size()) +
           " checks";
}

/// Returns the exercises in the learner's files whose code is still that of the stub.
Words untouched_exercises(const Project& project, const std::string& step,
                          const std::vector<Exercise>& exercises) {
    Words names;
    for (const Exercise& exercise : exercises) {
        const fs::path own = project.workshop / step / exercise.file;
        std::error_code ignored;
        if (!fs::is_regular_file(own, ignored)) continue;
        const std::string reference = read_file((steps_folder(project) / step / exercise.file).string());
        const std::string stub = make_stub(reference, find_exercises(reference, exercise.file));
        if (is_untouched(exercise, read_file(own.string()), stub)) names.push_back(exercise.name);
    }
    return names;
}

/// Returns the exercise that contains the line of a compile error in the learner's file, or nullptr.
const Exercise* exercise_at(const Project& project, const std::vector<Exercise>& exercises,
                            const CompileError& error) {
    const Exercise* nearest = nullptr;
    int begin = 0;
    for (const Exercise& exercise : exercises) {
        const fs::path own = project.workshop / exercise.step / exercise.file;
        std::error_code ignored;
        if (!error.file.ends_with(exercise.step + "/" + exercise.file) || !fs::is_regular_file(own, ignored))
            continue;
        const int line = line_of(exercise, read_file(own.string()));
        if (line > error.line + 3 || line < begin) continue; // the error may be reported before the gap
        nearest = &exercise;
        begin = line;
    }
    return nearest;
}

/// Prints only the first error, with the task and the first hint of the function that contains it.
void print_compile_error(const Project& project, const std::string& step, const BuildResult& built,
                         Findings& findings, std::ostream& out) {
    if (!built.error)
        throw Error("the build failed (exit code " + std::to_string(built.code) +
                    "), but no source file has an error; run ./learn check again, which repairs "
                    "broken build files. The build's output: " +
                    built.log);
    const std::string place = display_path(built.error->file, built.error->line);
    out << "Your code does not compile yet. The first error:\n\n  " << place << "\n    "
        << printable(built.error->message) << "\n\n";
    findings.picture = no_picture("your code does not compile yet");
    findings.picture.lines = {place + ": " + built.error->message};
    findings.next = "./learn check " + number_of(step);
    const Exercise* const exercise = exercise_at(project, findings.exercises, *built.error);
    if (!exercise) return;
    const Hints hints = read_hints(project.root, step, findings.exercises);
    out << "  " << exercise->name << ": " << exercise->task << "\n  " << hints.at(exercise->name)[0]
        << "\n\n";
    findings.next = "./learn hint " + number_of(step) + " " + exercise->name;
}

/// Runs one file of checks. If all of them pass, the results are stored and reused until the program changes.
std::vector<CheckResult> run_file(const CheckOptions& options, const std::string& file,
                                  const fs::path& scratch) {
    const fs::path program = options.build / "bin" / ("test_" + file), log = scratch / "checks.txt",
                   kept = options.build / ("results_" + file + ".txt");
    std::error_code ignored;
    const fs::file_time_type made = fs::last_write_time(program, ignored);
    if (fs::last_write_time(kept, ignored) > made) return parse_results(read_file(kept.string()));
    std::vector<CheckResult> checks = run_all_checks(program, log);
    if (failures(checks) == 0 && fs::last_write_time(program, ignored) == made)
        fs::rename(log, kept, ignored);
    return checks;
}

/// Returns the files of checks without the slow ones.
Words quick_files(const Project& project, const std::string& step) {
    Words files = check_files(project.root, step);
    std::erase_if(files, is_slow);
    return files;
}

/// Runs the checks of the earlier steps, which use the learner's files of those steps.
void run_earlier(const Project& project, const CheckOptions& options, Findings& findings) {
    for (const std::string& step : all_steps(project)) {
        if (step >= options.step) break;
        std::vector<CheckResult> checks;
        for (const std::string& file : quick_files(project, step))
            std::ranges::move(run_file(options, file, findings.scratch), std::back_inserter(checks));
        findings.earlier.push_back(step + ": " + passed_text(checks) + " pass");
        findings.earlier_hold = findings.earlier_hold && failures(checks) == 0;
    }
}

/// Returns whether the checks belong to a header in which the learner has not written anything yet.
bool belongs_to_untouched(const std::string& step, const std::string& file, const Findings& findings) {
    bool any = false;
    for (const Exercise& exercise : findings.exercises) {
        if (check_file_of(step, exercise.file) != file) continue;
        any = true;
        if (std::ranges::find(findings.untouched, exercise.name) == findings.untouched.end()) return false;
    }
    return any;
}

/// Returns the functions in which an endless check may hang: of the written functions of its header, those
/// with a loop or a recursion; if there are none, all of them.
Words suspects(const Project& project, const std::string& step, const Findings& findings) {
    Words all, loops;
    for (const Exercise& exercise : findings.exercises) {
        const std::string path = (project.workshop / step / exercise.file).string();
        const auto& untouched = findings.untouched;
        const bool written = std::ranges::find(untouched, exercise.name) == untouched.end();
        const std::string program = "test_" + check_file_of(step, exercise.file);
        std::error_code ignored;
        if (!written || findings.diagnosis.endless->failures.front().place != program) continue;
        if (!fs::is_regular_file(path, ignored)) continue;
        all.push_back(exercise.name + " (" + display_path(path, line_of(exercise, read_file(path))) + ")");
        if (may_not_end(exercise, read_file(path))) loops.push_back(all.back());
    }
    return loops.empty() ? all : loops;
}

/// Finds the likely mistake from the results of the checks. A wrong picture is also compared with the
/// pictures of the known mistakes.
void find_mistake(const Project& project, const CheckOptions& options, Findings& findings) {
    std::vector<std::vector<CheckResult>> written;
    for (const CheckedFile& file : findings.files)
        if (!belongs_to_untouched(options.step, file.name, findings)) written.push_back(file.results);
    findings.diagnosis = diagnose(read_signatures(project.root, options.step), written);
    if (findings.diagnosis.endless) findings.diagnosis.suspects = suspects(project, options.step, findings);
    const bool begun = findings.untouched.size() < findings.exercises.size();
    if (begun && findings.picture.comparison && !findings.picture.holds)
        findings.similar_mistakes =
            similar_mistakes(project.root, options.step, options.build, findings.scratch);
    for (const Mistake& mistake : read_catalogue(project.root, options.step)) {
        if (!findings.diagnosis.ids.empty() && mistake.id == findings.diagnosis.ids.front())
            findings.mistake = mistake;
        if (std::ranges::find(findings.similar_mistakes, mistake.id) != findings.similar_mistakes.end())
            findings.picture.lines.push_back("looks like a known mistake: " + mistake.title);
    }
}

bool all_hold(const Findings& findings) {
    return failures(findings.checks) == 0 && findings.earlier_hold && findings.picture.holds;
}

std::string next_step_after(const Project& project, const std::string& step) {
    const Words steps = all_steps(project);
    const auto place = std::ranges::find(steps, step);
    return place + 1 < steps.end() ? *(place + 1) : "";
}

std::string next_command(const Project& project, const std::string& step, const Findings& findings) {
    const std::string number = number_of(step);
    if (own_files(project, step).empty()) return "./learn start " + number;
    if (!findings.untouched.empty()) return "./learn hint " + number + " " + findings.untouched.front();
    if (failures(findings.checks) > 0 || !findings.picture.holds) return "./learn hint " + number;
    if (!findings.earlier_hold) return "./learn status";
    const std::string following = next_step_after(project, step);
    return following.empty() ? "./learn run " + number : "./learn start " + number_of(following);
}

// --- the terminal output ----------------------------------------------------------------------------------------

void print_failure(const CheckResult& check, std::ostream& out) {
    out << "  failed  " << printable(check.name) << "\n";
    if (check.failures.empty()) return;
    const Failure& failure = check.failures.front();
    out << "            " << printable(failure.values) << "\n";
    if (!failure.notes.empty()) out << "            " << printable(failure.notes.front()) << "\n";
}

void print_checks(const Project& project, const std::string& step, const Findings& findings,
                  std::ostream& out) {
    out << "checks    " << passed_text(findings.checks) << " pass";
    const std::size_t gaps = findings.untouched.size();
    if (gaps > 0)
        out << "; " << gaps << " of " << findings.exercises.size() << " functions are not written yet"
            << (gaps == findings.exercises.size() ? ", so checks are expected to fail" : "");
    out << "\n";
    int printed = 0;
    for (const CheckResult& check : findings.checks)
        if (has_failed(check) && printed++ < 3) print_failure(check, out);
    if (printed > 3) out << "  failed  " << printed - 3 << " more checks; the report lists them\n";
    if (own_files(project, step).empty())
        out << "          You have no files in workshop/" << step << ", so this checked the reference.\n";
}

/// Prints the likely mistake; nothing as long as no function has been written.
void print_mistake(const Project& project, const std::string& step, const Findings& findings,
                   std::ostream& out) {
    if (findings.untouched.size() == findings.exercises.size()) return;
    std::istringstream lines(explanation(findings.diagnosis, read_catalogue(project.root, step)));
    std::string margin = "mistake   ";
    for (std::string line; std::getline(lines, line); margin = std::string(10, ' '))
        out << margin << line << "\n";
}

// --- the report -------------------------------------------------------------------------------------------------

Json check_json(const CheckResult& check) {
    const bool ended = check.state == CheckState::ok || check.state == CheckState::failed ||
                       check.state == CheckState::skipped;
    Words lines;
    for (const Failure& failure : check.failures) {
        lines.push_back(failure.expression + ": " + failure.values);
        append(lines, failure.notes);
    }
    return {{"name", check.name},
            {"state", !ended                          ? "unfinished"
                      : check.state == CheckState::ok ? "ok"
                      : has_failed(check)             ? "failed"
                                                      : "skipped"},
            {"seconds", check.seconds},
            {"lines", lines}};
}

Json mistake_json(const Project& project, const Findings& findings) {
    if (!findings.mistake) return nullptr;
    const Mistake& mistake = *findings.mistake;
    return {{"title", mistake.title},
            {"confidence", name_of(findings.diagnosis.confidence)},
            {"shows", mistake.shows},
            {"why", mistake.why},
            {"fix", mistake.fix},
            {"picture", gallery_picture(project.root, mistake.step, mistake.id).string()}};
}

fs::path write_report(const Project& project, const CheckOptions& options, const Findings& findings) {
    const PictureFinding& picture = findings.picture;
    Json report{{"step", options.step},
                {"question", question_of(project, options.step)},
                {"own_files", Json::array()},
                {"checks", Json::array()},
                {"earlier", findings.earlier},
                {"verdict", picture.comparison ? picture.verdict : picture.reason},
                {"verdict_lines", picture.lines},
                {"flip_mean", picture.comparison ? picture.comparison->flip.mean : 0},
                {"flip_max", picture.comparison ? picture.comparison->flip.max : 0},
                {"tiles_over_4", nullptr},
                {"mistake", mistake_json(project, findings)},
                {"next", findings.next},
                {"settings", picture.settings},
                {"pictures",
                 {{"mine", picture.mine.string()},
                  {"reference", picture.reference.string()},
                  {"map", picture.map.string()}}}};
    for (const std::string& file : own_files(project, options.step))
        report["own_files"].push_back(options.step + "/" + file);
    for (const CheckResult& check : findings.checks) report["checks"].push_back(check_json(check));
    if (picture.comparison && picture.comparison->tiles)
        report["tiles_over_4"] = picture.comparison->tiles->outliers;
    const fs::path folder = project.workshop / "report", path = folder / (options.step + ".html");
    make_folder(folder);
    write_file(path.string(), report_html(project.root, report));
    return path;
}

/// Returns the most recently saved of the learner's headers that have their own checks, or else the first
/// such header of the step.
std::string saved_last(const Project& project, const std::string& step) {
    std::string last;
    fs::file_time_type when = fs::file_time_type::min();
    for (const Exercise& exercise : exercises_of(project, step)) {
        std::error_code missing, ignored;
        const fs::path own = project.workshop / step / exercise.file;
        const fs::file_time_type saved = fs::last_write_time(own, missing);
        const bool has_checks =
            fs::exists(project.root / check_source(step, check_file_of(step, exercise.file)), ignored);
        if (!has_checks || (!missing && saved < when) || (missing && !last.empty())) continue;
        last = exercise.file;
        if (!missing) when = saved;
    }
    return last;
}

/// Prints what the learner waits for as soon as possible: the checks of the saved file, then the picture.
BuildResult check_saved_file(const Project& project, const CheckOptions& options, Findings& findings,
                             std::ostream& out) {
    const std::string file = saved_last(project, options.step), checks = check_file_of(options.step, file);
    Words targets{"test_" + checks};
    if (options.picture) targets.push_back(options.step);
    const fs::path log = findings.scratch / "built.txt";
    const BuildResult built = build_targets(options.build, targets, log, "/workshop/", [&] {
        const std::vector<CheckResult> results = run_file(options, checks, findings.scratch);
        out << "file      " << file << ": " << passed_text(results) << " pass (" << seconds_since(findings)
            << " s)\n"
            << std::flush;
    });
    if (!built.succeeded || !options.picture) return built;
    findings.picture =
        render_and_compare(project.root, options.step, options.build, findings.scratch, Samples::few);
    out << (findings.picture.complete ? "picture   " : "preview   ") << findings.picture.lines.front() << " ("
        << seconds_since(findings) << " s)\n"
        << std::flush;
    return built;
}

/// Builds the step's other checks and those of the earlier steps, as far as they are out of date.
BuildResult build_others(const Project& project, const CheckOptions& options, Findings& findings,
                         std::ostream& out) {
    Words targets;
    for (const std::string& step : all_steps(project))
        if (step <= options.step)
            for (const std::string& file : quick_files(project, step)) targets.push_back("test_" + file);
    const BuildResult built =
        build_targets(options.build, targets, findings.scratch / "built.txt", "/workshop/");
    out << "built     the other checks (" << seconds_since(findings) << " s)\n" << std::flush;
    return built;
}

/// Runs the checks, renders, compares, and prints the results, the likely mistake and the next command.
void run_and_compare(const Project& project, const CheckOptions& options, Findings& findings,
                     std::ostream& out) {
    for (const std::string& file : quick_files(project, options.step)) {
        findings.files.push_back({file, run_file(options, file, findings.scratch)});
        std::ranges::copy(findings.files.back().results, std::back_inserter(findings.checks));
    }
    print_checks(project, options.step, findings, out);
    out << std::flush;
    run_earlier(project, options, findings);
    for (const std::string& line : findings.earlier) out << "earlier   " << printable(line) << "\n";
    if (!options.picture)
        findings.picture = no_picture("not rendered (--no-picture)");
    else if (!findings.picture.complete)
        findings.picture =
            render_and_compare(project.root, options.step, options.build, findings.scratch, Samples::all);
    find_mistake(project, options, findings);
    for (const std::string& line : findings.picture.lines) out << "picture   " << printable(line) << "\n";
    print_mistake(project, options.step, findings, out);
    findings.next = next_command(project, options.step, findings);
}

} // namespace

int check_step(const Project& project, const CheckOptions& options, std::ostream& out) {
    const TemporaryFolder scratch(options.build);
    Findings findings;
    findings.scratch = scratch.path;
    findings.exercises = exercises_of(project, options.step);
    findings.untouched = untouched_exercises(project, options.step, findings.exercises);
    out << "Step " << number_of(options.step) << ": " << question_of(project, options.step) << "\n";
    BuildResult built = check_saved_file(project, options, findings, out);
    if (built.succeeded) built = build_others(project, options, findings, out);
    if (built.succeeded)
        run_and_compare(project, options, findings, out);
    else
        print_compile_error(project, options.step, built, findings, out);
    const fs::path report = write_report(project, options, findings);
    write_check(project, options.step,
                {int(findings.checks.size() - failures(findings.checks)), int(failures(findings.checks)),
                 findings.picture.verdict, fingerprint(project, options.step)});
    out << "next      " << findings.next << "\nreport    " << display_path(report) << "\n";
    return built.succeeded && all_hold(findings) ? 0 : 1;
}

} // namespace rt::tutor
