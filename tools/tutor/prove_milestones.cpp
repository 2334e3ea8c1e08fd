// Renders the reference with fewer and fewer gaps.
#include "tools/tutor/prove_milestones.h"

#include "common/util/file_bytes.h"
#include "tools/compare/comparison.h"
#include "tools/tutor/milestones.h"
#include "tools/tutor/proof.h"

#include <map>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

/// Returns the reference's headers with a gap in place of each function that is not in `written`.
Headers with_gaps(const fs::path& root, const std::string& step, const Words& written) {
    std::map<std::string, std::vector<Exercise>> gaps;
    for (const Exercise& exercise : find_step_exercises(root / "steps", step))
        if (!contains(written, exercise.name)) gaps[step + "/" + exercise.file].push_back(exercise);
    Headers headers;
    for (const auto& [file, exercises] : gaps)
        headers[file] = make_stub(read_file(text_of(root / "steps" / file)), exercises);
    return headers;
}

bool same_picture(const fs::path& a, const fs::path& b) {
    const compare::Comparison comparison =
        compare::compare_images({compare::read_encoded(text_of(a)), compare::read_encoded(text_of(b))});
    return compare::is_same(comparison.verdict);
}

} // namespace

Words prove_milestones(const Toolchain& tools, const std::string& step, bool write) {
    Words written, complaints;
    const fs::path folder = tools.work / "milestones" / step;
    for (const Milestone& milestone : read_milestones(tools.root, step)) {
        const Change before{step, "before-" + milestone.id, with_gaps(tools.root, step, written)};
        append(written, milestone.functions);
        const Change after{step, milestone.id, with_gaps(tools.root, step, written)};
        const fs::path old_picture = folder / (before.id + ".png"), picture = folder / (after.id + ".png");
        const bool has_old = render_picture(tools, before, old_picture, milestone.options);
        if (!render_picture(tools, after, picture, milestone.options)) {
            complaints.push_back("milestone " + milestone.id + " makes no picture");
            continue;
        }
        const bool says_same = milestone.shows.starts_with("the same picture");
        if (has_old && same_picture(old_picture, picture) != says_same)
            complaints.push_back("milestone " + milestone.id +
                                 (says_same ? " changes the picture" : " does not change the picture"));
        if (!write) continue;
        const fs::path kept = tools.root / milestone_picture(step, milestone.id);
        fs::create_directories(kept.parent_path());
        fs::copy_file(picture, kept, fs::copy_options::overwrite_existing);
    }
    return complaints;
}

} // namespace rt::tutor
