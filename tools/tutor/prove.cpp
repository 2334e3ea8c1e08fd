// prove: shows that the checks work.
// Every stub must fail, every mistake must fail in a way that identifies it, every right variant must pass, and every
// milestone must change the picture.
#include "tools/compare/comparison.h"
#include "common/util/report_error.h"
#include "common/util/cores.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/util/json.h"
#include "common/util/version.h"
#include "tools/tutor/catalogue.h"
#include "tools/tutor/exercises.h"
#include "tools/tutor/util.h"
#include "tools/tutor/milestones.h"
#include "tools/tutor/proof.h"
#include "tools/tutor/prove_milestones.h"
#include "tools/tutor/record.h"
#include "tools/tutor/workshop.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>

namespace rt::tutor {

namespace {

namespace fs = std::filesystem;

struct ProveOptions {
    std::string root, build, json, step;
    int jobs = 0;
    bool no_pictures = false;
    bool write = false;
    bool fresh = false;
    bool changed = false;
};

/// A change to try, and its outcome.
struct Trial {
    Change change;
    const Mistake* mistake = nullptr;     ///< nullptr if it is none
    std::vector<const Variant*> variants; ///< right ones of different functions, tried together
    Outcome outcome;
    bool picture = false, differs = false;
    Words complaints; ///< one for each variant that is not green
};

/// The numbers of a step for the table and the JSON.
struct Count {
    std::string step;
    int stubs = 0, stubs_failing = 0, mistakes = 0, caught = 0, named_first = 0, named_in_group = 0,
        pictures = 0;
    int still_first = 0, differing = 0;
    int taken_for_another = 0; ///< named as another mistake if their own signature is not known
    int variants = 0, green = 0;
    int milestones = 0, reached = 0;

    void add(const Count& other) {
        stubs += other.stubs, stubs_failing += other.stubs_failing, mistakes += other.mistakes;
        caught += other.caught, named_first += other.named_first, named_in_group += other.named_in_group;
        pictures += other.pictures, still_first += other.still_first, differing += other.differing;
        taken_for_another += other.taken_for_another;
        variants += other.variants, green += other.green;
        milestones += other.milestones, reached += other.reached;
    }
    bool proved() const {
        return stubs_failing == stubs && caught == mistakes && named_in_group == mistakes &&
               green == variants && reached == milestones;
    }
};

/// All trials of a step: the reference, then its stubs, its mistakes and its right variants.
struct StepProof {
    std::string step;
    std::vector<Mistake> mistakes;
    std::vector<Variant> variants;
    std::vector<Trial> trials;
    Words milestones; ///< one complaint for each milestone that is not true
    Words complaints;
};

void add_stubs(const fs::path& root, StepProof& proof) {
    std::map<std::string, std::vector<Exercise>> by_file;
    const auto text = [&](const std::string& file) { return read_file(text_of(root / "steps" / file)); };
    for (const Exercise& exercise : find_step_exercises(root / "steps", proof.step)) {
        const std::string file = exercise.step + "/" + exercise.file;
        by_file[file].push_back(exercise);
        proof.trials.push_back(
            {.change = {proof.step, "stub-" + exercise.name, {{file, make_stub(text(file), {exercise})}}},
             .outcome = {}});
    }
    Change all{proof.step, "stub-all", {}};
    for (const auto& [file, exercises] : by_file) all.headers[file] = make_stub(text(file), exercises);
    proof.trials.push_back({.change = all, .outcome = {}});
}

/// Returns the reference with these variants applied.
Change with_variants(const fs::path& root, const std::vector<const Variant*>& variants) {
    Change change{variants[0]->step, "variant-" + variants[0]->id, {}};
    for (const Variant* variant : variants) {
        std::string& header = change.headers[variant->file];
        if (header.empty()) header = read_file(text_of(root / "steps" / variant->file));
        header = with_patch(*variant, header);
    }
    return change;
}

/// Adds the variants, each with those of other functions: the first ones of all functions together, then the second
/// ones.
void add_variants(const fs::path& root, StepProof& proof) {
    std::map<std::string, std::size_t> so_far;
    std::vector<std::vector<const Variant*>> groups;
    for (const Variant& variant : proof.variants) {
        const std::size_t index = so_far[variant.file + function_of(root, variant)]++;
        if (index == groups.size()) groups.emplace_back();
        groups[index].push_back(&variant);
    }
    for (const auto& group : groups)
        proof.trials.push_back({.change = with_variants(root, group), .variants = group, .outcome = {}});
}

StepProof plan(const fs::path& root, const std::string& step) {
    StepProof proof{step, read_catalogue(root, step), read_variants(root, step), {}, {}};
    proof.trials.push_back({.change = {step, "reference", {}}, .outcome = {}});
    add_stubs(root, proof);
    const auto change = [&](const Patch& patch) {
        const std::string header = read_file(text_of(root / "steps" / patch.file));
        return Change{step, patch.id, {{patch.file, with_patch(patch, header)}}};
    };
    for (const Mistake& mistake : proof.mistakes)
        proof.trials.push_back({.change = change(mistake), .mistake = &mistake, .outcome = {}});
    add_variants(root, proof);
    return proof;
}

bool fails(const Outcome& outcome) {
    return std::ranges::any_of(outcome.results, has_failed);
}

fs::path picture_path(const Toolchain& tools, const Change& change) {
    return tools.work / "pictures" / change.step / (change.id + ".png");
}

/// Returns what is red with the change, which should be right; empty if nothing is.
std::string complaint_about(const Toolchain& tools, const Change& change, bool pictures) {
    const Outcome outcome = run_checks(tools, change);
    if (!outcome.compiled) return "does not compile: " + outcome.complaint;
    if (outcome.timed_out) return "does not finish";
    for (const CheckResult& result : outcome.results) {
        if (!has_failed(result)) continue;
        if (result.failures.empty()) return "fails: " + result.name;
        const Failure& failure = result.failures.back();
        return "fails: " + result.name + ": " +
               (failure.notes.empty() ? failure.values : failure.notes.back());
    }
    if (!pictures) return "";
    const std::string complaint =
        picture_complaint(tools, change, tools.work / "variants" / change.step / change.id);
    return complaint.empty() ? "" : "has another picture: " + complaint;
}

/// Tries the variants together. Only if they are red, each alone, to say which one it is.
void try_variants(const Toolchain& tools, Trial& trial, bool pictures) {
    if (complaint_about(tools, trial.change, pictures).empty()) return;
    for (const Variant* variant : trial.variants)
        if (const std::string complaint =
                complaint_about(tools, with_variants(tools.root, {variant}), pictures);
            !complaint.empty())
            trial.complaints.push_back("the right variant " + variant->id + " " + complaint);
}

void try_out(const Toolchain& tools, Trial& trial, bool pictures) {
    if (!trial.variants.empty()) return try_variants(tools, trial, pictures);
    trial.outcome = run_checks(tools, trial.change);
    const bool stub = trial.mistake == nullptr && !trial.change.headers.empty();
    if (pictures && !stub && trial.outcome.compiled)
        trial.picture = render_picture(tools, trial.change, picture_path(tools, trial.change));
}

/// Returns whether two pictures differ by more than rounding.
bool differ(const std::string& step, const fs::path& right, const fs::path& wrong) {
    if (!fs::exists(right) || !fs::exists(wrong)) return true;
    compare::ComparisonInput input{compare::read_encoded(text_of(wrong)),
                                   compare::read_encoded(text_of(right))};
    input.step = std::atoi(step.c_str());
    return !compare::is_same(compare::compare_images(input).verdict);
}

/// Returns the signature without every third assertion: another learner's version of the mistake
/// may pass them.
Signature without_every_third(const Signature& signature) {
    Signature thin{signature.id, {}};
    for (std::size_t i = 0; i < signature.assertions.size(); ++i)
        if (i % 3 != 1) thin.assertions.push_back(signature.assertions[i]);
    return thin;
}

/// Returns the mistakes whose signatures fit best; several if they fit equally well.
Words best_matches(const std::vector<Signature>& known, const Signature& seen) {
    Words ids;
    const std::vector<SignatureMatch> matches = rank_signatures(known, seen);
    for (const SignatureMatch& match : matches)
        if (match.score > matches[0].score - 1e-9) ids.push_back(match.id);
    return ids;
}

void judge_reference(const Trial& trial, StepProof& proof) {
    if (!trial.outcome.compiled)
        throw Error(proof.step + ": the reference does not compile: " + trial.outcome.complaint);
    for (const CheckResult& result : trial.outcome.results)
        if (has_failed(result)) throw Error(proof.step + ": the reference itself fails: " + result.name);
}

void judge_stub(const Trial& trial, Count& count, StepProof& proof) {
    ++count.stubs;
    if (!trial.outcome.compiled)
        proof.complaints.push_back(trial.change.id + " does not compile: " + trial.outcome.complaint);
    else if (trial.outcome.timed_out)
        proof.complaints.push_back(trial.change.id + " does not finish");
    else if (!fails(trial.outcome))
        proof.complaints.push_back(trial.change.id + " passes all checks");
    else
        ++count.stubs_failing;
}

void judge_picture(const Trial& trial, Count& count, StepProof& proof) {
    if (!trial.picture) return;
    ++count.pictures;
    count.differing += trial.differs;
    const bool says_nothing = trial.mistake->shows.starts_with("nothing");
    if (says_nothing && trial.differs)
        proof.complaints.push_back(trial.change.id +
                                   " changes the picture, but its 'Shows' says it does not");
    if (!says_nothing && !trial.differs)
        proof.complaints.push_back(trial.change.id + " changes no pixel, but its 'Shows' says it does");
}

/// Of each mistake, the mistakes of the same function: the names that ./learn check would consider.
std::map<std::string, Words> rivals_of(const fs::path& root, const std::string& step) {
    std::map<std::string, Words> rivals;
    for (const Exercise& exercise : find_step_exercises(root / "steps", step)) {
        const Words ids = mistakes_in(root, exercise);
        for (const std::string& id : ids) rivals[id] = ids;
    }
    return rivals;
}

/// Returns whether the mistake gets the name of another if nobody has recorded its own signature.
bool is_taken_for_another(const Trial& trial, const std::vector<Signature>& known, const Words& rivals) {
    std::vector<Signature> others = known;
    std::erase_if(others, [&](const Signature& signature) {
        return signature.id == trial.change.id || !contains(rivals, signature.id);
    });
    return !diagnose(others, trial.outcome.results).ids.empty();
}

void judge_name(const Trial& trial, const std::vector<Signature>& known, Count& count, StepProof& proof) {
    const Signature seen = signature_of(trial.change.id, trial.outcome.results);
    const Words best = best_matches(known, seen);
    const bool named = contains(best, seen.id);
    count.named_in_group += named;
    count.named_first += named && best.size() == 1;
    count.still_first += best_matches(known, without_every_third(seen)) == Words{seen.id};
    if (!named)
        proof.complaints.push_back(seen.id + " is mistaken for " + joined(best, " ") +
                                   " (./learn prove --write updates the signatures)");
    else if (best.size() > 1)
        proof.complaints.push_back(seen.id + ": the checks cannot tell these apart: " + joined(best, " "));
}

void judge_mistake(const Trial& trial, const std::vector<Signature>& known, Count& count, StepProof& proof) {
    ++count.mistakes;
    judge_picture(trial, count, proof);
    if (!trial.outcome.compiled) {
        proof.complaints.push_back(trial.change.id + " does not compile: " + trial.outcome.complaint);
    } else if (!fails(trial.outcome)) {
        proof.complaints.push_back(trial.change.id + " is not caught");
    } else {
        ++count.caught;
        judge_name(trial, known, count, proof);
    }
}

void judge_variants(const Trial& trial, Count& count, StepProof& proof) {
    count.variants += int(trial.variants.size());
    count.green += int(trial.variants.size() - trial.complaints.size());
    proof.complaints.insert(proof.complaints.end(), trial.complaints.begin(), trial.complaints.end());
}

/// Writes the pictures in which a mistake's effect is easier to see.
void write_closer_pictures(const Toolchain& tools, const Trial& trial, StepProof& proof) {
    const Mistake& mistake = *trial.mistake;
    const fs::path right = closer_right_picture(tools.root, proof.step, mistake.id),
                   wrong = closer_picture(tools.root, proof.step, mistake.id);
    fs::create_directories(right.parent_path());
    const auto write = [&](const Change& change, const fs::path& picture) {
        const fs::path made = tools.work / "pictures" / proof.step / "closer" / picture.filename();
        if (!render_picture(tools, change, made, mistake.closer))
            throw Error(mistake.place + ": no picture with " + joined(mistake.closer, " "));
        fs::copy_file(made, picture, fs::copy_options::overwrite_existing);
    };
    write(proof.trials[0].change, right);
    write(trial.change, wrong);
    if (!differ(proof.step, right, wrong))
        proof.complaints.push_back(mistake.id + " is not seen with " + joined(mistake.closer, " "));
}

/// Writes the pictures of the gallery: the correct one, and one for each mistake that changes the picture.
void write_gallery(const Toolchain& tools, StepProof& proof) {
    const fs::path right = gallery_picture(tools.root, proof.step, "right");
    fs::remove_all(right.parent_path());
    fs::create_directories(right.parent_path());
    fs::copy_file(picture_path(tools, proof.trials[0].change), right);
    for (const Trial& trial : proof.trials)
        if (trial.mistake != nullptr && trial.picture && trial.differs)
            fs::copy_file(picture_path(tools, trial.change),
                          gallery_picture(tools.root, proof.step, trial.change.id));
    for (const Trial& trial : proof.trials)
        if (trial.mistake != nullptr && !trial.mistake->closer.empty())
            write_closer_pictures(tools, trial, proof);
}

std::vector<Signature> signatures_of(const StepProof& proof) {
    std::vector<Signature> signatures;
    for (const Trial& trial : proof.trials)
        if (trial.mistake != nullptr)
            signatures.push_back(signature_of(trial.change.id, trial.outcome.results));
    return signatures;
}

Count judge(const Toolchain& tools, StepProof& proof, bool write) {
    const std::string path = "exercises/" + proof.step + "/signatures.txt";
    if (write) write_file(text_of(tools.root / path), signatures_text(proof.step, signatures_of(proof)));
    const std::vector<Signature> known = read_signatures(tools.root, proof.step);
    const fs::path right = picture_path(tools, proof.trials[0].change);
    Count count{.step = proof.step};
    judge_reference(proof.trials[0], proof);
    const std::map<std::string, Words> rivals = rivals_of(tools.root, proof.step);
    for (std::size_t i = 1; i < proof.trials.size(); ++i) {
        Trial& trial = proof.trials[i];
        if (const auto own = rivals.find(trial.change.id); own != rivals.end())
            count.taken_for_another += is_taken_for_another(trial, known, own->second);
        trial.differs = trial.picture && differ(proof.step, right, picture_path(tools, trial.change));
        if (!trial.variants.empty())
            judge_variants(trial, count, proof);
        else if (trial.mistake == nullptr)
            judge_stub(trial, count, proof);
        else
            judge_mistake(trial, known, count, proof);
    }
    if (proof.trials[0].picture) { // milestones are pictures
        count.milestones = int(read_milestones(tools.root, proof.step).size());
        count.reached = count.milestones - int(proof.milestones.size());
        append(proof.complaints, proof.milestones);
    }
    if (write && proof.trials[0].picture) write_gallery(tools, proof);
    return count;
}

Json json(const Count& count) {
    return {{"step", count.step},
            {"stubs", count.stubs},
            {"stubs_failing", count.stubs_failing},
            {"mistakes", count.mistakes},
            {"caught", count.caught},
            {"named_first", count.named_first},
            {"named_in_group", count.named_in_group},
            {"pictures", count.pictures},
            {"variants", count.variants},
            {"variants_green", count.green},
            {"milestones", count.milestones},
            {"milestones_reached", count.reached}};
}

std::string json(const std::vector<Count>& counts, const Count& total) {
    Json all{{"steps", Json::array()}, {"total", json(total)}};
    for (const Count& count : counts) all["steps"].push_back(json(count));
    return json::text(all, 1) + "\n";
}

void print_row(const Count& count) {
    const auto number = [](int value) { return std::to_string(value); };
    const auto part = [](int some, int all) { return part_of(std::size_t(some), std::size_t(all), "/"); };
    std::cout << cell(count.step, -15) << cell(part(count.stubs_failing, count.stubs), 11)
              << cell(part(count.caught, count.mistakes), 10) << cell(number(count.named_first), 13)
              << cell(number(count.named_in_group), 10) << cell(number(count.still_first), 13)
              << cell(number(count.taken_for_another), 12)
              << cell(count.pictures > 0 ? part(count.differing, count.pictures) : "-", 15)
              << cell(part(count.green, count.variants), 16)
              << cell(count.milestones > 0 ? part(count.reached, count.milestones) : "-", 12) << "\n";
}

fs::path record_path(const Toolchain& tools) {
    return tools.root / "exercises" / "proved.txt";
}

void note_key(const Toolchain& tools, const std::string& step) {
    Record record = read_record(record_path(tools));
    record[step] = proof_key(tools, step);
    write_record(record_path(tools),
                 "# For each step whose proof succeeded, a hash of its checks, their includes, its mistakes "
                 "and variants.\n"
                 "# Written by ./learn prove --write, read by ./learn prove --changed.\n",
                 record);
}

std::vector<StepProof> plan_all(const Toolchain& tools, const ProveOptions& options) {
    std::vector<StepProof> proofs;
    Record noted = read_record(record_path(tools));
    const Project project{tools.root, {}};
    for (const std::string& step :
         options.step.empty() ? all_steps(project) : Words{find_step(project, options.step)}) {
        if (options.changed && noted[step] == proof_key(tools, step)) continue;
        precompile_headers(tools, step);
        proofs.push_back(plan(tools.root, step));
    }
    return proofs;
}

void try_all(const Toolchain& tools, std::vector<StepProof>& proofs, const ProveOptions& options) {
    std::vector<Trial*> trials;
    for (StepProof& proof : proofs)
        for (Trial& trial : proof.trials) trials.push_back(&trial);
    in_parallel(trials.size(), options.jobs > 0 ? options.jobs : usable_cores(),
                [&](std::size_t i) { try_out(tools, *trials[i], !options.no_pictures); });
    if (options.no_pictures) return;
    in_parallel(proofs.size(), usable_cores(), [&](std::size_t i) {
        proofs[i].milestones = prove_milestones(tools, proofs[i].step, options.write);
    });
}

bool prove(const ProveOptions& options) {
    const auto begin = std::chrono::steady_clock::now();
    if (options.fresh) fs::remove_all(path_of(options.root) / "build" / "prove");
    const Toolchain tools = read_toolchain(path_of(options.root), path_of(options.build),
                                           path_of(options.root) / "build" / "prove", Strictness::proof);
    if (!options.json.empty()) check_file_writable(options.json);
    std::vector<StepProof> proofs = plan_all(tools, options);
    try_all(tools, proofs, options);
    std::vector<Count> counts;
    Count total{.step = "total"};
    for (StepProof& proof : proofs) {
        counts.push_back(judge(tools, proof, options.write));
        total.add(counts.back());
        if (options.write && counts.back().proved()) note_key(tools, proof.step);
        for (const std::string& complaint : proof.complaints)
            std::cout << proof.step << ": " << complaint << "\n";
    }
    std::cout << "step           stubs fail    caught  named alone  in group   1/3 dropped   left out  wrong "
                 "picture  variants green  milestones\n";
    for (const Count& count : counts) print_row(count);
    print_row(total);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    std::cout << "took " << int(seconds.count() + 0.5) << " s\n";
    if (!options.json.empty()) write_file(options.json, json(counts, total));
    return total.proved();
}

} // namespace

} // namespace rt::tutor

int main(int argc, char** argv) {
    rt::tutor::ProveOptions options;
    CLI::App app(
        "Proves that the checks work: every stub fails, every mistake of the catalogue is caught and "
        "named, and every right variant passes.\n"
        "Exit code: 0 proved, 1 not proved, 2 an error.",
        "prove");
    app.allow_windows_style_options(false); // a path may begin with a slash
    app.set_version_flag("--version", rt::version());
    app.add_option("--json", options.json, "write the counts to this file");
    app.add_option("--step", options.step, "only this step: 3, 03 or 03_mirror");
    app.add_flag("--no-pictures", options.no_pictures, "do not render pictures of the mistakes");
    app.add_flag("--write", options.write,
                 "write exercises/*/signatures.txt and the pictures of the mistakes");
    app.add_flag("--changed", options.changed,
                 "skip the steps that have not changed since they were proved (exercises/proved.txt)");
    app.add_flag("--fresh", options.fresh, "discard cached results and build everything again");
    app.add_option("--jobs", options.jobs, "number of parallel jobs; 0: one per core")
        ->check(CLI::Range(0, 1024));
    app.add_option("--root", options.root, "the project's folder")->required();
    app.add_option("--build", options.build, "the build folder")->required();
    try {
        app.parse(argc, argv);
        return rt::tutor::prove(options) ? 0 : 1;
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& problem) {
        return rt::report_error("prove", problem.what());
    }
}
