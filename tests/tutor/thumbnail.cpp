// Facts about pictures in a terminal: only where it can show them, and in the form that it expects.
#include "tools/tutor/screen.h"
#include "tools/tutor/system.h"
#include "tools/tutor/thumbnail.h"

#include <doctest/doctest.h>

#include <sstream>

using namespace rt;
using namespace rt::tutor;

namespace {

/// Sets the variables by which a terminal is known, and no others.
bool shows_pictures(const std::string& name, const std::string& value) {
    for (const char* other : {"TMUX", "STY", "TERM", "TERM_PROGRAM", "KITTY_WINDOW_ID"})
        set_environment(other, "");
    set_environment(name, value);
    return terminal_shows_pictures();
}

} // namespace

TEST_CASE("pictures are shown only in terminals that say they can") {
    CHECK(shows_pictures("TERM", "xterm-kitty"));
    CHECK(shows_pictures("KITTY_WINDOW_ID", "1"));
    CHECK(shows_pictures("TERM_PROGRAM", "WezTerm"));
    CHECK(shows_pictures("TERM_PROGRAM", "ghostty"));
    for (const char* terminal : {"", "dumb", "linux", "xterm-256color", "screen"})
        CHECK_FALSE(shows_pictures("TERM", terminal));
    CHECK(shows_pictures("TERM", "xterm-kitty"));
    set_environment("TMUX", "/tmp/tmux,1,0");
    CHECK_FALSE(terminal_shows_pictures());
    set_environment("TMUX", "");
}

TEST_CASE("a picture is sent in chunks and only the first describes it") {
    CHECK(thumbnail("abc", 40) == "\x1b_Ga=T,f=100,q=2,c=40,m=0;YWJj\x1b\\");
    CHECK(thumbnail("", 40).empty());
    const std::string png(9000, 'x'), sent = thumbnail(png, 30); // 12,000 digits
    CHECK(sent.starts_with("\x1b_Ga=T,f=100,q=2,c=30,m=1;eHh4"));
    std::string data;
    std::size_t chunks = 0;
    for (std::size_t at = 0; (at = sent.find("\x1b_G", at)) != sent.npos; ++chunks) {
        const std::size_t begin = sent.find(';', at) + 1, end = sent.find("\x1b\\", begin);
        CHECK(end - begin <= 4096);
        CHECK(sent.substr(begin - 2, 1) == (end + 2 == sent.size() ? "0" : "1"));
        data += sent.substr(begin, end - begin);
        at = end;
    }
    CHECK(chunks == 3);
    CHECK(data == base64(png));
}

TEST_CASE("a screen without colours has no pictures") {
    shows_pictures("TERM", "xterm-kitty");
    std::ostringstream plain, coloured;
    Screen(plain, false, 80).picture("abc");
    CHECK(plain.str().empty());
    Screen(coloured, true, 80).picture("abc");
    CHECK(coloured.str() == "          " + thumbnail("abc", 40) + "\n");
    set_environment("TERM", "");
}
