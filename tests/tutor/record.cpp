// Facts about records of proofs and runs, and about the parts of a source file that count for them.
#include "tools/tutor/record.h"
#include "common/util/paths.h"

#include "common/util/file_bytes.h"
#include "tools/tutor/util.h"

#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>

TEST_CASE("A record is read as it was written and a file with the same content is not rewritten") {
    const rt::tutor::TemporaryFolder folder;
    const std::filesystem::path path = folder.path / "proved.txt";
    const rt::tutor::Record record{{"01_spheres", "ab"}, {"02_shadows", "cd"}};
    CHECK(rt::tutor::read_record(path).empty());
    rt::tutor::write_record(path, "# Words.\n", record);
    CHECK(rt::read_file(rt::text_of(path)) == "# Words.\n01_spheres ab\n02_shadows cd\n");
    CHECK(rt::tutor::read_record(path) == record);

    const auto long_ago = std::filesystem::last_write_time(path) - std::chrono::hours(1);
    std::filesystem::last_write_time(path, long_ago);
    rt::tutor::write_record(path, "# Words.\n", record);
    CHECK(std::filesystem::last_write_time(path) == long_ago);
    rt::tutor::write_record(path, "# Words.\n", {{"01_spheres", "ef"}});
    CHECK(rt::tutor::read_record(path) == rt::tutor::Record{{"01_spheres", "ef"}});
}

TEST_CASE("Only what a compiler sees and the markers of exercises count in a source file") {
    CHECK(rt::tutor::code_only("// What it is for.\n\nint  a; // a number\n    int b;\n") ==
          "int a; int b; ");
    CHECK(rt::tutor::code_only("    /// Says \"no\".\nint a; ///< metres\n") == "int a; ");
    CHECK(rt::tutor::code_only("    //> turn it\n    return a;\n    //< return b;\n") ==
          "//> return a; //< return b; ");
    CHECK(rt::tutor::code_only("say(\"http://a.b // c\"); // spoken\n") ==
          "say(\"http://a.b // c\"); // spoken ");
    CHECK(rt::tutor::code_only("a / b; // half\n") == rt::tutor::code_only("a / b; // a quarter\n"));
    CHECK(rt::tutor::code_only("a / b;") != rt::tutor::code_only("a * b;"));
}
