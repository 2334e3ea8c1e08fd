// Facts about records of proofs and runs, and about the parts of a source file that count for them.
#include "tools/tutor/record.h"

#include "common/util/file_bytes.h"
#include "tools/tutor/temporary.h"

#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>

TEST_CASE("A record is read as it was written and a file with the same content is not rewritten") {
    const rt::TemporaryFolder folder;
    const std::filesystem::path path = folder.path / "proved.txt";
    const rt::Record record{{"01_spheres", "ab"}, {"02_shadows", "cd"}};
    CHECK(rt::read_record(path).empty());
    rt::write_record(path, "# Words.\n", record);
    CHECK(rt::read_file(path.string()) == "# Words.\n01_spheres ab\n02_shadows cd\n");
    CHECK(rt::read_record(path) == record);

    const auto long_ago = std::filesystem::last_write_time(path) - std::chrono::hours(1);
    std::filesystem::last_write_time(path, long_ago);
    rt::write_record(path, "# Words.\n", record);
    CHECK(std::filesystem::last_write_time(path) == long_ago);
    rt::write_record(path, "# Words.\n", {{"01_spheres", "ef"}});
    CHECK(rt::read_record(path) == rt::Record{{"01_spheres", "ef"}});
}

TEST_CASE("Only what a compiler sees and the markers of exercises count in a source file") {
    CHECK(rt::code_only("// What it is for.\n\nint  a; // a number\n    int b;\n") == "int a; int b; ");
    CHECK(rt::code_only("    /// Says \"no\".\nint a; ///< metres\n") == "int a; ");
    CHECK(rt::code_only("    //> turn it\n    return a;\n    //< return b;\n") ==
          "//> turn it return a; //< return b; ");
    CHECK(rt::code_only("say(\"http://a.b // c\"); // spoken\n") == "say(\"http://a.b // c\"); // spoken ");
    CHECK(rt::code_only("a / b; // half\n") == rt::code_only("a / b; // a quarter\n"));
    CHECK(rt::code_only("a / b;") != rt::code_only("a * b;"));
}
