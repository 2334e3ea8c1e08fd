// Splits a source file into its top-level declarations.
// Relies on the formatting: namespaces open and close in the first column, and their contents
// are not indented.
#include "tools/weave/region.h"

#include "common/util/error.h"
#include "tools/tutor/exercises.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <vector>

namespace rt::weave {

using namespace tutor;

namespace {

struct Item {
    std::string text; ///< complete, with the comment above it
    std::string head; ///< the declaration on one line, up to its body, value or end
    bool has_body = false;
};

bool is_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Returns the line without comments and without the contents of quotes.
std::string code_of(const std::string& line) {
    std::string code;
    char quote = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quote != 0) {
            if (c == '\\')
                ++i;
            else if (c == quote)
                quote = 0;
            continue;
        }
        if (c == '/' && i + 1 < line.size() && line[i + 1] == '/') break;
        // the separator in 1'000 is not a quote
        if (c == '"' || (c == '\'' && (i == 0 || !is_word(line[i - 1])))) quote = c;
        code += c;
    }
    return code;
}

/// Returns the position of the bracket that closes the one at `open`; the size of the text if there is none.
std::size_t closing(const std::string& text, std::size_t open, char opens, char closes) {
    int depth = 0;
    for (std::size_t i = open; i < text.size(); ++i) {
        if (text[i] == opens) ++depth;
        if (text[i] == closes && --depth == 0) return i;
    }
    return text.size();
}

std::string without_template(std::string head) {
    while (head.starts_with("template")) {
        const std::size_t end = closing(head, head.find('<'), '<', '>');
        head = head.substr(std::min(head.find_first_not_of(' ', end + 1), head.size()));
    }
    return head;
}

/// Returns the word that ends before `end`.
std::string word_before(const std::string& text, std::size_t end) {
    while (end > 0 && text[end - 1] == ' ') --end;
    std::size_t begin = end;
    while (begin > 0 && is_word(text[begin - 1])) --begin;
    return text.substr(begin, end - begin);
}

std::string word_after(const std::string& text, std::size_t begin) {
    while (begin < text.size() && !is_word(text[begin])) ++begin;
    std::size_t end = begin;
    while (end < text.size() && is_word(text[end])) ++end;
    return text.substr(begin, end - begin);
}

/// Returns the name that a declaration introduces.
std::string declared(const std::string& head) {
    const std::string text = without_template(head);
    for (const std::string key : {"struct ", "enum class ", "enum ", "class ", "using ", "concept "}) {
        if (!text.starts_with(key)) continue;
        std::size_t begin = key.size();
        if (text.compare(begin, 8, "alignas(") == 0) begin = closing(text, begin, '(', ')');
        return word_after(text, begin);
    }
    const std::size_t end = text.find_first_of("(={;");
    std::string name = word_before(text, end == std::string::npos ? text.size() : end);
    if (end != std::string::npos && text[end] == '(' && (name == "requires" || name == "alignas"))
        name = declared(text.substr(std::min(closing(text, end, '(', ')') + 1, text.size())));
    return name;
}

/// Reads the declaration that begins at `line`, with the comment from `comment` on; moves `line` behind it.
Item item_at(const std::vector<std::string>& lines, std::size_t comment, std::size_t& line) {
    Item item;
    for (std::size_t i = comment; i < line; ++i) item.text += lines[i] + '\n';
    int depth = 0;
    bool in_head = true;
    for (; line < lines.size(); ++line) {
        item.text += lines[line] + '\n';
        const std::string code = code_of(lines[line]);
        for (const char c : code) {
            if (c == '(' || c == '{' || c == '[') ++depth;
            if (c == ')' || c == '}' || c == ']') --depth;
            if (c == '{' && depth == 1) {
                item.has_body = item.has_body || in_head;
                in_head = false;
            }
            if (c == ';' && depth == 0) in_head = false;
            if (in_head) item.head += c;
        }
        if (in_head) item.head += ' ';
        const std::size_t last = code.find_last_not_of(' ');
        const bool ends = last != std::string::npos && (code[last] == ';' || (code[last] == '}' && !in_head));
        if (depth == 0 && ends) break;
    }
    ++line;
    return item;
}

std::vector<Item> items_of(const std::string& text) {
    const std::vector<std::string> lines = lines_of(text);
    std::vector<Item> items;
    std::size_t comment = 0; // where the comment directly above begins
    for (std::size_t line = 0; line < lines.size();) {
        const std::string& now = lines[line];
        if (now.starts_with("//")) {
            ++line;
            continue;
        }
        const bool begins =
            !now.empty() && now[0] != ' ' && now[0] != '#' && now[0] != '}' && !now.starts_with("namespace ");
        if (begins)
            items.push_back(item_at(lines, comment, line));
        else
            ++line;
        comment = line;
    }
    return items;
}

bool matches(const Item& item, const std::string& name) {
    const std::size_t parameters = name.find('(');
    if (declared(item.head) != name.substr(0, parameters)) return false;
    return parameters == std::string::npos || item.head.find(name) != std::string::npos;
}

} // namespace

std::string region(const std::string& text, const std::string& name, const std::string& path) {
    std::vector<Item> found;
    for (const Item& item : items_of(text))
        if (matches(item, name)) found.push_back(item);
    std::vector<Item> defined;
    for (const Item& item : found)
        if (item.has_body) defined.push_back(item);
    if (!defined.empty()) found = defined;
    if (found.empty()) throw Error(path + ": there is no declaration of " + name);
    if (found.size() > 1)
        throw Error(path + ": there are " + std::to_string(found.size()) + " declarations of " + name +
                    "; add the beginning of the parameters, as in \"" + name.substr(0, name.find('(')) +
                    "(const Quad\"");
    return found[0].text;
}

} // namespace rt::weave
