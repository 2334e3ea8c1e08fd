// Keeps the listings, diffs, galleries and outputs in the chapters up to date.
// They are generated between the markers <!-- kind: what --> and <!-- end -->.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace rt::weave {

/// The text between a marker and its end.
struct Block {
    std::string kind; ///< listing, diff, gallery, milestone, navigation, contents, output or measured
    std::string what; ///< "steps/03_mirror/mirror.h#reflect", or the command
    std::size_t begin = 0, end = 0; ///< range of lines between the two, from 0
};

/// Returns the blocks of a page. Throws Error, as "path:line: what is wrong", for a marker without an end, an
/// end without a marker, and an unknown kind.
std::vector<Block> find_blocks(const std::vector<std::string>& lines, const std::string& path);

/// A command that a page tells its reader to type, and its expected exit code ("# exit 1: nothing
/// is written yet").
struct Command {
    std::string line;
    int code = 0;
    int number = 0; ///< line number, from 1
};

/// Returns the commands in all blocks of ```sh. Throws Error, as "path:line: what is wrong", if "# exit" is
/// not followed by a code from 0 to 255.
std::vector<Command> find_commands(const std::vector<std::string>& lines, const std::string& path = "page");

/// Returns a hash of what determines the results of a page's commands: the commands and the outputs that it
/// shows, ./learn, tools/tutor, accel, and the code of the steps up to the page's own (all steps for an
/// appendix). The rest of the code is not included. Empty if the page runs nothing.
std::string page_key(const std::filesystem::path& root, const std::string& page);

/// Returns the text of a block, with fences, for the kinds that do not need to run a command. Throws Error.
std::string block_text(const std::filesystem::path& root, const Block& block);

/// Returns an output with the fences around it.
std::string fence(const std::string& output);

/// Returns the page with its blocks replaced by fill(block, current text of the block).
std::string weave_page(const std::string& page, const std::string& path,
                       const std::function<std::string(const Block&, const std::string& now)>& fill);

/// Returns what a page refers to and does not exist, each as "path:line: what": links, pictures, headings,
/// and `paths` in the project's folders.
std::vector<std::string> dead_links(const std::filesystem::path& root, const std::string& page,
                                    const std::string& path);

} // namespace rt::weave
