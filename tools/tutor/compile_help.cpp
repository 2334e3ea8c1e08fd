// Knows how GCC and Clang word the errors that people make most.
#include "tools/tutor/compile_help.h"

#include <algorithm>
#include <array>
#include <utility>

namespace rt::tutor {

namespace {

/// GCC's typographic quotes, as ' '.
std::string plain_quotes(std::string text) {
    for (const std::string quote : {"‘", "’"})
        for (std::size_t at; (at = text.find(quote)) != text.npos;) text.replace(at, quote.size(), "'");
    return text;
}

struct Remedy {
    std::array<const char*, 2> marks; ///< the message has both; "" is in every message
    const char* sentence;
};

/// The first that fits counts: the special ones stand before the general ones.
const Remedy remedies[] = {
    {{"expected ';'", ""}, "A semicolon is missing: at the end of the statement before this place."},
    {{"expected ',' or ';'", ""}, "A semicolon is missing: at the end of the statement before this place."},
    {{"expected '}'", ""}, "A closing brace is missing. Count the braces of the functions above."},
    {{"extraneous closing brace", ""}, "There is one closing brace too many."},
    {{"expected declaration", ""}, "There is one closing brace too many, or a statement outside a function."},
    {{"expected unqualified-id", ""},
     "There is one closing brace too many, or a statement outside a function."},
    {{"expected ')'", ""}, "A closing bracket is missing, or something between two values, such as a comma."},
    {{"expected primary-expression", ""}, "A value is missing before this place."},
    {{"expected expression", ""}, "A value is missing before this place."},
    {{"No such file", ""}, "A path begins at the steps: #include \"03_mirror/mirror.h\"."},
    {{"file not found", ""}, "A path begins at the steps: #include \"03_mirror/mirror.h\"."},
    {{"before deduction of 'auto'", ""}, "The name is used before it is declared. Move its declaration up."},
    {{"was not declared", ""}, "Is the name spelled as in the chapter, and is it declared above this line?"},
    {{"undeclared identifier", ""},
     "Is the name spelled as in the chapter, and is it declared above this line?"},
    {{"operator*", "vec<"}, "A vector is multiplied by a float: write 2.0f * v, not 2 * v."},
    {{"operator/", "vec<"}, "A vector is divided by a float: write v / 2.0f, not v / 2."},
    {{"operator+", "vec<"}, "Both sides must be vectors, or one a float: write v + 1.0f or v + vec3(1)."},
    {{"operator-", "vec<"}, "Both sides must be vectors, or one a float: write v - 1.0f or v - vec3(1)."},
    {{"invalid operands", "vec"},
     "A vector is combined with a float or a vector, not with an int or a double."},
    {{"call to 'exp", "vec<"},
     "std::exp takes one number. For a vector write exp(v), which works by component."},
    {{"call to 'pow", "vec<"},
     "std::pow takes numbers. For vectors write pow(v, vec3(e)), which works by component."},
    {{"call to 'sqrt", "vec<"}, "std::sqrt takes one number. For a vector write sqrt(v), or length(v)."},
    {{"call to 'max", ""}, "Both values must have the same type: write std::max(0.0f, x) for a float x."},
    {{"call to 'min", ""}, "Both values must have the same type: write std::min(1.0f, x) for a float x."},
    {{"has no member named", "optional"},
     "The value of an optional is behind -> or *: hit->t, once you know there is one."},
    {{"no member named", ""}, "The type has no such member. Its declaration lists those that it has."},
    {{"optional<", "convert"}, "An optional is not its value: test it first, then write *hit or hit->t."},
    {{"optional<", "operator"}, "An optional is not its value: test it first, then write *hit or hit->t."},
    {{"read-only", ""}, "It is const. Copy it into a variable of your own to change it."},
    {{"discards qualifiers", ""}, "It is const. Copy it into a variable of your own to change it."},
    {{"no return statement", ""}, "Each way through the function must end with a return."},
    {{"control reaches end", ""}, "Each way through the function must end with a return."},
    {{"does not return a value", ""}, "Each way through the function must end with a return."},
    {{"uninitialized", ""}, "Give the variable a value where you declare it."},
    {{"assignment used as truth value", ""}, "= assigns. To compare, write ==."},
    {{"using the result of an assignment", ""}, "= assigns. To compare, write ==."},
    {{"suggest parentheses", ""}, "Add brackets to say which operation comes first."},
    {{"local variable", "return"},
     "The variable is gone when the function returns. Return a copy, not a reference."},
    {{"dangling", ""}, "What it points to is gone after this line. Keep a copy in a variable."},
    {{"redefinition", ""}, "The name exists already. Change your lines only between those that were given."},
    {{"redeclaration", ""}, "The name is declared twice in this function."},
    {{"void value", ""}, "The function returns nothing that could be used here."},
    {{"ambiguous", ""},
     "Several functions fit. Write the arguments with the types that the one you mean has."},
    {{"too few arguments", ""}, "An argument is missing. Compare with the function's declaration."},
    {{"too many arguments", ""}, "There is one argument too many. Compare with the function's declaration."},
    {{"cannot convert", ""}, "The types differ. Compare with the function's declaration."},
    {{"could not convert", ""}, "The types differ. Compare with the function's declaration."},
    {{"no matching function", ""},
     "No function of that name takes these arguments. Compare their types and number."},
};

std::string remedy_for(const std::string& message) {
    const std::string plain = plain_quotes(message);
    for (const Remedy& remedy : remedies)
        if (std::ranges::all_of(remedy.marks,
                                [&](const char* mark) { return plain.find(mark) != plain.npos; }))
            return remedy.sentence;
    return "";
}

/// The line of the source and the caret, which follow the error in the log.
Words source_after(const std::string& log, const CompileError& error) {
    const Words lines = lines_of(log);
    const std::string mark = error.file + ":" + std::to_string(error.line) + ":";
    const auto here = std::ranges::find_if(lines, [&](const std::string& line) {
        return line.starts_with(mark) && line.find(error.message) != line.npos;
    });
    Words source;
    for (auto line = here; line != lines.end() && source.size() < 2;) {
        if (++line == lines.end() || line->find('|') == line->npos) break;
        source.push_back(*line);
    }
    return source;
}

} // namespace

std::optional<CompileHelp> compile_help(const std::string& log, const std::string& preferred) {
    const auto error = first_error(log, preferred);
    if (!error) return std::nullopt;
    return CompileHelp{*error, source_after(log, *error), remedy_for(error->message)};
}

} // namespace rt::tutor
