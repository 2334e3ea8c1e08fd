// Finds exercises by scanning lines. The code is machine-formatted, so functions begin and end in column 0.
#include "tools/tutor/exercises.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "tools/tutor/milestones.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

const std::string todo = "// TODO: ";

/// Returns the text after `mark` if the line begins with it, ignoring indentation.
std::optional<std::string> after(const std::string& line, const std::string& mark) {
    const std::string text = trimmed(line);
    if (!text.starts_with(mark)) return std::nullopt;
    return trimmed(text.substr(mark.size()));
}

std::optional<std::string> opening(const std::string& line) {
    return after(line, "//>");
}
std::optional<std::string> closing(const std::string& line) {
    return after(line, "//<");
}

std::string indentation(const std::string& line) {
    return line.substr(0, line.find_first_not_of(' '));
}

[[noreturn]] void refuse(const std::string& path, int line, const std::string& what) {
    throw Error(path + ":" + std::to_string(line) + ": " + what);
}

/// Returns "reflected_ray" for "inline Ray reflected_ray(const Ray& ray, ..."; nothing if the line is
/// not a function.
std::optional<std::string> function_name(const std::string& line) {
    if (line.empty() || std::string(" \t/}#").find(line[0]) != std::string::npos) return std::nullopt;
    const auto bracket = line.find('(');
    if (bracket == std::string::npos) return std::nullopt;
    const auto before = line.find_last_not_of(
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_", bracket == 0 ? 0 : bracket - 1);
    const auto first = before == std::string::npos ? 0 : before + 1;
    if (first >= bracket) return std::nullopt;
    return line.substr(first, bracket - first);
}

/// Stores in `exercise` the function whose body contains the exercise. Throws Error if there is none.
void find_function(Exercise& exercise, const Words& lines, const std::string& path) {
    for (int line = exercise.line; line > 0; --line) {
        const std::string& text = lines[std::size_t(line) - 1];
        if (text.starts_with("}")) break;
        if (const auto name = function_name(text)) {
            exercise.function = *name;
            exercise.function_line = line;
            return;
        }
    }
    refuse(path, exercise.line, "this region is not inside a function");
}

/// Returns whether what begins at this line ends with ; before any {, so that it only declares a function.
bool is_declaration(const Words& lines, std::size_t line) {
    for (; line < lines.size(); ++line) {
        const std::string code = trimmed(lines[line].substr(0, lines[line].find("//")));
        if (code.find('{') != code.npos) return false;
        if (code.ends_with(';')) return true;
    }
    return true;
}

/// Returns the headers of steps that a file includes, such as "01_spheres/ray.h".
Words named_headers(const std::string& text) {
    Words headers;
    for (const std::string& line : lines_of(text)) {
        const auto rest = after(line, "#include");
        if (!rest || rest->size() < 4 || (*rest)[0] != '"' || (*rest)[1] < '0' || (*rest)[1] > '9') continue;
        headers.push_back(rest->substr(1, rest->find('"', 1) - 1));
    }
    return headers;
}

void visit(const std::vector<fs::path>& folders, const std::string& header, std::set<std::string>& visited,
           Words& order) {
    if (!visited.insert(header).second) return;
    std::error_code ignored;
    for (const fs::path& folder : folders) {
        if (!fs::is_regular_file(folder / header, ignored)) continue;
        for (const std::string& next : named_headers(read_file(text_of(folder / header))))
            visit(folders, next, visited, order);
        break;
    }
    order.push_back(header);
}

/// Returns the headers of a step, each after the headers that it includes.
Words headers_in_order(const fs::path& steps, const std::string& step) {
    Words headers, order;
    for (const fs::path& entry : entries_of(steps / step))
        if (entry.extension() == ".h") headers.push_back(text_of(entry.filename()));
    std::set<std::string> visited;
    Words all;
    for (const std::string& header : headers) visit({steps}, step + "/" + header, visited, all);
    for (const std::string& header : all)
        if (header.starts_with(step + "/")) order.push_back(header.substr(step.size() + 1));
    return order;
}

/// Gives each exercise a unique name.
void name_exercises(std::vector<Exercise>& exercises) {
    std::map<std::string, std::set<std::string>>
        functions; // name -> the places where functions of that name begin
    for (const Exercise& e : exercises)
        functions[e.function].insert(e.file + ":" + std::to_string(e.function_line));
    std::map<std::string, int> uses;
    for (Exercise& e : exercises) {
        e.name = e.function;
        if (functions[e.function].size() > 1) e.name += "_" + text_of(path_of(e.file).stem());
        const int count = ++uses[e.name];
        if (count > 1) e.name += "_" + std::to_string(count);
    }
}

} // namespace

std::vector<fs::path> entries_of(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code failure;
    for (fs::directory_iterator at(folder, failure), end; !failure && at != end; at.increment(failure))
        entries.push_back(at->path());
    std::ranges::sort(entries);
    return entries;
}

std::vector<Exercise> find_exercises(const std::string& text, const std::string& path) {
    const Words lines = lines_of(text);
    std::vector<Exercise> found;
    bool open = false;
    for (int number = 1; number <= int(lines.size()); ++number) {
        const std::string& line = lines[std::size_t(number) - 1];
        if (const auto task = opening(line)) {
            if (open)
                refuse(path, found.back().line, "this region has no end (//<) before the next one begins");
            if (task->empty()) refuse(path, number, "the task after //> is missing");
            found.push_back({.line = number, .task = *task});
            find_function(found.back(), lines, path);
            open = true;
        } else if (const auto placeholder = closing(line)) {
            if (!open) refuse(path, number, "a region ends here (//<) without a beginning (//>)");
            found.back().last_line = number;
            found.back().placeholder = *placeholder;
            open = false;
        } else if (open) {
            found.back().reference.push_back(line);
        }
    }
    if (open) refuse(path, found.back().line, "this region has no end (//<)");
    return found;
}

std::vector<Exercise> find_step_exercises(const fs::path& steps, const std::string& step) {
    std::vector<Exercise> all;
    for (const std::string& file : headers_in_order(steps, step)) {
        const std::string path = text_of(steps / step / file);
        for (Exercise exercise : find_exercises(read_file(path), path)) {
            exercise.step = step;
            exercise.file = file;
            all.push_back(std::move(exercise));
        }
    }
    name_exercises(all);
    sort_by_milestones(steps.parent_path(), step, all);
    return all;
}

std::string make_stub(const std::string& text, const std::vector<Exercise>& exercises) {
    const Words lines = lines_of(text);
    std::string stub;
    for (int number = 1; number <= int(lines.size()); ++number) {
        const std::string& line = lines[std::size_t(number) - 1];
        const auto here = std::ranges::find(exercises, number, &Exercise::line);
        if (here == exercises.end()) {
            stub += line + "\n";
            continue;
        }
        stub += indentation(line) + todo + here->task + "\n";
        if (!here->placeholder.empty()) stub += indentation(line) + here->placeholder + "\n";
        number = here->last_line;
    }
    return stub;
}

std::string without_markers(const std::string& text) {
    std::string clean;
    for (const std::string& line : lines_of(text))
        if (!opening(line) && !closing(line)) clean += line + "\n";
    return clean;
}

int line_of(const Exercise& exercise, const std::string& text) {
    const Words lines = lines_of(text);
    int function = 0, number = 0;
    for (const std::string& line : lines) {
        ++number;
        if (after(line, trimmed(todo)) == exercise.task) return number;
        if (function == 0 && function_name(line) == exercise.function) function = number;
    }
    return std::max(function, 1);
}

std::vector<LineRange> functions_named(const std::string& text, const std::string& name) {
    const Words lines = lines_of(text);
    std::vector<LineRange> ranges;
    for (std::size_t line = 0; line < lines.size(); ++line) {
        if (function_name(lines[line]) != name || is_declaration(lines, line)) continue;
        LineRange range{line, line + 1};
        while (range.end < lines.size() && !lines[range.end - 1].starts_with("}")) ++range.end;
        ranges.push_back(range);
        line = range.end - 1;
    }
    return ranges;
}

std::string bare_code(const std::string& text, const LineRange& range) {
    const Words lines = lines_of(text);
    std::string bare;
    for (std::size_t line = range.begin; line < range.end; ++line)
        for (const char c : lines[line].substr(0, lines[line].find("//")))
            if (c != ' ' && c != '\t' && c != '\r') bare += c;
    return bare;
}

bool is_untouched(const Exercise& exercise, const std::string& text, const std::string& stub) {
    const std::size_t task = std::size_t(line_of(exercise, stub)) - 1;
    for (const LineRange& cut : functions_named(stub, exercise.function)) {
        if (task < cut.begin || task >= cut.end) continue;
        return std::ranges::any_of(functions_named(text, exercise.function), [&](const LineRange& own) {
            return bare_code(text, own) == bare_code(stub, cut);
        });
    }
    return false;
}

bool may_not_end(const Exercise& exercise, const std::string& text) {
    const auto overloads = functions_named(text, exercise.function);
    for (const LineRange& range : overloads) {
        const std::string bare = bare_code(text, range), call = exercise.function + "(";
        for (const char* loop : {"while(", "for(", "do{", "goto"})
            if (bare.find(loop) != std::string::npos) return true;
        if (overloads.size() == 1 && bare.find(call) != bare.rfind(call)) return true;
    }
    return false;
}

Words included_headers(const std::vector<fs::path>& folders, const std::string& header) {
    std::set<std::string> visited;
    Words order;
    visit(folders, header, visited, order);
    return order;
}

} // namespace rt::tutor
