// ./learn check: what fails is always about lines that the learner wrote, since functions that are not written yet are the
// reference's while the checks run. Each red function is found by checking it alone among the reference's.
#include "tools/tutor/commands.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/check_report.h"
#include "tools/tutor/hints.h"
#include "tools/tutor/milestones.h"
#include "tools/tutor/screen.h"
#include "tools/tutor/system.h"
#include "tools/tutor/util.h"

#include "common/util/cores.h"

#include <algorithm>
#include <atomic>
#include <cctype>
#include <iterator>
#include <optional>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

/// The learner's code does not compile.
struct CompileFailure {
    std::string log;
};

/// Everything that the parts of a check share.
struct Session {
    const Project& project;
    const CheckOptions& options;
    const Toolchain& tools;
    Screen& screen;
    Findings& findings;

    const std::string& step() const { return options.step; }
    Change change(const std::string& id, Headers headers) const {
        return {options.step, id, std::move(headers)};
    }
};

std::string seconds_text(const Findings& findings) {
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - findings.begin;
    char text[32];
    std::snprintf(text, sizeof text, " (%.1f s)", took.count());
    return text;
}

Words names_in(const Findings& findings, GapState state) {
    Words names;
    for (const Gap& gap : findings.gaps)
        if (gap.state == state) names.push_back(gap.exercise.name);
    return names;
}

bool is_red(const Findings& findings, const std::string& name) {
    return std::ranges::find(findings.red, name, &RedFunction::name) != findings.red.end();
}

const Gap& gap_named(const Findings& findings, const std::string& name) {
    return *std::ranges::find(findings.gaps, name, [](const Gap& gap) { return gap.exercise.name; });
}

/// Runs one file of checks on the learner's code. Throws CompileFailure.
Outcome checked(const Toolchain& tools, const Change& change, const std::string& source) {
    Outcome outcome = run_source(tools, change, source);
    if (!outcome.compiled) throw CompileFailure{outcome.log};
    return outcome;
}

/// Returns the step's sources of checks but for slow ones.
Words quick_sources(const Project& project, const std::string& step) {
    Words sources;
    for (const std::string& file : check_files(project.root, step))
        if (!is_slow(file)) sources.push_back(check_source(step, file));
    return sources;
}

/// Returns the learner's header of the step that was saved last, such as "mirror.h"; empty if there is none.
std::string saved_last(const Project& project, const std::string& step) {
    std::string last;
    fs::file_time_type when = fs::file_time_type::min();
    for (const std::string& file : own_files(project, step)) {
        std::error_code missing;
        const fs::file_time_type saved = fs::last_write_time(project.workshop / step / file, missing);
        if (missing || saved <= when) continue;
        last = file;
        when = saved;
    }
    return last;
}

// --- the picture ------------------------------------------------------------------------------------------------

/// Returns the folder with the picture that the reference makes with the same gaps, which is rendered once; nothing if
/// it makes none, because what is missing is needed for a picture.
std::optional<fs::path> expected_folder(const Session& session, const Headers& cut) {
    const Change change = session.change("expected", cut);
    const fs::path folder = session.tools.work / "expected" /
                            path_of(dependency_key(session.tools, change, program_source(session.step())));
    std::error_code ignored;
    if (fs::exists(folder / (session.step() + ".hdr"), ignored)) return folder;
    const TemporaryFolder scratch(session.tools.work);
    if (const Outcome built = build_step(session.tools, change, scratch.path); !built.compiled)
        throw Error("the reference with these gaps does not compile: " + built.complaint);
    RenderJob job{.root = session.project.root,
                  .step = session.step(),
                  .program = scratch.path / made_program,
                  .references = {},
                  .out = scratch.path / "picture",
                  .samples = Samples::few};
    make_folder(job.out);
    if (render(job)) return std::nullopt;
    make_folder(folder);
    for (const char* const kind : {".png", ".variance.hdr", ".hdr"})
        if (fs::exists(job.out / (session.step() + kind)))
            fs::rename(job.out / (session.step() + kind), folder / (session.step() + kind));
    return folder;
}

/// Renders with the learner's program and compares with the reference, or with what it makes with the same gaps.
void render_mine(const Session& session, Samples samples) {
    const Headers cut = cut_headers(session.project, session.step());
    RenderJob job{.root = session.project.root,
                  .step = session.step(),
                  .program = session.findings.scratch / made_program,
                  .references = reference_folder(session.project.root),
                  .out = session.findings.scratch / "picture",
                  .samples = samples,
                  .flags = own_tree_flags(session.project, session.step())};
    make_folder(job.out);
    PictureFinding& picture = session.findings.picture;
    if (!cut.empty()) {
        const auto expected = expected_folder(session, cut);
        picture = no_picture("functions that are still to write are needed for one");
        if (!expected) return;
        job.references = *expected;
    }
    picture = render_and_compare(job);
    if (!cut.empty() && picture.holds) {
        picture.verdict = "partial"; // the step is not done
        picture.lines = {"the same as the reference makes with the functions that you have written"};
    }
    if (!job.flags.empty()) picture.lines.front() += ", rendered with your bvh.h";
    if (!cut.empty()) picture.complete = true;
    if (cut.empty() && picture.comparison && !picture.holds)
        session.findings.similar_mistakes = similar_mistakes(job);
}

void print_picture(const Session& session) {
    const PictureFinding& picture = session.findings.picture;
    session.screen.line(picture.complete ? "picture" : "preview",
                        joined(picture.lines, "\n") + seconds_text(session.findings),
                        picture.holds ? Colour::green : Colour::red);
}

/// Builds the learner's program, as it is, and renders; a noisy picture with few samples first.
void check_picture(const Session& session) {
    const Change change = session.change("mine", own_headers(session.project, session.step()));
    if (const Outcome built = build_step(session.tools, change, session.findings.scratch); !built.compiled)
        throw CompileFailure{built.log};
    render_mine(session, Samples::few);
}

// --- the checks -------------------------------------------------------------------------------------------------

/// Runs the checks of one step with all of the learner's files, several at a time.
std::vector<CheckedFile> run_step(const Session& session, const std::string& step, const Headers& headers,
                                  const Words& sources) {
    std::vector<CheckedFile> files(sources.size());
    std::atomic<bool> hung = false;
    in_parallel(sources.size(), usable_cores(), [&](std::size_t i) {
        files[i].source = sources[i];
        if (hung) return;
        const Outcome outcome = checked(session.tools, {step, "filled", headers}, sources[i]);
        files[i].results = outcome.results;
        if (outcome.timed_out) hung = true;
    });
    return files;
}

/// Says what broke in the first check that crashed, by a second run with sanitizers.
void explain_crashes(const Session& session, const Headers& headers) {
    for (CheckedFile& file : session.findings.files)
        for (CheckResult& check : file.results) {
            if (check.state != CheckState::unfinished) continue;
            const std::string cause =
                explain_crash(session.tools, session.change("filled", headers), file.source);
            if (!cause.empty()) check.failures.front().values = "crashed: " + cause;
            return;
        }
}

bool has_nan(const CheckResult& check) {
    if (check.state != CheckState::failed || check.failures.empty()) return false;
    std::string values = check.failures.front().values;
    std::ranges::replace_if(
        values, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, ' ');
    return contains(words_in(values), "nan");
}

/// Says which function made the first NaN of the first check that fails with one.
void explain_nans(const Session& session, const Headers& headers) {
    for (CheckedFile& file : session.findings.files)
        for (std::size_t i = 0; i < file.results.size(); ++i) {
            if (!has_nan(file.results[i])) continue;
            const std::string number = std::to_string(i + 1);
            const std::string place = explain_nan(session.tools, session.change("filled", headers),
                                                  file.source, {"--first=" + number, "--last=" + number});
            if (!place.empty()) file.results[i].cause = "The first NaN arose " + place + ".";
            return;
        }
}

/// Says which function made the first NaN of the picture. Only one pixel is rendered again.
void explain_nan_pixel(const Session& session) {
    PictureFinding& picture = session.findings.picture;
    if (!picture.comparison || !picture.comparison->not_a_number) return;
    const compare::NotANumber& pixel = *picture.comparison->not_a_number;
    const std::string x = std::to_string(pixel.x), y = std::to_string(pixel.y),
                      corner = std::to_string(pixel.x + 1) + "," + std::to_string(pixel.y + 1);
    Words flags = words_in(reference_fact(session.project.root, session.step(), "test flags"));
    append(flags, {"--crop", x + "," + y + "," + corner, "--out",
                   text_of(session.findings.scratch / "pixel.hdr"), "--quiet"});
    const Change change = session.change("mine", own_headers(session.project, session.step()));
    const std::string place = explain_nan(session.tools, change, program_source(session.step()), flags);
    if (!place.empty()) picture.lines.push_back("its first NaN arises " + place);
}

void collect_checks(Findings& findings) {
    findings.checks.clear();
    for (const CheckedFile& file : findings.files)
        std::ranges::copy(file.results, std::back_inserter(findings.checks));
}

/// What the known mistakes of a function say to the results that it alone makes.
Diagnosis diagnose_function(const Project& project, const Exercise& exercise,
                            const std::vector<CheckResult>& results) {
    const Words ids = mistakes_in(project.root, exercise);
    std::vector<Signature> known = read_signatures(project.root, exercise.step);
    std::erase_if(known, [&](const Signature& signature) { return !contains(ids, signature.id); });
    return diagnose(known, results);
}

/// Checks a function alone among the reference's. Nothing if it is right, or if it does not compile like that.
std::optional<RedFunction> check_alone(const Session& session, const std::string& name,
                                       const Words& sources) {
    const Change change = session.change(name, isolated_headers(session.project, session.step(), {name}));
    std::vector<CheckResult> results;
    for (const std::string& source : sources) {
        const Outcome outcome = run_source(session.tools, change, source);
        if (!outcome.compiled) return std::nullopt;
        append(results, outcome.results);
    }
    const auto failing = int(std::ranges::count_if(results, has_failed));
    if (failing == 0) return std::nullopt;
    const Exercise& exercise = gap_named(session.findings, name).exercise;
    return RedFunction{name, failing, diagnose_function(session.project, exercise, results)};
}

/// Finds out which of the written functions are wrong.
void find_red(const Session& session) {
    Findings& findings = session.findings;
    Words sources;
    for (const CheckedFile& file : findings.files)
        if (std::ranges::any_of(file.results, has_failed)) sources.push_back(file.source);
    if (sources.empty()) return;
    const Words written = names_in(findings, GapState::written);
    std::vector<std::optional<RedFunction>> alone(written.size());
    in_parallel(written.size(), usable_cores(),
                [&](std::size_t i) { alone[i] = check_alone(session, written[i], sources); });
    for (const auto& red : alone)
        if (red) findings.red.push_back(*red);
    const std::string last = saved_last(session.project, session.step());
    std::stable_partition(findings.red.begin(), findings.red.end(), [&](const RedFunction& red) {
        return gap_named(findings, red.name).exercise.file == last;
    });
}

/// Runs the checks of those earlier steps in which the learner has files.
void check_earlier(const Session& session, const Headers& headers) {
    for (const std::string& step : all_steps(session.project)) {
        if (step >= session.step()) break;
        if (own_files(session.project, step).empty()) continue;
        EarlierStep earlier{.step = step, .passed = 0, .failed = 0, .first = {}};
        for (const CheckedFile& file : run_step(session, step, headers, quick_sources(session.project, step)))
            for (const CheckResult& check : file.results) {
                if (has_failed(check) && earlier.failed++ == 0) earlier.first = check.name;
                earlier.passed += !has_failed(check);
            }
        session.findings.earlier.push_back(earlier);
    }
}

// --- the screen -------------------------------------------------------------------------------------------------

std::size_t failures(const std::vector<CheckResult>& checks) {
    return std::size_t(std::ranges::count_if(checks, has_failed));
}

bool has_hung(const Findings& findings) {
    return std::ranges::find(findings.checks, CheckState::endless, &CheckResult::state) !=
           findings.checks.end();
}

std::string passed_text(const std::vector<CheckResult>& checks) {
    return part_of(checks.size() - failures(checks), checks.size()) + " pass";
}

void print_functions(const Session& session) {
    const Findings& findings = session.findings;
    Words done, red;
    for (const std::string& name : names_in(findings, GapState::written))
        if (is_red(findings, name))
            red.push_back(name + " (" + gap_named(findings, name).place + ")");
        else
            done.push_back(name);
    const bool unclear = findings.red.empty() && failures(findings.checks) > 0;
    if (!done.empty())
        session.screen.line(unclear ? "yours" : "done", joined(done, ", "),
                            unclear ? Colour::none : Colour::green);
    const std::vector<Milestone> milestones = read_milestones(session.project.root, session.step());
    if (const std::string text = milestone_text(milestones, done); !unclear && !text.empty())
        session.screen.line("milestone", text, Colour::green);
    if (!red.empty()) session.screen.line("wrong", joined(red, ", "), Colour::red);
    const Words unwritten = names_in(findings, GapState::unwritten);
    if (!unwritten.empty()) session.screen.line("to write", joined(unwritten, ", "), Colour::grey);
}

/// Prints what a failing check found: the values, and its last note, which explains them.
void print_failure(const Session& session, const CheckResult& check) {
    session.screen.line("failed", check.name, Colour::red);
    if (check.failures.empty()) return;
    const Failure& failure = check.failures.front();
    session.screen.line("", four_digits(failure.values));
    const std::string note = failure.notes.empty() ? "" : failure.notes.back();
    const bool repeats =
        note.starts_with("got ") && note.find(": ") == note.npos; // the value again, unexplained
    if (!note.empty() && !repeats) session.screen.line("", four_digits(note));
    if (!check.cause.empty()) session.screen.line("", check.cause);
}

void print_checks(const Session& session) {
    const Findings& findings = session.findings;
    const std::size_t failed = failures(findings.checks);
    const std::string others = findings.complete ? "" : "; the step's other checks run when these pass";
    session.screen.line("checks", passed_text(findings.checks) + others + seconds_text(findings),
                        failed == 0 ? Colour::green : Colour::red);
    std::size_t printed = 0;
    for (const CheckResult& check : findings.checks)
        if (has_failed(check) && printed++ < 2) print_failure(session, check);
    if (printed > 2)
        session.screen.line("", "... and " + std::to_string(printed - 2) + " more, in the report");
}

/// The functions in which an endless check may hang: those with a loop or a recursion, or else all that are written.
Words suspects(const Session& session) {
    Words all, loops;
    for (const std::string& name : names_in(session.findings, GapState::written)) {
        const Gap& gap = gap_named(session.findings, name);
        all.push_back(name + " (" + gap.place + ")");
        const fs::path own = session.project.workshop / session.step() / gap.exercise.file;
        if (may_not_end(gap.exercise, read_file(text_of(own)))) loops.push_back(all.back());
    }
    return loops.empty() ? all : loops;
}

/// Prints what is known about each function that is wrong.
void print_mistakes(const Session& session) {
    Findings& findings = session.findings;
    const std::vector<Mistake> catalogue = read_catalogue(session.project.root, session.step());
    for (RedFunction& red : findings.red) {
        if (red.diagnosis.endless)
            red.diagnosis.suspects = {red.name + " (" + gap_named(findings, red.name).place + ")"};
        std::string text = explanation(red.diagnosis, catalogue);
        if (red.diagnosis.ids.empty() && !red.diagnosis.endless)
            text = "something in " + red.name + "; none of the known mistakes gives these values";
        if (findings.red.size() > 1 && !red.diagnosis.ids.empty())
            text = red.name + ": " + text + "This explains " + std::to_string(red.failing) +
                   " of the failing checks.";
        session.screen.line("mistake", text, Colour::yellow);
        for (const Mistake& mistake : catalogue)
            if (!findings.mistake && !red.diagnosis.ids.empty() && mistake.id == red.diagnosis.ids.front()) {
                findings.mistake = mistake;
                findings.confidence = name_of(red.diagnosis.confidence);
            }
    }
    const bool named = findings.mistake.has_value();
    for (const Mistake& mistake : catalogue)
        if (!named && findings.similar_mistakes == Words{mistake.id})
            session.screen.line("mistake", "the picture looks like a known mistake: " + mistake.title,
                                Colour::yellow);
    if (findings.red.empty() && failures(findings.checks) > 0) {
        const bool earlier =
            std::ranges::any_of(findings.earlier, [](const EarlierStep& e) { return e.failed > 0; });
        const auto endless = std::ranges::find(findings.checks, CheckState::endless, &CheckResult::state);
        session.screen.line("mistake",
                            earlier ? "in an earlier step, whose functions this one uses"
                            : endless != findings.checks.end()
                                ? "a check does not end. Look for a loop or a recursion in " +
                                      joined(suspects(session), ", ")
                                : "each function is right alone, but not together with your others",
                            Colour::yellow);
    }
}

void print_earlier(const Session& session) {
    Words right;
    for (const EarlierStep& earlier : session.findings.earlier) {
        if (earlier.failed == 0)
            right.push_back(number_of(earlier.step));
        else
            session.screen.line("earlier",
                                earlier.step + ": " + std::to_string(earlier.failed) +
                                    " checks fail, first: " + earlier.first,
                                Colour::red);
    }
    if (!right.empty())
        session.screen.line("earlier", "your files of " + joined(right, ", ") + " pass their checks",
                            Colour::green);
}

// --- what to do next --------------------------------------------------------------------------------------------

std::string next_step_after(const Project& project, const std::string& step) {
    const Words steps = all_steps(project);
    const auto place = std::ranges::find(steps, step);
    return place + 1 < steps.end() ? *(place + 1) : "";
}

bool all_hold(const Findings& findings) {
    return failures(findings.checks) == 0 && findings.picture.holds &&
           names_in(findings, GapState::unwritten).empty() &&
           std::ranges::none_of(findings.earlier,
                                [](const EarlierStep& earlier) { return earlier.failed > 0; });
}

std::string next_command(const Session& session) {
    const Findings& findings = session.findings;
    const std::string number = number_of(session.step());
    for (const EarlierStep& earlier : findings.earlier)
        if (earlier.failed > 0) return "./learn check " + number_of(earlier.step);
    if (own_files(session.project, session.step()).empty()) return "./learn start " + number;
    if (!findings.red.empty()) return "./learn hint " + number + " " + findings.red.front().name;
    const Words written = names_in(findings, GapState::written);
    if (failures(findings.checks) > 0 || !findings.picture.holds)
        return "./learn hint " + number + (written.size() == 1 ? " " + written[0] : "");
    const Words unwritten = names_in(findings, GapState::unwritten);
    if (!unwritten.empty()) return "./learn hint " + number + " " + unwritten.front();
    const std::string following = next_step_after(session.project, session.step());
    return following.empty() ? "./learn course" : "./learn start " + number_of(following);
}

void print_next(const Session& session) {
    const Findings& findings = session.findings;
    const Words unwritten = names_in(findings, GapState::unwritten);
    const bool continues = findings.red.empty() && failures(findings.checks) == 0 && findings.picture.holds;
    std::string text = findings.next;
    if (continues && !unwritten.empty() && text.find(" hint ") != text.npos) {
        const Gap& gap = gap_named(findings, unwritten.front());
        text = "write " + gap.exercise.name + " in " + gap.place + ": " + gap.exercise.task + "\n" + text;
    }
    session.screen.line("next", text, Colour::bold);
}

/// Celebrates a step that holds, with its picture, which is kept beside the report.
void print_done(const Session& session) {
    const Findings& findings = session.findings;
    if (!all_hold(findings) || own_files(session.project, session.step()).empty()) return;
    const bool last = next_step_after(session.project, session.step()).empty();
    std::string text = "Step " + number_of(session.step()) +
                       (last ? " is done: you have written a path tracer." : " is done.");
    if (!findings.picture.mine.empty()) {
        const fs::path kept = session.project.workshop / "report" / (session.step() + ".png");
        const std::string png = read_file(text_of(findings.picture.mine));
        make_folder(kept.parent_path());
        write_file(text_of(kept), png);
        session.screen.picture(png);
        text += " Your picture: " + display_path(kept);
    }
    session.screen.line("well done", text, Colour::green);
}

/// Says what the learner may have overlooked.
void print_notes(const Session& session) {
    const std::string folder = display_path(session.project.workshop / session.step());
    for (const fs::path& entry : entries_of(session.project.workshop / session.step())) {
        const std::string file = text_of(entry.filename());
        std::error_code ignored;
        if (file.starts_with('.') || file.ends_with('~') || entry.extension() == ".h") continue;
        session.screen.line("note", folder + "/" + file + " is not used: only headers of the step are",
                            Colour::yellow);
    }
    const auto checks = read_checks(session.project);
    const auto last = checks.find(session.step());
    if (last != checks.end() && last->second.fingerprint == fingerprint(session.project, session.step()))
        session.screen.line("note", "no file has changed since the last check", Colour::grey);
}

/// Says what differs between the reference's files and what the learner may expect of them.
void print_reference_notes(const Session& session) {
    const std::string folder = display_path(session.project.workshop / session.step());
    for (const std::string& file : edited_references(session.project, session.step()))
        session.screen.line("note", file + " is the reference, but it is edited; yours are in " + folder,
                            Colour::yellow);
    for (const std::string& file : outdated_files(session.project, session.step()))
        session.screen.line("note",
                            "the given part of " + folder + "/" + file +
                                " has changed in the reference; to merge that: ./learn start " +
                                number_of(session.step()) + " --merge",
                            Colour::yellow);
}

/// The exercise that contains the line of a compile error in the learner's file.
const Gap* gap_at(const Findings& findings, const CompileError& error) {
    const Gap* nearest = nullptr;
    for (const Gap& gap : findings.gaps) {
        const std::size_t colon = gap.place.rfind(':');
        if (colon == gap.place.npos || !error.file.ends_with(gap.place.substr(0, colon))) continue;
        const int line = std::atoi(gap.place.c_str() + colon + 1);
        if (line <= error.line + 3) nearest = &gap; // an error may be reported before the gap
    }
    return nearest;
}

void print_compile_error(const Session& session, const std::string& log) {
    Findings& findings = session.findings;
    const auto help = compile_help(log, "workshop/");
    if (!help) throw Error("the compiler failed without an error in a source file; it says: " + log);
    const std::string place = help->error.file + ":" + std::to_string(help->error.line);
    session.screen.line("error", place + ": " + help->error.message, Colour::red);
    for (const std::string& line : help->source) session.screen.code(line);
    if (!help->remedy.empty()) session.screen.line("", help->remedy);
    findings.picture = no_picture("your code does not compile yet");
    findings.picture.lines = {place + ": " + help->error.message};
    const Gap* const gap = gap_at(findings, help->error);
    if (gap != nullptr) session.screen.line("", "in " + gap->exercise.name);
    findings.next = "correct this line, save, and run ./learn check " + number_of(session.step());
    session.screen.line("next", findings.next, Colour::bold);
}

/// Runs what the learner waits for first: the checks of the file that was saved last, and the picture beside them.
void check_saved_file(const Session& session, const Headers& headers) {
    Findings& findings = session.findings;
    const std::string last = saved_last(session.project, session.step());
    const std::string source = check_source(session.step(), check_file_of(session.step(), last));
    std::error_code ignored;
    const bool has_checks = !last.empty() && fs::exists(session.project.root / source, ignored);
    in_parallel(2, 2, [&](std::size_t task) {
        if (task == 1 && session.options.picture) check_picture(session);
        if (task != 0 || !has_checks) return;
        findings.files = {
            {source, checked(session.tools, session.change("filled", headers), source).results}};
        const std::vector<CheckResult>& results = findings.files[0].results;
        session.screen.line("saved", last + ", its checks: " + passed_text(results) + seconds_text(findings),
                            failures(results) == 0 ? Colour::green : Colour::red);
    });
    if (!session.options.picture) return;
    explain_nan_pixel(session);
    print_picture(session);
}

/// Runs the other checks of the step and those of the earlier steps; they wait until those of the saved file pass.
void check_others(const Session& session, const Headers& headers) {
    Findings& findings = session.findings;
    collect_checks(findings);
    findings.complete = failures(findings.checks) == 0;
    if (!findings.complete) return;
    findings.files =
        run_step(session, session.step(), headers, quick_sources(session.project, session.step()));
    check_earlier(session, headers);
}

void check_all(const Session& session) {
    Findings& findings = session.findings;
    if (!session.options.picture) findings.picture = no_picture("not rendered (--no-picture)");
    const Headers headers = filled_headers(session.project, session.step());
    check_saved_file(session, headers);
    check_others(session, headers);
    explain_crashes(session, headers);
    explain_nans(session, headers);
    collect_checks(findings);
    if (findings.complete && !findings.picture.complete) {
        render_mine(session, Samples::all);
        print_picture(session);
    }
    if (!has_hung(findings)) find_red(session); // one check that hangs is enough to wait for
    const bool may_be_earlier = findings.red.empty() && failures(findings.checks) > 0;
    if (may_be_earlier && findings.earlier.empty()) check_earlier(session, headers);
    print_functions(session);
    print_checks(session);
    print_earlier(session);
    print_mistakes(session);
    findings.next = next_command(session);
    print_done(session);
    print_next(session);
}

/// A step that has just been started needs no compiler.
void greet(const Session& session) {
    Findings& findings = session.findings;
    findings.picture = no_picture("nothing is written yet");
    print_functions(session);
    findings.next = next_command(session);
    print_next(session);
}

/// Builds once what all checks are linked with, and says so, since it takes a while.
Toolchain ready_toolchain(const Project& project, const CheckOptions& options, Screen& screen) {
    const Preset preset{project.root, text_of(options.build.filename())};
    std::error_code ignored;
    const fs::path work = options.build / "check";
    const Words targets = targets_for(options.step);
    if (!fs::exists(work, ignored) || !fs::exists(options.build / ("lib" + targets.back() + ".a"), ignored))
        screen.line("once", "building what the checks need: libraries and precompiled headers", Colour::grey);
    if (options.build == preset.folder()) make(preset, targets, true);
    make_folder(work);
    const Toolchain tools = read_toolchain(project.root, options.build, work, Strictness::learner);
    precompile_headers(tools, options.step);
    return tools;
}

} // namespace

int check_step(const Project& project, const CheckOptions& options, std::ostream& out) {
    Screen screen(out, options.colour, options.width);
    Findings findings;
    findings.gaps = gaps_of(project, options.step);
    screen.title("Step " + number_of(options.step) + ": " + question_of(project, options.step));
    const bool started = !own_files(project, options.step).empty();
    if (!started)
        screen.line("note",
                    "You have no files in workshop/" + options.step + ", so this checks the reference.");
    const bool blank = started && names_in(findings, GapState::written).empty() &&
                       !names_in(findings, GapState::unwritten).empty();
    const Toolchain tools = blank ? Toolchain() : ready_toolchain(project, options, screen);
    const TemporaryFolder scratch(options.build);
    findings.scratch = scratch.path;
    const Session session{project, options, tools, screen, findings};
    print_notes(session);
    if (started) print_reference_notes(session);
    bool compiles = true;
    try {
        blank ? greet(session) : check_all(session);
    } catch (const CompileFailure& failure) {
        compiles = false;
        print_compile_error(session, failure.log);
    }
    const fs::path report = write_report(project, options, findings);
    const int failed = int(failures(findings.checks));
    write_check(project, options.step,
                {int(findings.checks.size()) - failed, failed, findings.picture.verdict,
                 fingerprint(project, options.step)});
    screen.line("report", display_path(report), Colour::grey);
    if (options.open && !open_page(report))
        screen.line("note", "there is no program here that opens a page (xdg-open or open); open it yourself",
                    Colour::yellow);
    return compiles && !blank && all_hold(findings) ? 0 : 1;
}

} // namespace rt::tutor
