// Keeps what a chapter shows true: listings, diffs, galleries and the output of commands stand between
// <!-- kind: what --> and <!-- end -->, and are written there by a machine.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rt::weave {

/// What stands between a marker and its end.
struct Block {
    std::string kind;               ///< listing, diff, gallery, output or measured
    std::string what;               ///< "steps/03_mirror/mirror.h#reflect", or the command
    std::size_t begin = 0, end = 0; ///< the lines between the two, counted from 0
};

/// The blocks of a page. Throws Error, as "path:line: what is wrong", for a marker without an end, an end without one, and
/// a kind that is none.
std::vector<Block> find_blocks(const std::vector<std::string>& lines, const std::string& path);

/// A command that a page tells its reader to type, and the exit code that it names ("# exit 1: nothing is written yet").
struct Command {
    std::string line;
    int code = 0;
    int number = 0; ///< of the line, from 1
};

/// The lines of all blocks of ```sh. Throws Error, as "path:line: what is wrong", for "# exit" without a code from 0 to 255.
std::vector<Command> find_commands(const std::vector<std::string>& lines, const std::string& path = "page");

/// A hash of all that decides what the commands of a page do, but for what is behind them: the commands and outputs that it
/// shows, ./learn, and the steps up to the page's own, or all of them for an appendix.
std::string page_key(const std::filesystem::path& root, const std::string& page);

/// What shall stand in a block of a kind that needs no command to be run: fences and all. Throws Error.
std::string block_text(const std::filesystem::path& root, const Block& block);

/// Output as it stands in a page.
std::string fence(const std::string& output);

/// The page with its blocks filled: fill answers a block's lines, given those that stand there.
std::string weave_page(const std::string& page, const std::string& path,
                       const std::function<std::string(const Block&, const std::string& now)>& fill);

/// What a page refers to and is not there, a line each, as "path:line: what": links, pictures, headings, and `paths` in the
/// project's folders.
std::vector<std::string> dead_links(const std::filesystem::path& root, const std::string& page,
                                    const std::string& path);

} // namespace rt::weave
