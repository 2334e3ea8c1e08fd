// Prints lines with a label in front, wrapped to the terminal's width, with colours where a person sees them.
#pragma once

#include "tools/tutor/thumbnail.h"
#include "tools/tutor/util.h"

#include "common/util/report_error.h"

#include <ostream>
#include <string>

namespace rt::tutor {

enum class Colour { none, red, green, yellow, grey, bold };

class Screen {
  public:
    static constexpr std::size_t label_width = 10;

    Screen(std::ostream& out_, bool colour_, int width_)
        : out(out_), colour(colour_), width(std::size_t(std::max(width_, 40))) {}

    /// Prints "label     text", with further lines of the text below its first one. Flushes: somebody waits.
    void line(const std::string& label, const std::string& text, Colour paint = Colour::none) {
        std::string margin = cell(label, -int(label_width));
        for (const std::string& part : lines_of(text.empty() ? " " : text)) {
            for (const std::string& row : wrapped(printable(part))) {
                out << painted(margin, margin == blank() ? Colour::none : paint) << row << "\n";
                margin = blank();
            }
        }
        out << std::flush;
    }

    /// Prints a line of code as it is.
    void code(const std::string& text) { out << blank() << printable(text) << "\n"; }

    /// Shows a PNG file, where a person with a terminal that can show it looks.
    void picture(const std::string& png) {
        if (colour && terminal_shows_pictures()) out << blank() << thumbnail(png, 40) << "\n" << std::flush;
    }

    void title(const std::string& text) { out << painted(text, Colour::bold) << "\n" << std::flush; }

    std::string painted(const std::string& text, Colour paint) const {
        static const char* const codes[] = {"", "31", "32", "33", "90", "1"};
        if (!colour || paint == Colour::none) return text;
        return std::string("\x1b[") + codes[int(paint)] + "m" + text + "\x1b[0m";
    }

  private:
    static std::string blank() { return std::string(label_width, ' '); }

    Words wrapped(const std::string& text) const {
        Words rows(1);
        for (const std::string& word : words_in(text)) {
            if (!rows.back().empty() && rows.back().size() + 1 + word.size() > width - label_width)
                rows.emplace_back();
            rows.back() += (rows.back().empty() ? "" : " ") + word;
        }
        return rows;
    }

    std::ostream& out;
    bool colour;
    std::size_t width;
};

} // namespace rt::tutor
