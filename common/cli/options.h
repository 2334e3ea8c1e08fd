// Options: each is declared once, and is then a command-line flag, a line of --help with its unit, range and
// default, and a check of what the user typed.
#pragma once

#include "common/math/vec.h"
#include "common/render/settings.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace rt {

/// The value of an option that names one of a few choices; converts to its enum.
template <typename Enum>
class Choice {
  public:
    explicit Choice(const int& chosen) : index(&chosen) {}
    operator Enum() const { return Enum(*index); }

  private:
    const int* index;
};

/// Declares options, then parses a command line. Every option returns a reference that parse() fills in.
/// Names carry no dashes: option("ior", ...) becomes --ior.
class Options {
  public:
    /// `name` is the program's ("01_spheres"), `question` the sentence that opens its --help,
    /// `settings` the defaults.
    Options(std::string name, std::string question, RenderSettings settings);
    ~Options();

    /// A float or an int.
    template <typename Number>
    const Number& option(const std::string& name, Number initial, Number low, Number high,
                         const std::string& help);
    /// Three finite numbers, typed as x,y,z. In double: a model's coordinates may be far from 0.
    const dvec3& option(const std::string& name, vec3 initial, const std::string& help);
    /// Absent is false.
    const bool& flag(const std::string& name, const std::string& help);
    /// A file that is read, "" if not given; parse() refuses one that does not exist.
    const std::string& file(const std::string& name, const std::string& help);
    /// One of `names`, which stand in the order of the enum's values 0, 1, 2, ...
    template <typename Enum>
    Choice<Enum> choice(const std::string& name, const std::vector<std::string>& names, Enum initial,
                        const std::string& help) {
        return Choice<Enum>(choice_index(name, names, int(initial), help));
    }

    /// True if the user typed this option, so that a default may depend on the scene.
    bool is_set(const std::string& name) const;

    /// Throws Error with one line that says what is wrong and what would be right. Answers false after
    /// --help, when all is said and the program should end well.
    bool parse(int argc, const char* const* argv);

    const RenderSettings& settings() const;
    const std::string& name() const;

  private:
    const int& choice_index(const std::string& name, const std::vector<std::string>& names, int initial,
                            const std::string& help);
    struct Parser; // CLI11 costs seconds to compile: it is included in options.cpp alone
    std::unique_ptr<Parser> parser;
};

} // namespace rt
