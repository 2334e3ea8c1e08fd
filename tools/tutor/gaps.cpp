// Replaces whole functions in the learner's text by those of the reference.
#include "tools/tutor/gaps.h"

#include "common/util/file_bytes.h"

#include <algorithm>
#include <functional>
#include <optional>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

/// The exercises of one file, its reference and its stub.
struct HeaderExercises {
    std::string name; ///< "03_mirror/mirror.h"
    std::string reference, stub;
    std::vector<Exercise> exercises;
};

HeaderExercises exercises_in(const Project& project, const std::string& step, const std::string& file,
                             const std::vector<Exercise>& of_step) {
    HeaderExercises header{.name = step + "/" + file, .reference = {}, .stub = {}, .exercises = {}};
    std::error_code ignored;
    const fs::path path = steps_folder(project) / step / file;
    if (!fs::is_regular_file(path, ignored)) return header;
    header.reference = read_file(text_of(path));
    for (const Exercise& exercise : of_step)
        if (exercise.file == file) header.exercises.push_back(exercise);
    header.stub = make_stub(header.reference, header.exercises);
    return header;
}

/// Whether the exercise is in these lines of the reference.
bool holds(const LineRange& range, const Exercise& exercise) {
    return int(range.begin) < exercise.line && exercise.line <= int(range.end);
}

/// Where the exercise's function is in the learner's lines: the one that is as it was cut; or, if the file has as many
/// functions of that name as the reference, the one in the same position.
std::optional<LineRange> find_in(const std::string& text, const Exercise& exercise,
                                 const HeaderExercises& header) {
    const std::vector<LineRange> own = functions_named(text, exercise.function),
                                 cut = functions_named(header.stub, exercise.function),
                                 known = functions_named(header.reference, exercise.function);
    const auto here =
        std::ranges::find_if(known, [&](const LineRange& range) { return holds(range, exercise); });
    if (here == known.end() || cut.size() != known.size()) return std::nullopt;
    const auto index = std::size_t(here - known.begin());
    const std::string bare = bare_code(header.stub, cut[index]);
    for (const LineRange& range : own)
        if (bare_code(text, range) == bare) return range;
    if (own.size() == known.size()) return own[index];
    return std::nullopt;
}

std::string line_directive(std::size_t line, const std::string& path) {
    std::string quoted;
    for (const char c : path) quoted += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    return "#line " + std::to_string(line) + " \"" + quoted + "\"";
}

using Choice = std::function<bool(const Exercise&)>;

/// The learner's text, in which the functions that `is_replaced` chooses are the reference's.
std::string with_reference(const Project& project, const std::string& text, const HeaderExercises& header,
                           const Choice& is_replaced) {
    const std::string own_path = display_path(project.workshop / header.name),
                      reference_path = display_path(steps_folder(project) / header.name);
    Words lines = lines_of(text);
    const Words reference = lines_of(header.reference);
    struct Replacement {
        LineRange own, reference;
    };
    std::vector<Replacement> replacements;
    for (const Exercise& exercise : header.exercises) {
        const auto own = find_in(text, exercise, header);
        if (!own || !is_replaced(exercise)) continue;
        for (const LineRange& range : functions_named(header.reference, exercise.function))
            if (holds(range, exercise)) replacements.push_back({*own, range});
    }
    std::ranges::sort(replacements, std::greater(), [](const Replacement& r) { return r.own.begin; });
    for (std::size_t i = 0; i < replacements.size(); ++i) {
        const auto& [own, known] = replacements[i];
        if (i > 0 && own.begin == replacements[i - 1].own.begin) continue; // two regions of one function
        Words part{line_directive(known.begin + 1, reference_path)};
        part.insert(part.end(), reference.begin() + std::ptrdiff_t(known.begin),
                    reference.begin() + std::ptrdiff_t(known.end));
        part.push_back(line_directive(own.end + 1, own_path));
        lines.erase(lines.begin() + std::ptrdiff_t(own.begin), lines.begin() + std::ptrdiff_t(own.end));
        lines.insert(lines.begin() + std::ptrdiff_t(own.begin), part.begin(), part.end());
    }
    return line_directive(1, own_path) + "\n" + joined(lines, "\n") + "\n";
}

GapState state_of(const Project& project, const Exercise& exercise, const std::string& stub) {
    const fs::path own = project.workshop / exercise.step / exercise.file;
    std::error_code ignored;
    if (!fs::is_regular_file(own, ignored)) return GapState::absent;
    return is_untouched(exercise, read_file(text_of(own)), stub) ? GapState::unwritten : GapState::written;
}

std::string own_text(const Project& project, const std::string& header) {
    return read_file(text_of(project.workshop / header));
}

/// Adds the learner's headers of one step; `fill`: with the reference's lines in the gaps.
void add_headers(const Project& project, const std::string& step, bool fill, Headers& headers) {
    const std::vector<Exercise> exercises = exercises_of(project, step);
    for (const std::string& file : own_files(project, step)) {
        const HeaderExercises header = exercises_in(project, step, file, exercises);
        const std::string text = own_text(project, header.name);
        headers[header.name] = with_reference(project, text, header, [&](const Exercise& exercise) {
            return fill && is_untouched(exercise, text, header.stub);
        });
    }
}

Headers headers_up_to(const Project& project, const std::string& step, bool fill) {
    Headers headers;
    for (const std::string& each : all_steps(project))
        if (each <= step) add_headers(project, each, fill, headers);
    return headers;
}

} // namespace

std::vector<Gap> gaps_of(const Project& project, const std::string& step) {
    std::vector<Gap> gaps;
    const std::vector<Exercise> exercises = exercises_of(project, step);
    for (const Exercise& exercise : exercises) {
        const HeaderExercises header = exercises_in(project, step, exercise.file, exercises);
        Gap gap{exercise, state_of(project, exercise, header.stub), {}};
        if (gap.state != GapState::absent)
            gap.place = display_path(project.workshop / header.name,
                                     line_of(exercise, own_text(project, header.name)));
        gaps.push_back(gap);
    }
    return gaps;
}

Words own_tree_flags(const Project& project, const std::string& step, const Words& given) {
    const std::string with_tree = "05_mesh_bvh";
    std::error_code ignored;
    if (step <= with_tree || !fs::is_regular_file(project.workshop / with_tree / "bvh.h", ignored)) return {};
    const auto chooses = [](const std::string& flag) { return flag.starts_with("--accel"); };
    const std::vector<Gap> gaps = gaps_of(project, with_tree);
    const bool complete = std::ranges::find(gaps, GapState::unwritten, &Gap::state) == gaps.end();
    return complete && std::ranges::none_of(given, chooses) ? Words{"--accel", "bvh"} : Words();
}

Headers own_headers(const Project& project, const std::string& step) {
    return headers_up_to(project, step, false);
}

Headers filled_headers(const Project& project, const std::string& step) {
    return headers_up_to(project, step, true);
}

Headers isolated_headers(const Project& project, const std::string& step, const Words& functions) {
    Headers headers;
    const std::vector<Exercise> exercises = exercises_of(project, step);
    for (const std::string& file : own_files(project, step)) {
        const HeaderExercises header = exercises_in(project, step, file, exercises);
        const auto is_kept = [&](const Exercise& exercise) { return contains(functions, exercise.name); };
        if (header.exercises.empty() || std::ranges::any_of(header.exercises, is_kept))
            headers[header.name] = with_reference(project, own_text(project, header.name), header,
                                                  [&](const Exercise& e) { return !is_kept(e); });
    }
    return headers;
}

Headers cut_headers(const Project& project, const std::string& step) {
    Headers headers;
    for (const std::string& each : all_steps(project)) {
        if (each > step) break;
        const std::vector<Exercise> exercises = exercises_of(project, each);
        for (const std::string& file : own_files(project, each)) {
            const HeaderExercises header = exercises_in(project, each, file, exercises);
            std::vector<Exercise> gaps;
            for (const Exercise& exercise : header.exercises)
                if (state_of(project, exercise, header.stub) == GapState::unwritten) gaps.push_back(exercise);
            if (!gaps.empty()) headers[header.name] = make_stub(header.reference, gaps);
        }
    }
    return headers;
}

} // namespace rt::tutor
