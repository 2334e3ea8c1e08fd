// What the fuzz targets share.
// A target accepts any bytes: it may reject them with an Error of one line, and must keep every promise of
// the code that it calls; any other outcome is a finding.
#pragma once

#include "common/util/error.h"

#include <span>
#include <string>
#include <string_view>

namespace rt::fuzz {

/// Throws std::logic_error with the broken promise if `holds` is false.
void require(bool holds, const char* promise);

/// Returns the folder of this process for input files; it is removed at the end.
const std::string& folder();

/// Writes a file into folder() and returns its path.
std::string write_input(const std::string& name, std::string_view bytes);

/// Calls `action` and returns the line with which it rejects its input, or "" if it accepts it.
template <typename Action>
std::string refusal(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        const std::string line = error.what();
        require(!line.empty() && line.find('\n') == std::string::npos, "a rejection is one line");
        return line;
    }
    return "";
}

/// The text up to the first line end, and what follows it.
struct Parts {
    std::string first, rest;
};
Parts first_line(std::string_view text);

struct Target {
    const char* name;
    void (*run)(std::string_view bytes);
};

std::span<const Target> targets();

/// Returns the target of this name, or null.
const Target* find_target(std::string_view name);

void run_catalogue(std::string_view bytes);
void run_hdr(std::string_view bytes);
void run_json(std::string_view bytes);
void run_mtl(std::string_view bytes);
void run_numbers(std::string_view bytes);
void run_obj(std::string_view bytes);
void run_obj_text(std::string_view bytes);
void run_options(std::string_view bytes);
void run_picture(std::string_view bytes);
void run_sphere_list(std::string_view bytes);
void run_tga(std::string_view bytes);
void run_tutor(std::string_view bytes);
void run_weave(std::string_view bytes);

} // namespace rt::fuzz
