// A small temporary project for a check: steps with exercises, hints, and a workshop.
#pragma once

#include "tools/tutor/workshop.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <string>

namespace rt::tutor {

/// Returns the contents of a file; "" if there is none.
inline std::string content_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void put(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

class SmallProject {
  public:
    SmallProject()
        : root(std::filesystem::temp_directory_path() /
               ("raysteps_tutor_" + std::to_string(std::random_device{}()))),
          project{root, root / "workshop"} {
        put(root / "steps/01_one/main.cpp", "// Step 01 asks: is one enough?\n");
        put(root / "steps/01_one/shape.h", shape);
        put(root / "steps/01_one/plain.h", "// Nothing to write here.\n#pragma once\n");
        put(root / "steps/02_two/main.cpp", "// Step 02 asks: or two?\n");
        put(root / "steps/02_two/base.h", base);
        put(root / "steps/02_two/above.h", above);
        put(root / "exercises/01_one/hints.md",
            "# Hints\n\n## half\n\n1. look\n   twice\n2. formula\n3. line\n\n## sign\n\n"
            "1. a\n2. b\n3. c\n");
    }
    ~SmallProject() {
        std::error_code ignored;
        std::filesystem::remove_all(root, ignored);
    }
    SmallProject(const SmallProject&) = delete;
    SmallProject& operator=(const SmallProject&) = delete;

    std::filesystem::path own(const std::string& file) const { return project.workshop / file; }

    const std::filesystem::path root;
    const Project project;

    static constexpr const char* shape = R"(// Two functions.
#pragma once

inline float half(float x) {
    //> divide by two
    return x / 2;
    //< return x;
}

template <typename T>
int sign(T x,
         T zero) {
    int result = 1;
    //> negative below zero
    if (x < zero) result = -1;
    //<
    return result;
}
)";
    static constexpr const char* base = R"(// Below.
#pragma once

#include "01_one/shape.h"

inline int twin() {
    //> one
    return 1;
    //< return 0;
}
)";
    static constexpr const char* above = R"(// Above what stands in base.h, though its name comes first.
#pragma once

#include "02_two/base.h"

inline int twin() {
    //> two
    return 2;
    //< return 0;
}

inline int both() {
    int sum = 0;
    //> add one
    sum += 1;
    //< sum += 0;
    //> add two
    sum += 2;
    //<
    return sum;
}
)";
};

/// Returns the output of a command.
template <typename Command>
std::string said_by(const Command& command) {
    std::ostringstream out;
    command(out);
    return out.str();
}

} // namespace rt::tutor
