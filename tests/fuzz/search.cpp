// Entry points of libFuzzer.
// fuzz --target=obj [libFuzzer's flags, folders or files]; fuzz --list prints the targets.
#include "tests/fuzz/fuzz.h"

#include <cstdint>
#include <cstdlib>
#include <iostream>

namespace {

const rt::fuzz::Target* chosen = nullptr;

} // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** words) {
    constexpr std::string_view flag = "--target=";
    for (int i = 1; i < *count; ++i) {
        const std::string_view word = (*words)[i];
        if (word.starts_with(flag)) chosen = rt::fuzz::find_target(word.substr(flag.size()));
        if (word != "--list") continue;
        for (const rt::fuzz::Target& target : rt::fuzz::targets()) std::cout << target.name << '\n';
        std::exit(0);
    }
    if (!chosen) {
        std::cerr << "fuzz: --target= names none of the targets; --list prints them\n";
        std::exit(2);
    }
    std::cerr.setstate(std::ios::failbit); // warnings about damaged files
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    chosen->run({reinterpret_cast<const char*>(bytes), size});
    return 0;
}
