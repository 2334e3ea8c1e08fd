// The line is whole even where other threads print as well.
#include "common/complain.h"

#include <iostream>

namespace rt {

int complain(const std::string& program, std::string message) {
    for (char& c : message)
        if (c == '\n' || c == '\r' || c == '\t' || c == '\x1b') c = ' ';
    std::cout << std::flush;
    std::cerr << program + ": " + message + "\n" << std::flush;
    return 2;
}

} // namespace rt
