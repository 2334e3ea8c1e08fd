// The program of the figures that explain: its first word says which.
#include "site/figures/figures.h"

#include "common/util/error.h"

#include <map>
#include <string>

int main(int argc, char** argv) {
    static const std::map<std::string, void (*)(int, const char* const*)> figures{
        {"camera", rt::camera},   {"sphere_roots", rt::sphere_roots},
        {"lamp", rt::lamp},       {"snell", rt::snell},
        {"split", rt::split},     {"texels", rt::texels},
        {"samples", rt::samples}, {"lens", rt::lens},
    };
    const auto figure = figures.find(argc > 1 ? argv[1] : "");
    if (figure == figures.end()) throw rt::Error("there is no such figure");
    figure->second(argc - 1, argv + 1);
    return 0; // main() is renamed by the build, so this line is needed
}
