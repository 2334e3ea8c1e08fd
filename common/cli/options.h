// Command-line options: one declaration gives the flag, its line of --help and the check of its value.
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

/// The value of an option with named choices; converts to the enum.
template <typename Enum>
class Choice {
  public:
    explicit Choice(const int& chosen) : index(&chosen) {}
    operator Enum() const { return Enum(*index); }

  private:
    const int* index;
};

/// Declares options, then parses a command line. Each declaration returns a reference that parse() fills in.
/// Names are given without dashes: option("ior", ...) becomes --ior.
class Options {
  public:
    /// `name`: the program's name ("01_spheres"). `question`: the sentence that opens --help. `settings`: the
    /// defaults of the image options.
    Options(std::string name, std::string question, RenderSettings settings);
    ~Options();

    /// Declares a number in [low, high], a float or an int.
    template <typename Number>
    const Number& option(const std::string& name, Number initial, Number low, Number high,
                         const std::string& help);
    /// Declares three finite numbers, typed as x,y,z. They are double, since a model may
    /// be far from the origin.
    const dvec3& option(const std::string& name, vec3 initial, const std::string& help);
    /// Declares a flag, false unless given.
    const bool& flag(const std::string& name, const std::string& help);
    /// Declares an input file, "" unless given. parse() throws Error if it does not exist.
    const std::string& file(const std::string& name, const std::string& help);
    /// Declares a choice among `names`, which are in the order of the enum's values 0, 1, 2, ...
    template <typename Enum>
    Choice<Enum> choice(const std::string& name, const std::vector<std::string>& names, Enum initial,
                        const std::string& help) {
        return Choice<Enum>(choice_index(name, names, int(initial), help));
    }

    /// Returns whether the option was given on the command line, so that a default may depend on the scene.
    bool is_set(const std::string& name) const;

    /// Parses a command line. Throws Error with one line that says what is wrong and what is valid. Returns
    /// false if it printed --help or --version, after which the program should exit with 0.
    bool parse(int argc, const char* const* argv);

    const RenderSettings& settings() const;
    const std::string& name() const;

  private:
    const int& choice_index(const std::string& name, const std::vector<std::string>& names, int initial,
                            const std::string& help);
    struct Parser; // CLI11 takes seconds to compile, so only options.cpp includes it
    std::unique_ptr<Parser> parser;
};

} // namespace rt
