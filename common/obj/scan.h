// The text of an OBJ file, checked line by line before tinyobjloader sees it: so that an error can name its
// line.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rt {

/// Stands for a space inside a name, because tinyobjloader ends names at spaces.
inline constexpr char inner_space = '\x1f';

constexpr bool is_blank(char c) {
    return c == ' ' || c == '\t';
}

/// "path:line: message", as compilers write it.
std::string at_line(const std::string& path, int line, const std::string& message);

/// Removes a byte order mark and makes every line end a '\n', the number of lines staying as it is.
void unify_text(std::string& text);

/// What is wrong with a number, in words: "" for a decimal number that a float can hold.
std::string_view number_fault(std::string_view word);

/// `word` in quotes, short and printable whatever it holds.
std::string in_quotes(std::string_view word);

/// What the checks learn that tinyobjloader does not tell.
struct ObjScan {
    std::vector<std::uint16_t> face_sizes; ///< corners of each face, in the file's order
    std::map<std::string, int> materials;  ///< each name after usemtl, and the line of its first use
    bool names_library = false;            ///< there is a mtllib line
};

/// Throws Error with path and line for what is not OBJ. Rewrites `text` in place to what tinyobjloader reads
/// rightly: vertices, normals, texture coordinates, faces, usemtl and mtllib; continued lines joined; the
/// rest turned into comments. A name keeps its inner spaces as `inner_space`.
ObjScan scan_obj(const std::string& path, std::string& text);

} // namespace rt
