// The program of the figures that explain: its first word says which.
#include "site/figures/figures.h"

#include "common/util/error.h"

#include <string>

int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "";
    if (name == "sphere_roots")
        rt::sphere_roots(argc - 1, argv + 1);
    else if (name == "lamp")
        rt::lamp(argc - 1, argv + 1);
    else if (name == "snell")
        rt::snell(argc - 1, argv + 1);
    else
        throw rt::Error("there is no figure \"" + name + "\"");
    return 0; // main() is renamed by the build, so this line is needed
}
