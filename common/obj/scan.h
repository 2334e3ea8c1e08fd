// The text of an OBJ file, checked line by line before tinyobjloader sees it: so that an error can name its
// line. It is checked in chunks, each for itself, and what depends on the chunks before it is looked at last.
#pragma once

#include <array>
#include <map>
#include <optional>
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

/// Makes a byte order mark blank.
void blank_byte_order_mark(std::string& text);

/// Makes every line end a '\n', the number of lines staying as it is.
void unify_line_ends(std::string& text);

/// What is wrong with a number, in words: "" for a decimal number that a float can hold.
std::string_view number_fault(std::string_view word);

/// `word` in quotes, short and printable whatever it holds.
std::string in_quotes(std::string_view word);

/// What faces name by number.
struct Numbered {
    enum Kind { position, uv, normal };
};
using Counts = std::array<int, 3>; ///< one a kind

/// A negative number that reaches back beyond the chunk that it stands in.
struct Backward {
    Numbered::Kind kind;
    int missing;        ///< at least so many of its kind must stand in earlier chunks
    int count;          ///< so many stand before it in its own
    int line;           ///< in its chunk, from 1
    std::string number; ///< as written
};

struct Fault {
    int line; ///< in its chunk, from 1
    std::string message;
};

/// What the checks learn of a part of the text that tinyobjloader does not tell. Lines count from 1.
struct ChunkScan {
    int lines = 0;
    int faces = 0, corners = 0;
    Counts counts{};                  ///< lines that begin with v, vt, vn
    Counts largest{}, largest_line{}; ///< the largest number of each kind that a face names, and where first
    Counts missing{};                 ///< the largest of `backward`
    std::vector<Backward>
        backward; ///< in the text's order; each misses more than those of its kind before it
    std::map<std::string, int> materials; ///< each name after usemtl, and the line of its first use
    bool names_library = false;           ///< there is a mtllib line
    std::optional<Fault> fault;           ///< the text is scanned up to here
};

/// The same of a whole file, where the numbers are sure to be in range.
struct ObjScan {
    Counts counts{};
    int faces = 0, corners = 0;
    std::map<std::string, int> materials;
    bool names_library = false;

    /// Goes on with the chunk that follows. Throws Error for the first fault in the file's order.
    void add(const std::string& path, const ChunkScan& chunk);
    /// Throws Error if a face names what came nowhere, or if there is none.
    void finish(const std::string& path) const;

  private:
    int lines = 0;
    Counts largest{}, largest_line{};
};

/// Checks whole lines of a text; it holds no '\r'. Rewrites `text` in place to what tinyobjloader reads
/// rightly: vertices, normals, texture coordinates, faces, usemtl and mtllib; continued lines joined; the
/// rest turned into comments. A name keeps its inner spaces as `inner_space`.
ChunkScan scan_chunk(std::string& text, bool begins_file);

} // namespace rt
