// Runs the checks of a step until something fails, and renders small pictures.
#include "tools/tutor/proof.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/catalogue.h"
#include "tools/tutor/check_parts.h"
#include "tools/tutor/milestones.h"
#include "tools/tutor/record.h"
#include "tools/tutor/system.h"
#include "tools/tutor/util.h"

#include <algorithm>
#include <iterator>

namespace rt::tutor {

namespace fs = std::filesystem;

std::string proof_key(const Toolchain& tools, const std::string& step) {
    Hash hash;
    add_sources(tools, check_sources(tools, {.step = step, .id = {}, .headers = {}}), hash);
    const auto add = [&](const Patch& patch) {
        hash.add(patch.id);
        hash.add(patch.file);
        for (const PatchLine& line : patch.lines) hash.add(line.kind + code_only(line.text));
    };
    std::ranges::for_each(read_catalogue(tools.root, step), add);
    std::ranges::for_each(read_variants(tools.root, step), add);
    for (const Milestone& milestone : read_milestones(tools.root, step))
        hash.add(joined(milestone.functions, " ") + joined(milestone.options, " "));
    return hash.text();
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

bool render_picture(const Toolchain& tools, const Change& change, const fs::path& picture,
                    const Words& options) {
    fs::path stamp = picture;
    stamp.replace_extension(".key");
    const std::string key = joined(options, " ") + dependency_key(tools, change, program_source(change.step));
    if (fs::exists(stamp) && read_file(text_of(stamp)) == key) return fs::exists(picture);
    const TemporaryFolder scratch(tools.work);
    const Outcome built = build_step(tools, change, scratch.path);
    if (!built.compiled) throw Error(change.step + " does not compile: " + built.complaint);
    fs::create_directories(picture.parent_path());
    fs::remove(picture);
    Words command{
        text_of(scratch.path / made_program), "--quiet", "--threads", "1", "--out", text_of(picture)};
    append(command, options);
    const Words flags = gallery_flags(tools.root, change.step);
    for (std::size_t i = 0; i < flags.size(); i += 2)
        if (!contains(options, flags[i])) append(command, {flags[i], flags[i + 1]});
    run_process(command, {.log = scratch.path / "log", .cpu_seconds = 30, .seconds = 300});
    write_file(text_of(stamp), key);
    return fs::exists(picture);
}

std::string picture_complaint(const Toolchain& tools, const Change& change, const fs::path& folder) {
    const fs::path stamp = folder / "key";
    const std::string key = dependency_key(tools, change, program_source(change.step));
    RenderJob job{.root = tools.root,
                  .step = change.step,
                  .program = {},
                  .references = reference_folder(tools.root),
                  .out = folder};
    if (!fs::exists(stamp) || read_file(text_of(stamp)) != key) {
        const TemporaryFolder scratch(tools.work);
        const Outcome built = build_step(tools, change, scratch.path);
        if (!built.compiled) return "does not compile: " + built.complaint;
        fs::create_directories(folder);
        job.program = scratch.path / made_program;
        if (const auto reason = render(job)) return *reason;
        write_file(text_of(stamp), key);
    }
    const compare::Comparison comparison = compare_render(job);
    return compare::is_same(comparison.verdict) ? "" : joined(comparison.lines, "; ");
}

} // namespace rt::tutor
