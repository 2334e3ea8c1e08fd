// ./learn debug and scene: programs of the learner's own, one for a debugger, and those of their own scenes.
#include "tools/tutor/commands.h"

#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/util/report_error.h"
#include "tools/tutor/compile_help.h"
#include "tools/tutor/system.h"
#include "tools/tutor/toolchain.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <iostream>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

/// Builds the libraries that the step's program needs, and returns how to compile it.
Toolchain own_toolchain(const Project& project, const std::string& step) {
    const Preset preset{project.root};
    make(preset, targets_for(step), true);
    make_folder(preset.folder() / "check");
    return read_toolchain(project.root, preset.folder(), preset.folder() / "check", Strictness::learner);
}

/// Prints the first compile error as ./learn check does. Throws CommandFailed.
[[noreturn]] void refuse(const std::string& log) {
    const auto help = compile_help(log, "workshop/");
    if (!help) throw Error("the compiler failed without an error in a source file; it says: " + log);
    for (const std::string& line : help->source) std::cout << printable(line) << "\n";
    if (!help->remedy.empty()) std::cout << help->remedy << std::endl;
    throw CommandFailed(display_path(path_of(help->error.file), help->error.line) + ": " +
                        help->error.message);
}

bool sets(const Words& flags, const std::string& option) {
    return std::ranges::any_of(
        flags, [&](const std::string& flag) { return flag == option || flag.starts_with(option + "="); });
}

// --- the debugger -----------------------------------------------------------------------------------------------

/// Returns the path of a program in PATH; empty if there is none.
std::string found_in_path(const std::string& name) {
    const char* const path = std::getenv("PATH");
    for (const std::string& folder : fields_of(path ? path : "", list_separator)) {
        std::error_code ignored;
        const fs::path program = path_of(folder) / (name + program_ending);
        if (!folder.empty() && fs::is_regular_file(program, ignored)) return text_of(program);
    }
    return "";
}

/// Returns the command that starts a debugger on a program, up to the program's own flags. Throws Error.
Words debugger_command(const fs::path& program) {
    if (const std::string gdb = found_in_path("gdb"); !gdb.empty()) return {gdb, "--args", text_of(program)};
    if (const std::string lldb = found_in_path("lldb"); !lldb.empty()) return {lldb, "--", text_of(program)};
    throw Error("there is no gdb and no lldb here; install one, for example: sudo apt-get install gdb");
}

/// Compiles the step's program with the files in the workshop, not optimised.
void build_for_debugger(const Project& project, const std::string& step, const fs::path& program) {
    std::cout << "building " << display_path(program) << " ..." << std::endl;
    const Toolchain tools = own_toolchain(project, step);
    const fs::path log = tools.work / "debug.log";
    Words command{tools.compiler, "-I" + text_of(project.workshop), "-I" + text_of(steps_folder(project))};
    append(command, tools.flags);
    append(command, {"-w", "-O0", "-g", text_of(project.root / program_source(step))});
    append(command, libraries_for(tools, step));
    append(command, {"-pthread", "-o", text_of(program)});
    if (run_process(command, {.log = log}).code != 0) refuse(read_file(text_of(log)));
}

} // namespace

void debug_step(const Project& project, const std::string& step, const Words& flags, bool only_build) {
    const fs::path folder = project.root / "build/debugger", program = folder / step;
    Words command;
    if (!only_build) command = debugger_command(program);
    make_folder(folder);
    build_for_debugger(project, step, program);
    if (only_build) return;
    append(command, flags);
    if (!sets(flags, "--threads")) append(command, {"--threads", "1"});
    if (!sets(flags, "--samples")) append(command, {"--samples", "1"});
    if (!sets(flags, "--out")) append(command, {"--out", text_of(folder / (step + ".png"))});
    replace_process(command);
}

// --- own scenes -------------------------------------------------------------------------------------------------

namespace {

fs::path scene_path(const Project& project, const std::string& name) {
    return project.workshop / "scenes" / path_of(name + ".cpp");
}

/// Returns the step's header of the scene, its own or that of an earlier step: "06_textures/scene.h" for 07.
std::string scene_header(const Project& project, const std::string& step) {
    std::string header;
    for (const std::string& each : all_steps(project))
        if (each <= step && fs::exists(steps_folder(project) / each / "scene.h")) header = each + "/scene.h";
    return header;
}

/// Returns the text of the scene. Throws Error if there is none, or if the step's program cannot show it.
std::string scene_text(const Project& project, const std::string& step, const std::string& name) {
    const std::string path = display_path(scene_path(project, name)), number = number_of(step);
    if (step < "05") throw Error("scenes of your own are for the steps from 05 on");
    if (!has_scene(project, name))
        throw Error("there is no " + path + "; ./learn scene " + name + " " + number + " writes an example");
    const std::string text = read_file(text_of(scene_path(project, name))),
                      include = "#include \"" + scene_header(project, step) + "\"";
    if (text.find(include) == text.npos)
        throw Error(path + ": for step " + number + " this file must have " + include);
    return text;
}

/// Writes a page with all pictures of the folder.
fs::path write_gallery(const fs::path& folder) {
    std::string page = "<!DOCTYPE html><meta charset=utf-8><title>My scenes</title>\n"
                       "<style>body{background:#222;color:#ddd;font:16px sans-serif;text-align:center}"
                       "figure{display:inline-block;margin:1em}img{max-width:90vw}</style>\n";
    for (const fs::path& entry : entries_of(folder))
        if (entry.extension() == ".png") {
            const std::string name = text_of(entry.stem());
            page += "<figure><img src=\"" + name + ".png\"><figcaption>" + name + "</figcaption></figure>\n";
        }
    write_file(text_of(folder / "index.html"), page);
    return folder / "index.html";
}

/// Compiles the step's program with the scene in place, and the learner's files.
void build_with_scene(const Project& project, const std::string& step, const std::string& path,
                      const std::string& text, const fs::path& folder) {
    std::cout << "building step " << number_of(step) << " with " << path << " ..." << std::endl;
    const Toolchain tools = own_toolchain(project, step);
    precompile_headers(tools, step);
    Change change{step, "scene", own_headers(project, step)};
    change.headers["05_mesh_bvh/program/own_scene.h"] = "#line 1 \"" + path + "\"\n" + text;
    if (const Outcome built = build_step(tools, change, folder); !built.compiled) refuse(built.log);
}

} // namespace

void write_scene(const Project& project, const std::string& name, const std::string& step,
                 std::ostream& out) {
    if (name.empty() ||
        !std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_'; }))
        throw Error("a scene's name has only letters, digits and _, such as lamp_2");
    if (step < "05") throw Error("scenes of your own are for the steps from 05 on");
    const fs::path path = scene_path(project, name);
    if (fs::exists(path)) throw Error(display_path(path) + " exists already");
    std::string text = read_file(text_of(project.root / "tools/tutor/own_scene.txt"));
    for (const auto& [mark, value] :
         {std::pair("@NAME@", name), {"@STEP@", number_of(step)}, {"@SCENE@", scene_header(project, step)}})
        for (std::size_t at; (at = text.find(mark)) != text.npos;)
            text.replace(at, std::string(mark).size(), value);
    make_folder(path.parent_path());
    write_file(text_of(path), text);
    out << "created " << display_path(path) << "\nrender it: ./learn run " << number_of(step) << " --scene "
        << name << "\n";
}

bool has_scene(const Project& project, const std::string& name) {
    std::error_code ignored;
    return fs::is_regular_file(scene_path(project, name), ignored);
}

int run_scene(const Project& project, const std::string& step, const std::string& name, const Words& flags) {
    const std::string text = scene_text(project, step, name);
    const fs::path pictures = project.workshop / "renders";
    make_folder(pictures);
    const TemporaryFolder folder(project.root / "build");
    build_with_scene(project, step, display_path(scene_path(project, name)), text, folder.path);
    Words command{text_of(folder.path / made_program)};
    append(command, flags);
    if (!sets(flags, "--out")) append(command, {"--out", text_of(pictures / path_of(name))});
    append(command, own_tree_flags(project, step, flags));
    const int code = run_process(command).code;
    if (code != 0) return code;
    std::cout << "all your scenes: " << display_path(write_gallery(pictures)) << "\n";
    return 0;
}

} // namespace rt::tutor
