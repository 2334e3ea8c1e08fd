// One question after the other: does it compile, do the checks hold, is the picture right, what is likely
// wrong, what is next.
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

/// What came of one file of checks.
struct CheckedFile {
    std::string name; ///< "03_mirror_quad"
    std::vector<CheckResult> results;
};

/// All that one run finds out.
struct Findings {
    fs::path scratch; ///< a folder of this run alone
    std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
    std::vector<Exercise> exercises;
    Words untouched;                 ///< exercises that still are as the stub has them
    std::vector<CheckedFile> files;  ///< in the order in which they are to be told
    std::vector<CheckResult> checks; ///< of all of them
    Words earlier;                   ///< a line a step
    bool earlier_hold = true;
    PictureFinding picture;
    Diagnosis diagnosis;
    std::optional<Mistake> mistake; ///< the likely one
    Words similar_mistakes;         ///< mistakes that make the same picture
    std::string next;
};

/// Since the check began, in seconds with one decimal.
double seconds_since(const Findings& findings) {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - findings.begin;
    return int(took.count() * 10) / 10.0;
}

std::size_t failures(const std::vector<CheckResult>& checks) {
    return std::size_t(std::ranges::count_if(checks, has_failed));
}

std::string passed_of(const std::vector<CheckResult>& checks) {
    return std::to_string(checks.size() - failures(checks)) + " of " + std::to_string(checks.size()) +
           " checks";
}

/// Exercises that the learner has begun to write, but left as they were.
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

/// The exercise that the line of the learner's file belongs to; nothing where that is not one.
const Exercise* exercise_at(const Project& project, const std::vector<Exercise>& exercises,
                            const CompileError& error) {
    const Exercise* nearest = nullptr;
    int begin = 0;
    for (const Exercise& exercise : exercises) {
        const fs::path own = project.workshop / exercise.step / exercise.file;
        std::error_code ignored;
        if (!error.file.ends_with(exercise.step + "/" + exercise.file) || !fs::is_regular_file(own, ignored))
            continue;
        const int line = place_of(exercise, read_file(own.string()));
        if (line > error.line + 3 || line < begin) continue; // an error may be found before the gap itself
        nearest = &exercise;
        begin = line;
    }
    return nearest;
}

/// The first error alone, and the first hint for the function that it is in.
void print_compile_error(const Project& project, const std::string& step, const BuildResult& built,
                         Findings& findings, std::ostream& out) {
    if (!built.error)
        throw Error("the build failed (exit code " + std::to_string(built.code) +
                    "), but not for an error in a file; the next ./learn check mends broken files of "
                    "the build itself; it says: " +
                    built.log);
    const std::string place = display_path(built.error->file, built.error->line);
    out << "It does not compile yet. The first error:\n\n  " << place << "\n    "
        << printable(built.error->message) << "\n\n";
    findings.picture = no_picture("it does not compile yet");
    findings.picture.lines = {place + ": " + built.error->message};
    findings.next = "./learn check " + number_of(step);
    const Exercise* const exercise = exercise_at(project, findings.exercises, *built.error);
    if (!exercise) return;
    const Hints hints = read_hints(project.root, step, findings.exercises);
    out << "  " << exercise->name << ": " << exercise->task << "\n  " << hints.at(exercise->name)[0]
        << "\n\n";
    findings.next = "./learn hint " + number_of(step) + " " + exercise->name;
}

/// One file of checks. Once all of them hold, nothing but another program changes that: what they said then
/// is kept.
std::vector<CheckResult> run_file(const CheckOptions& options, const std::string& file,
                                  const fs::path& scratch) {
    const fs::path program = options.build / "bin" / ("test_" + file), log = scratch / "checks.txt",
                   kept = options.build / ("said_" + file + ".txt");
    std::error_code ignored;
    const fs::file_time_type made = fs::last_write_time(program, ignored);
    if (fs::last_write_time(kept, ignored) > made) return parse_results(read_file(kept.string()));
    std::vector<CheckResult> checks = run_all_checks(program, log);
    if (failures(checks) == 0 && fs::last_write_time(program, ignored) == made)
        fs::rename(log, kept, ignored);
    return checks;
}

/// Those that a learner waits for.
Words quick_files(const Project& project, const std::string& step) {
    Words files = check_files(project.root, step);
    std::erase_if(files, is_slow);
    return files;
}

/// The steps before; what the learner wrote there counts here as well.
void run_earlier(const Project& project, const CheckOptions& options, Findings& findings) {
    for (const std::string& step : all_steps(project)) {
        if (step >= options.step) break;
        std::vector<CheckResult> checks;
        for (const std::string& file : quick_files(project, step))
            std::ranges::move(run_file(options, file, findings.scratch), std::back_inserter(checks));
        findings.earlier.push_back(step + ": " + passed_of(checks));
        findings.earlier_hold = findings.earlier_hold && failures(checks) == 0;
    }
}

/// Whether the checks are those of a header in which the learner has written nothing yet.
bool is_of_untouched(const std::string& step, const std::string& file, const Findings& findings) {
    bool of_some = false;
    for (const Exercise& exercise : findings.exercises) {
        if (check_file_of(step, exercise.file) != file) continue;
        of_some = true;
        if (std::ranges::find(findings.untouched, exercise.name) == findings.untouched.end()) return false;
    }
    return of_some;
}

/// The functions that a check which does not end may hang in: of those that its file of checks is about and
/// that are written, those that have a loop or call themselves, or else all.
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
        all.push_back(exercise.name + " (" + display_path(path, place_of(exercise, read_file(path))) + ")");
        if (may_not_end(exercise, read_file(path))) loops.push_back(all.back());
    }
    return loops.empty() ? all : loops;
}

/// By what the checks say. A picture that is wrong is compared with those of the known mistakes, too.
void find_mistake(const Project& project, const CheckOptions& options, Findings& findings) {
    std::vector<std::vector<CheckResult>> written;
    for (const CheckedFile& file : findings.files)
        if (!is_of_untouched(options.step, file.name, findings)) written.push_back(file.results);
    findings.diagnosis = diagnose(read_signatures(project.root, options.step), written);
    if (findings.diagnosis.endless) findings.diagnosis.suspects = suspects(project, options.step, findings);
    const bool begun = findings.untouched.size() < findings.exercises.size();
    if (begun && findings.picture.judgement && !findings.picture.holds)
        findings.similar_mistakes =
            similar_mistakes(project.root, options.step, options.build, findings.scratch);
    for (const Mistake& mistake : read_catalogue(project.root, options.step)) {
        if (!findings.diagnosis.ids.empty() && mistake.id == findings.diagnosis.ids.front())
            findings.mistake = mistake;
        if (std::ranges::find(findings.similar_mistakes, mistake.id) != findings.similar_mistakes.end())
            findings.picture.lines.push_back("looks like the known mistake: " + mistake.title);
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

// --- one screen -------------------------------------------------------------------------------------------------

void print_failure(const CheckResult& check, std::ostream& out) {
    out << "  red     " << printable(check.name) << "\n";
    if (check.failures.empty()) return;
    const Failure& failure = check.failures.front();
    out << "            " << printable(failure.values) << "\n";
    if (!failure.notes.empty()) out << "            " << printable(failure.notes.front()) << "\n";
}

void print_checks(const Project& project, const std::string& step, const Findings& findings,
                  std::ostream& out) {
    out << "checks    " << passed_of(findings.checks) << " hold";
    const std::size_t gaps = findings.untouched.size();
    if (gaps > 0)
        out << "; " << gaps << " of " << findings.exercises.size() << " functions still are as they were cut"
            << (gaps == findings.exercises.size() ? ", so red is what they should be" : "");
    out << "\n";
    int said = 0;
    for (const CheckResult& check : findings.checks)
        if (has_failed(check) && said++ < 3) print_failure(check, out);
    if (said > 3) out << "  red     and " << said - 3 << " more: the report has them\n";
    if (own_files(project, step).empty())
        out << "          workshop/" << step << " holds no file of yours: this is the reference\n";
}

/// While all is still as it was cut, the stub is the mistake.
void print_mistake(const Project& project, const std::string& step, const Findings& findings,
                   std::ostream& out) {
    if (findings.untouched.size() == findings.exercises.size()) return;
    std::istringstream lines(explanation(findings.diagnosis, read_catalogue(project.root, step)));
    std::string margin = "likely    ";
    for (std::string line; std::getline(lines, line); margin = std::string(10, ' '))
        out << margin << line << "\n";
}

// --- what stays -------------------------------------------------------------------------------------------------

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
                {"verdict", picture.judgement ? picture.verdict : picture.reason},
                {"verdict_lines", picture.lines},
                {"flip_mean", picture.judgement ? picture.judgement->flip.mean : 0},
                {"flip_max", picture.judgement ? picture.judgement->flip.max : 0},
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
    if (picture.judgement && picture.judgement->tiles)
        report["tiles_over_4"] = picture.judgement->tiles->outliers;
    const fs::path folder = project.workshop / "report", path = folder / (options.step + ".html");
    make_folder(folder);
    write_file(path.string(), report_html(project.root, report));
    return path;
}

/// Of the learner's headers that have checks of their own, the one that was saved last; else the first of the
/// step's.
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

/// What somebody waits for, as soon as it is there: the checks of the file that was saved, then the picture.
BuildResult check_saved_file(const Project& project, const CheckOptions& options, Findings& findings,
                             std::ostream& out) {
    const std::string file = saved_last(project, options.step), checks = check_file_of(options.step, file);
    Words targets{"test_" + checks};
    if (options.picture) targets.push_back(options.step);
    const fs::path log = findings.scratch / "built.txt";
    const BuildResult built = build_targets(options.build, targets, log, "/workshop/", [&] {
        const std::vector<CheckResult> results = run_file(options, checks, findings.scratch);
        out << "first     " << file << ", quick ones: " << passed_of(results) << " hold ("
            << seconds_since(findings) << " s)\n"
            << std::flush;
    });
    if (!built.succeeded || !options.picture) return built;
    findings.picture =
        judge_picture(project.root, options.step, options.build, findings.scratch, Samples::few);
    out << (findings.picture.complete ? "picture   " : "glimpse   ") << findings.picture.lines.front() << " ("
        << seconds_since(findings) << " s)\n"
        << std::flush;
    return built;
}

/// The step's other checks, and those of the steps before: what changed of them.
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

/// Runs the checks, renders, compares; says what holds, what is likely wrong and what is next.
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
        findings.picture = no_picture("only the checks were asked for");
    else if (!findings.picture.complete)
        findings.picture =
            judge_picture(project.root, options.step, options.build, findings.scratch, Samples::all);
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
