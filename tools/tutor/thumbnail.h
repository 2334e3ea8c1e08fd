// Pictures in the terminals that can show them: by kitty's graphics protocol, which WezTerm and Ghostty know, too.
#pragma once

#include "tools/tutor/report.h"

#include <cstdlib>
#include <string>
#include <string_view>

namespace rt::tutor {

/// Whether the terminal says that it shows pictures. Inside tmux and screen it does not.
inline bool terminal_shows_pictures() {
    const auto variable = [](const char* name) -> std::string_view {
        const char* const value = std::getenv(name);
        return value ? value : "";
    };
    if (!variable("TMUX").empty() || !variable("STY").empty()) return false;
    const std::string_view terminal = variable("TERM"), program = variable("TERM_PROGRAM");
    return !variable("KITTY_WINDOW_ID").empty() || terminal == "xterm-kitty" || terminal == "xterm-ghostty" ||
           program == "WezTerm" || program == "ghostty";
}

/// Returns the escape sequence that shows a PNG file: Base64 in chunks of 4096 bytes, of which all but the last say m=1.
/// a=T: show; f=100: PNG; q=2: do not answer; c: width in columns.
inline std::string thumbnail(std::string_view png, int columns) {
    constexpr std::size_t chunk = 4096;
    const std::string data = base64(png);
    std::string escape, keys = "a=T,f=100,q=2,c=" + std::to_string(columns) + ",";
    for (std::size_t at = 0; at < data.size(); at += chunk) {
        const bool is_last = at + chunk >= data.size();
        escape += "\x1b_G" + keys + (is_last ? "m=0;" : "m=1;") + data.substr(at, chunk) + "\x1b\\";
        keys.clear();
    }
    return escape;
}

} // namespace rt::tutor
