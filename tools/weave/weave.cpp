// Finds the markers in a page and generates the text between them.
#include "tools/weave/weave.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/catalogue.h"
#include "tools/tutor/exercises.h"
#include "tools/tutor/milestones.h"
#include "tools/tutor/record.h"
#include "tools/tutor/util.h"
#include "tools/tutor/diff.h"
#include "tools/weave/pages.h"
#include "tools/weave/region.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

namespace rt::weave {

using namespace tutor;

namespace fs = std::filesystem;

namespace {

constexpr std::array kinds{"listing",    "diff",     "gallery", "milestone",
                           "navigation", "contents", "output",  "measured"};
const std::string opens = "<!-- ", closes = " -->", end_marker = "<!-- end -->";

[[noreturn]] void fail(const std::string& path, std::size_t line, const std::string& what) {
    throw Error(path + ":" + std::to_string(line + 1) + ": " + what);
}

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream in(text);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

std::string read(const fs::path& root, const std::string& file) {
    return without_markers(read_file(text_of(root / file)));
}

std::string without_blank_ends(std::string text) {
    while (text.ends_with("\n\n")) text.pop_back();
    while (text.starts_with("\n")) text.erase(0, 1);
    return text;
}

std::string code_block(const std::string& language, const std::string& code) {
    return "```" + language + '\n' + without_blank_ends(code) + "```\n";
}

/// Returns lines without the indentation that all of them have.
std::string dedented(const Words& lines) {
    std::size_t indent = std::string::npos;
    for (const std::string& line : lines) indent = std::min(indent, line.find_first_not_of(' '));
    std::string text;
    for (const std::string& line : lines) text += line.substr(std::min(indent, line.size())) + "\n";
    return text;
}

/// Returns a listing as a learner finds it, with the gaps, and what belongs there folded below: the question stands
/// before the answer.
std::string folded_listing(const std::string& code, const std::vector<Exercise>& exercises) {
    std::string text = code_block("cpp", make_stub(code, exercises));
    for (const Exercise& exercise : exercises)
        text += "\n<details><summary>The lines of <code>" + exercise.function +
                "</code>, after you have tried</summary>\n\n" +
                code_block("cpp", dedented(exercise.reference)) + "\n</details>\n";
    return text;
}

std::string listing(const fs::path& root, const std::string& what) {
    const std::size_t hash = what.find('#');
    const std::string file = what.substr(0, hash), whole = read_file(text_of(root / file));
    const std::string code = hash == std::string::npos ? whole : region(whole, what.substr(hash + 1), file);
    if (file.ends_with(".sh")) return code_block("sh", code);
    const std::vector<Exercise> exercises = find_exercises(code, file);
    return exercises.empty() ? code_block("cpp", code) : folded_listing(code, exercises);
}

std::string diff(const fs::path& root, const std::string& what) {
    const auto files = words_of(what);
    if (files.size() != 2) throw Error("diff: expected two files, not \"" + what + "\"");
    const std::string text =
        unified_diff({files[0], read(root, files[0])}, {files[1], read(root, files[1])}, false);
    if (text.empty()) throw Error("diff: " + files[0] + " and " + files[1] + " are equal");
    return "```diff\n" + text + "```\n";
}

/// Capitalises the text, unless it begins with a formula ("d.n is negative"), and adds a full stop.
std::string sentence(std::string text) {
    const auto is_small = [](char c) { return c >= 'a' && c <= 'z'; };
    const std::string word = text.substr(0, text.find_first_of(" ,:;'-"));
    const bool plain = !word.empty() && std::ranges::all_of(word, is_small);
    if (plain && (word.size() > 1 || word == "a")) text[0] = char(text[0] - 'a' + 'A');
    if (!text.empty() && text.back() != '.') text += '.';
    return text;
}

/// Returns a link to a picture; pages that show it are in docs/.
std::string picture(const std::string& alternative, const fs::path& path) {
    return "![" + alternative + "](../" + text_of(path) + ")";
}

/// Returns what a mistake is, and below it the right picture beside the wrong one.
std::string gallery_entry(const fs::path& root, const Mistake& mistake) {
    const auto path = [&](const std::string& id) { return gallery_picture("", mistake.step, id); };
    std::error_code ignored;
    const bool seen = fs::exists(root / path(mistake.id), ignored), closer = !mistake.closer.empty();
    const fs::path right = closer ? closer_right_picture("", mistake.step, mistake.id) : path("right"),
                   wrong = closer ? closer_picture("", mistake.step, mistake.id) : path(mistake.id);
    return "**" + sentence(mistake.title) + "** " + (seen ? sentence(mistake.shows) + " " : "") + "*Why:* " +
           sentence(mistake.why) + " *Fix:* " + sentence(mistake.fix) + "\n\n" +
           (seen ? picture("right", right) + " " + picture(mistake.title, wrong) + "\n\n" : "");
}

std::string gallery(const fs::path& root, const std::string& what) {
    auto words = words_of(what);
    if (words.empty()) throw Error("gallery: the step is missing");
    const std::vector<Mistake> known = read_catalogue(root, words[0]);
    if (known.empty()) throw Error("gallery: the step " + words[0] + " has no known mistakes");
    if (words.size() == 1)
        for (const Mistake& mistake : known) words.push_back(mistake.id);
    std::string text = "\n";
    for (std::size_t i = 1; i < words.size(); ++i) {
        const auto found = std::ranges::find(known, words[i], &Mistake::id);
        if (found == known.end())
            throw Error("gallery: exercises/" + words[0] + "/mistakes.md has no " + words[i]);
        text += gallery_entry(root, *found);
    }
    return text;
}

/// Returns what a learner sees who has written the functions up to a milestone ("01_spheres normals").
std::string milestone(const fs::path& root, const std::string& what) {
    const auto words = words_of(what);
    if (words.size() != 2) throw Error("milestone: expected a step and an id, not \"" + what + "\"");
    const std::vector<Milestone> all = read_milestones(root, words[0]);
    const auto found = std::ranges::find(all, words[1], &Milestone::id);
    if (found == all.end())
        throw Error("milestone: exercises/" + words[0] + "/milestones.md has no " + words[1]);
    const std::string options = found->options.empty() ? "" : " " + joined(found->options, " ");
    return "\n> **Milestone " + std::to_string(found - all.begin() + 1) + " of " +
           std::to_string(all.size()) + ": " + found->title + ".** With `" +
           joined(found->functions, "`, `") + "` written, `./learn run " + words[0].substr(0, 2) + options +
           "` shows " + found->shows + "\n>\n> " +
           picture(found->title, milestone_picture(words[0], found->id)) + "\n\n";
}

/// Adds the code of all files below a folder to the hash, sorted by name.
void add_code_below(const fs::path& folder, Hash& hash) {
    for (const fs::path& entry : entries_of(folder)) {
        if (fs::is_directory(entry))
            add_code_below(entry, hash);
        else
            hash.add(code_only(read_file(text_of(entry))));
    }
}

} // namespace

std::vector<Block> find_blocks(const std::vector<std::string>& lines, const std::string& path) {
    std::vector<Block> blocks;
    bool open = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string& line = lines[i];
        if (line == end_marker) {
            if (!open) fail(path, i, "this <!-- end --> has no marker before it");
            blocks.back().end = i;
            open = false;
            continue;
        }
        const std::size_t colon = line.find(": ");
        if (!line.starts_with(opens) || !line.ends_with(closes) || colon == std::string::npos) continue;
        if (colon + 2 + closes.size() > line.size()) fail(path, i, "this marker does not say what to insert");
        const std::string kind = line.substr(opens.size(), colon - opens.size());
        const std::string what = line.substr(colon + 2, line.size() - closes.size() - colon - 2);
        if (kind == "live")
            continue; // the picture below it is alive in the web edition, whose builder reads this
        if (open) fail(path, i, "this marker begins before the end of the previous one");
        if (std::ranges::find(kinds, kind) == kinds.end())
            fail(path, i, "\"" + kind + "\" is not one of " + joined({kinds.begin(), kinds.end()}, ", "));
        blocks.push_back({kind, what, i + 1, i + 1});
        open = true;
    }
    if (open) fail(path, blocks.back().begin - 1, "this marker has no <!-- end -->");
    return blocks;
}

std::vector<Command> find_commands(const std::vector<std::string>& lines, const std::string& path) {
    std::vector<Command> commands;
    bool inside = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].starts_with("```")) {
            inside = !inside && lines[i] == "```sh";
            continue;
        }
        if (!inside || lines[i].empty() || lines[i][0] == '#') continue;
        Command command{lines[i], 0, int(i) + 1};
        const std::string mark = "# exit ";
        if (const std::size_t at = lines[i].find(mark); at != std::string::npos) {
            const char* const begin = lines[i].data() + at + mark.size();
            const auto [end, failure] =
                std::from_chars(begin, lines[i].data() + lines[i].size(), command.code);
            if (failure != std::errc() || command.code < 0 || command.code > 255)
                fail(path, i, "\"# exit \" must be followed by an exit code");
        }
        commands.push_back(command);
    }
    return commands;
}

std::string page_key(const fs::path& root, const std::string& page) {
    const std::vector<std::string> lines = lines_of(read_file(text_of(root / page)));
    const std::string name = text_of(path_of(page).filename());
    const std::string last = name[0] == '0' ? name.substr(0, 2) : "99";
    Hash hash;
    const std::vector<Command> commands = find_commands(lines, page);
    for (const Command& command : commands) hash.add(command.line);
    bool runs = !commands.empty();
    for (const Block& block : find_blocks(lines, page)) {
        if (block.kind != "output" && block.kind != "measured") continue;
        runs = true;
        hash.add(block.what);
        for (std::size_t i = block.begin; block.kind == "output" && i < block.end; ++i) hash.add(lines[i]);
    }
    if (!runs) return "";
    hash.add(read_file(text_of(root / "learn")));
    for (const fs::path& step : entries_of(root / "steps"))
        if (text_of(step.filename()).substr(0, 2) <= last) add_code_below(step, hash);
    for (const char* const folder : {"accel", "tools/tutor"}) add_code_below(root / folder, hash);
    return hash.text();
}

std::string block_text(const fs::path& root, const Block& block) {
    if (block.kind == "listing") return listing(root, block.what);
    if (block.kind == "diff") return diff(root, block.what);
    if (block.kind == "gallery") return gallery(root, block.what);
    if (block.kind == "milestone") return milestone(root, block.what);
    if (block.kind == "navigation") return navigation(root, block.what);
    if (block.kind == "contents") return contents(root, block.what);
    throw Error(block.kind + ": the command must be run first");
}

std::string fence(const std::string& output) {
    return "```text\n" + without_blank_ends(output) + (output.ends_with('\n') ? "" : "\n") + "```\n";
}

std::string weave_page(const std::string& page, const std::string& path,
                       const std::function<std::string(const Block&, const std::string&)>& fill) {
    const std::vector<std::string> lines = lines_of(page);
    std::string result;
    std::size_t next = 0;
    const auto copy = [&](std::size_t end) {
        std::string copied;
        for (; next < end; ++next) copied += lines[next] + '\n';
        return copied;
    };
    for (const Block& block : find_blocks(lines, path)) {
        result += copy(block.begin);
        const std::string now = copy(block.end);
        try {
            result += fill(block, now);
        } catch (const Error& error) {
            fail(path, block.begin - 1, error.what());
        }
    }
    return result + copy(lines.size());
}

} // namespace rt::weave
