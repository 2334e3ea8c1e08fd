// Reads and validates the catalogue of mistakes, applies mistakes to headers, and finds their pictures.
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/catalogue.h"
#include "tools/tutor/exercises.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <set>
#include <sstream>
#include <string_view>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

/// Iterates over the lines of one catalogue file; its errors name the current line.
class Reader {
  public:
    Reader(const std::string& text, const std::string& name) : lines(lines_of(text)), path(name) {}

    bool at_end() const { return next >= lines.size(); }
    const std::string& line() const { return lines[next]; }
    void advance() { ++next; }
    std::string place() const { return path + ":" + std::to_string(std::min(next + 1, lines.size())); }
    [[noreturn]] void complain(const std::string& what) const { throw Error(place() + ": " + what); }

  private:
    Words lines;
    std::string path;
    std::size_t next = 0;
};

/// `## id: title`
void read_heading(Reader& reader, Mistake& mistake) {
    const std::string heading = reader.line().substr(3);
    const std::size_t colon = heading.find(": ");
    if (colon == std::string::npos) reader.complain("a mistake must begin with '## id: title'");
    mistake.id = heading.substr(0, colon);
    mistake.title = trimmed(heading.substr(colon + 2));
    const auto allowed = [](unsigned char c) { return std::islower(c) || std::isdigit(c) || c == '-'; };
    if (mistake.id.empty() || !std::ranges::all_of(mistake.id, allowed))
        reader.complain("the id '" + mistake.id + "' must consist of lower-case letters, digits and dashes");
    if (mistake.title.empty()) reader.complain("the title after the id is missing");
    mistake.place = reader.place();
    reader.advance();
}

void skip_blank_lines(Reader& reader) {
    while (!reader.at_end() && trimmed(reader.line()).empty()) reader.advance();
}

/// Reads from ```diff to ```: the name of the file, then the lines of the change.
void read_patch(Reader& reader, Mistake& mistake) {
    skip_blank_lines(reader);
    if (reader.at_end() || reader.line() != "```diff") reader.complain("expected ```diff here");
    reader.advance();
    if (!reader.at_end()) mistake.file = reader.line();
    const std::size_t slash = mistake.file.find('/');
    if (slash == std::string::npos || !mistake.file.ends_with(".h"))
        reader.complain("a diff must begin with the header that it changes, such as 03_mirror/mirror.h");
    if (mistake.file.substr(0, slash) > mistake.step)
        reader.complain(mistake.file + " belongs to a later step than " + mistake.step);
    reader.advance();
    for (; !reader.at_end() && reader.line() != "```"; reader.advance()) {
        const std::string& line = reader.line();
        const char kind = line.empty() ? ' ' : line[0];
        if (kind != ' ' && kind != '-' && kind != '+')
            reader.complain("a line of a diff must begin with '-', '+' or a space");
        mistake.patch.push_back({kind, line.empty() ? "" : line.substr(1)});
    }
    if (reader.at_end()) reader.complain("the diff has no end: ``` is missing");
    const auto changes = [](const PatchLine& line) { return line.kind != ' '; };
    if (std::ranges::none_of(mistake.patch, changes)) reader.complain("the diff changes nothing");
    reader.advance();
}

/// Reads `* Name: text`, which may continue on indented lines.
std::string read_field(Reader& reader, const std::string& name) {
    skip_blank_lines(reader);
    const std::string begin = "* " + name + ": ";
    if (reader.at_end() || !reader.line().starts_with(begin))
        reader.complain("expected '" + begin + "...' here");
    std::string text = trimmed(reader.line().substr(begin.size()));
    reader.advance();
    for (; !reader.at_end() && reader.line().starts_with("  "); reader.advance())
        text += " " + trimmed(reader.line());
    return text;
}

Mistake read_mistake(Reader& reader, const std::string& step) {
    Mistake mistake;
    mistake.step = step;
    read_heading(reader, mistake);
    read_patch(reader, mistake);
    mistake.shows = read_field(reader, "Shows");
    mistake.why = read_field(reader, "Why");
    mistake.fix = read_field(reader, "Fix");
    skip_blank_lines(reader);
    return mistake;
}

/// Returns whether the `wanted` lines occur at `lines[begin]`, ignoring leading and trailing whitespace.
bool stands_at(const Words& wanted, const Words& lines, std::size_t begin) {
    if (begin + wanted.size() > lines.size()) return false;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (trimmed(lines[begin + i]) != wanted[i]) return false;
    return true;
}

/// Returns the index of the first of the `wanted` lines. Throws Error if they occur nowhere or twice.
std::size_t find_place(const Mistake& mistake, const Words& lines, const Words& wanted) {
    std::size_t found = lines.size();
    for (std::size_t begin = 0; begin < lines.size(); ++begin) {
        if (!stands_at(wanted, lines, begin)) continue;
        const std::string where = mistake.place + ": the lines that " + mistake.id + " replaces occur ";
        if (found < lines.size())
            throw Error(where + "twice in " + mistake.file + ", at lines " + std::to_string(found + 1) +
                        " and " + std::to_string(begin + 1) + ": add a line of context");
        found = begin;
    }
    if (found == lines.size() || wanted.empty())
        throw Error(mistake.place + ": the change of " + mistake.id + " does not apply to " + mistake.file +
                    ": its lines with '-' and ' ' do not occur there in sequence");
    return found;
}

} // namespace

std::vector<Mistake> parse_catalogue(const std::string& text, const std::string& path) {
    Reader reader(text, path);
    const std::string step = fs::path(path).parent_path().filename().string();
    const std::string title = "# Mistakes of step " + step.substr(0, 2) + ": ";
    if (reader.at_end() || !reader.line().starts_with(title))
        reader.complain("the first line must be '" + title + "...'");
    reader.advance();
    while (!reader.at_end() && !reader.line().starts_with("## ")) reader.advance(); // the introduction
    std::vector<Mistake> mistakes;
    std::set<std::string> ids;
    while (!reader.at_end()) {
        if (!reader.line().starts_with("## ")) reader.complain("expected '## id: title' here");
        mistakes.push_back(read_mistake(reader, step));
        const Mistake& last = mistakes.back();
        if (!ids.insert(last.id).second) throw Error(last.place + ": there are two mistakes " + last.id);
    }
    return mistakes;
}

std::string with_mistake(const Mistake& mistake, const std::string& header) {
    const Words lines = lines_of(header);
    Words wanted;
    for (const PatchLine& line : mistake.patch)
        if (line.kind != '+') wanted.push_back(trimmed(line.text));
    const std::size_t place = find_place(mistake, lines, wanted);
    std::string out;
    for (std::size_t i = 0; i < place; ++i) out += lines[i] + "\n";
    std::size_t old = place;
    for (const PatchLine& line : mistake.patch) {
        if (line.kind == '+') out += line.text + "\n";
        if (line.kind == ' ') out += lines[old] + "\n";
        if (line.kind != '+') ++old;
    }
    for (std::size_t i = old; i < lines.size(); ++i) out += lines[i] + "\n";
    return out;
}

std::vector<Mistake> read_catalogue(const fs::path& root, const std::string& step) {
    const fs::path path = root / "exercises" / step / "mistakes.md";
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return {};
    auto mistakes = parse_catalogue(read_file(path.string()), "exercises/" + step + "/mistakes.md");
    std::set<std::string> results;
    for (const Mistake& mistake : mistakes) {
        const std::string text = with_mistake(mistake, read_file((root / "steps" / mistake.file).string()));
        if (!results.insert(text).second)
            throw Error(mistake.place + ": " + mistake.id + " makes the same change as an earlier mistake");
    }
    return mistakes;
}

fs::path gallery_picture(const fs::path& root, const std::string& step, const std::string& id) {
    return root / "exercises" / step / "gallery" / (id + ".png");
}

std::string reference_fact(const fs::path& root, const std::string& step, const std::string& key) {
    std::istringstream lines(read_file((root / "assets" / "reference" / (step + ".txt")).string()));
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(key + ": ")) return line.substr(key.size() + 2);
    return "";
}

Words gallery_flags(const fs::path& root, const std::string& step) {
    const auto part = [&](const std::string& side) {
        return std::to_string(std::max(1, std::atoi(reference_fact(root, step, side).c_str()) * 3 / 8));
    };
    return {"--width", part("width"), "--height", part("height"), "--samples", "16"};
}

compare::CatalogueMatch nearest_mistake(const fs::path& root, const std::string& step,
                                        const fs::path& picture) {
    const fs::path right = gallery_picture(root, step, "right");
    std::error_code ignored;
    if (!fs::exists(right, ignored)) return {};
    std::vector<compare::CatalogueImage> wrong = compare::read_catalogue_images(right.parent_path().string());
    std::erase_if(wrong, [](const compare::CatalogueImage& known) { return known.name == "right"; });
    return compare::find_in_catalogue(compare::read_encoded(picture.string()),
                                      compare::read_encoded(right.string()), {}, wrong);
}

Words mistakes_in(const std::filesystem::path& root, const Exercise& exercise) {
    const std::string file = exercise.step + "/" + exercise.file;
    const std::string reference = read_file((root / "steps" / file).string());
    const Words lines = lines_of(reference);
    Words ids;
    for (const Mistake& mistake : read_catalogue(root, exercise.step)) {
        if (mistake.file != file) continue;
        const auto changed = std::ranges::mismatch(lines, lines_of(with_mistake(mistake, reference))).in1;
        const auto line = std::size_t(changed - lines.begin());
        for (const LineRange& range : functions_named(reference, exercise.function))
            if (int(range.begin) < exercise.line && exercise.line <= int(range.end) && range.begin <= line &&
                line < range.end)
                ids.push_back(mistake.id);
    }
    return ids;
}

} // namespace rt::tutor
