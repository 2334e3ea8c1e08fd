// Reads and validates the catalogues, applies their changes to headers, and finds the pictures of mistakes.
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
void read_heading(Reader& reader, Patch& patch) {
    const std::string heading = reader.line().substr(3);
    const std::size_t colon = heading.find(": ");
    if (colon == std::string::npos) reader.complain("an entry must begin with '## id: title'");
    patch.id = heading.substr(0, colon);
    patch.title = trimmed(heading.substr(colon + 2));
    const auto allowed = [](unsigned char c) { return std::islower(c) || std::isdigit(c) || c == '-'; };
    if (patch.id.empty() || !std::ranges::all_of(patch.id, allowed))
        reader.complain("the id '" + patch.id + "' must consist of lower-case letters, digits and dashes");
    if (patch.title.empty()) reader.complain("the title after the id is missing");
    patch.place = reader.place();
    reader.advance();
}

void skip_blank_lines(Reader& reader) {
    while (!reader.at_end() && trimmed(reader.line()).empty()) reader.advance();
}

/// Reads from ```diff to ```: the name of the file, then the lines of the change.
void read_patch(Reader& reader, Patch& patch) {
    skip_blank_lines(reader);
    if (reader.at_end() || reader.line() != "```diff") reader.complain("expected ```diff here");
    reader.advance();
    if (!reader.at_end()) patch.file = reader.line();
    const std::size_t slash = patch.file.find('/');
    if (slash == std::string::npos || !patch.file.ends_with(".h"))
        reader.complain("a diff must begin with the header that it changes, such as 03_mirror/mirror.h");
    if (patch.file.substr(0, slash) > patch.step)
        reader.complain(patch.file + " belongs to a later step than " + patch.step);
    reader.advance();
    for (; !reader.at_end() && reader.line() != "```"; reader.advance()) {
        const std::string& line = reader.line();
        const char kind = line.empty() ? ' ' : line[0];
        if (kind != ' ' && kind != '-' && kind != '+')
            reader.complain("a line of a diff must begin with '-', '+' or a space");
        patch.lines.push_back({kind, line.empty() ? "" : line.substr(1)});
    }
    if (reader.at_end()) reader.complain("the diff has no end: ``` is missing");
    const auto changes = [](const PatchLine& line) { return line.kind != ' '; };
    if (std::ranges::none_of(patch.lines, changes)) reader.complain("the diff changes nothing");
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

void read_mistake(Reader& reader, Mistake& mistake) {
    skip_blank_lines(reader);
    if (!reader.at_end() && reader.line().starts_with("* Closer: "))
        mistake.closer = words_in(read_field(reader, "Closer"));
    mistake.shows = read_field(reader, "Shows");
    mistake.why = read_field(reader, "Why");
    mistake.fix = read_field(reader, "Fix");
}

void read_variant(Reader& reader, Variant& variant) {
    variant.form = read_field(reader, "Form");
}

/// Parses one file; `title` is the begin of its first line, and `read_fields` reads what follows an entry's diff.
template <class Entry>
std::vector<Entry> parse_entries(const std::string& text, const std::string& path, const std::string& title,
                                 void (*read_fields)(Reader&, Entry&)) {
    Reader reader(text, path);
    const std::string step = text_of(path_of(path).parent_path().filename());
    const std::string first = "# " + title + " of step " + step.substr(0, 2) + ": ";
    if (reader.at_end() || !reader.line().starts_with(first))
        reader.complain("the first line must be '" + first + "...'");
    reader.advance();
    while (!reader.at_end() && !reader.line().starts_with("## ")) reader.advance(); // the introduction
    std::vector<Entry> entries;
    std::set<std::string> ids;
    while (!reader.at_end()) {
        if (!reader.line().starts_with("## ")) reader.complain("expected '## id: title' here");
        Entry& entry = entries.emplace_back();
        entry.step = step;
        read_heading(reader, entry);
        read_patch(reader, entry);
        read_fields(reader, entry);
        skip_blank_lines(reader);
        if (!ids.insert(entry.id).second) throw Error(entry.place + ": there are two entries " + entry.id);
    }
    return entries;
}

/// Reads `root`/exercises/NN_name/`file`, if it is there, and checks that each entry changes the reference differently.
template <class Entry>
std::vector<Entry> read_entries(const fs::path& root, const std::string& step, const std::string& file,
                                std::vector<Entry> (*parse)(const std::string&, const std::string&)) {
    const std::string path = "exercises/" + step + "/" + file;
    std::error_code ignored;
    if (!fs::exists(root / path, ignored)) return {};
    std::vector<Entry> entries = parse(read_file(text_of(root / path)), path);
    std::set<std::string> results;
    for (const Entry& entry : entries) {
        const std::string text = with_patch(entry, read_file(text_of(root / "steps" / entry.file)));
        if (!results.insert(text).second)
            throw Error(entry.place + ": " + entry.id + " makes the same change as an earlier entry");
    }
    return entries;
}

/// Returns whether the `wanted` lines occur at `lines[begin]`, ignoring leading and trailing whitespace.
bool stands_at(const Words& wanted, const Words& lines, std::size_t begin) {
    if (begin + wanted.size() > lines.size()) return false;
    for (std::size_t i = 0; i < wanted.size(); ++i)
        if (trimmed(lines[begin + i]) != wanted[i]) return false;
    return true;
}

/// Returns the index of the first of the `wanted` lines. Throws Error if they occur nowhere or twice.
std::size_t find_place(const Patch& patch, const Words& lines, const Words& wanted) {
    std::size_t found = lines.size();
    for (std::size_t begin = 0; begin < lines.size(); ++begin) {
        if (!stands_at(wanted, lines, begin)) continue;
        const std::string where = patch.place + ": the lines that " + patch.id + " replaces occur ";
        if (found < lines.size())
            throw Error(where + "twice in " + patch.file + ", at lines " + std::to_string(found + 1) +
                        " and " + std::to_string(begin + 1) + ": add a line of context");
        found = begin;
    }
    if (found == lines.size() || wanted.empty())
        throw Error(patch.place + ": the change of " + patch.id + " does not apply to " + patch.file +
                    ": its lines with '-' and ' ' do not occur there in sequence");
    return found;
}

} // namespace

std::vector<Mistake> parse_catalogue(const std::string& text, const std::string& path) {
    return parse_entries<Mistake>(text, path, "Mistakes", read_mistake);
}

std::vector<Variant> parse_variants(const std::string& text, const std::string& path) {
    return parse_entries<Variant>(text, path, "Right variants", read_variant);
}

std::string with_patch(const Patch& patch, const std::string& header) {
    const Words lines = lines_of(header);
    Words wanted;
    for (const PatchLine& line : patch.lines)
        if (line.kind != '+') wanted.push_back(trimmed(line.text));
    const std::size_t place = find_place(patch, lines, wanted);
    std::string out;
    for (std::size_t i = 0; i < place; ++i) out += lines[i] + "\n";
    std::size_t old = place;
    for (const PatchLine& line : patch.lines) {
        if (line.kind == '+') out += line.text + "\n";
        if (line.kind == ' ') out += lines[old] + "\n";
        if (line.kind != '+') ++old;
    }
    for (std::size_t i = old; i < lines.size(); ++i) out += lines[i] + "\n";
    return out;
}

std::vector<Mistake> read_catalogue(const fs::path& root, const std::string& step) {
    return read_entries<Mistake>(root, step, "mistakes.md", parse_catalogue);
}

std::vector<Variant> read_variants(const fs::path& root, const std::string& step) {
    return read_entries<Variant>(root, step, "variants.md", parse_variants);
}

fs::path gallery_picture(const fs::path& root, const std::string& step, const std::string& id) {
    return root / "exercises" / step / "gallery" / (id + ".png");
}

fs::path closer_picture(const fs::path& root, const std::string& step, const std::string& id) {
    return gallery_picture(root, step, "closer/" + id);
}

fs::path closer_right_picture(const fs::path& root, const std::string& step, const std::string& id) {
    return gallery_picture(root, step, "closer/" + id + "-right");
}

std::string reference_fact(const fs::path& root, const std::string& step, const std::string& key) {
    std::istringstream lines(read_file(text_of(root / "assets" / "reference" / (step + ".txt"))));
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(key + ": ")) return line.substr(key.size() + 2);
    return "";
}

Words gallery_flags(const fs::path& root, const std::string& step) {
    const auto part = [&](const std::string& side) {
        return std::to_string(std::max(1, std::atoi(reference_fact(root, step, side).c_str()) * 5 / 12));
    };
    return {"--width", part("width"), "--height", part("height"), "--samples", "16"};
}

compare::CatalogueMatch nearest_mistake(const fs::path& root, const std::string& step,
                                        const fs::path& picture) {
    const fs::path right = gallery_picture(root, step, "right");
    std::error_code ignored;
    if (!fs::exists(right, ignored)) return {};
    std::vector<compare::CatalogueImage> wrong = compare::read_catalogue_images(text_of(right.parent_path()));
    const compare::EncodedImage mine = compare::read_encoded(text_of(picture));
    std::erase_if(wrong, [&](const compare::CatalogueImage& known) {
        const Image &image = known.picture.image, &other = mine.image;
        return known.name == "right" || image.width != other.width || image.height != other.height;
    });
    if (wrong.empty()) return {}; // they are older than the program's picture
    return compare::find_in_catalogue(mine, compare::read_encoded(text_of(right)), {}, wrong);
}

std::string function_of(const fs::path& root, const Patch& patch) {
    const std::string reference = read_file(text_of(root / "steps" / patch.file));
    const Words lines = lines_of(reference);
    const auto changed = std::ranges::mismatch(lines, lines_of(with_patch(patch, reference))).in1;
    const int line = int(changed - lines.begin()) + 1;
    for (const Exercise& exercise : find_exercises(reference, patch.file))
        if (exercise.line < line && line < exercise.last_line)
            return exercise.function + std::to_string(exercise.line);
    return "";
}

Words mistakes_in(const std::filesystem::path& root, const Exercise& exercise) {
    const std::string file = exercise.step + "/" + exercise.file;
    const std::string reference = read_file(text_of(root / "steps" / file));
    const Words lines = lines_of(reference);
    Words ids;
    for (const Mistake& mistake : read_catalogue(root, exercise.step)) {
        if (mistake.file != file) continue;
        const auto changed = std::ranges::mismatch(lines, lines_of(with_patch(mistake, reference))).in1;
        const auto line = std::size_t(changed - lines.begin());
        for (const LineRange& range : functions_named(reference, exercise.function))
            if (int(range.begin) < exercise.line && exercise.line <= int(range.end) && range.begin <= line &&
                line < range.end)
                ids.push_back(mistake.id);
    }
    return ids;
}

} // namespace rt::tutor
