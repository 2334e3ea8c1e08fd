// Facts about sphere lists: the meaning of the columns, and errors that name the line.
#include "common/model/sphere_list.h"

#include "tests/check.h"
#include "tests/malformed/folder.h"

#include <string>

using namespace rt;
using namespace rt::malformed;

namespace {

const std::string columns = "material,x,y,z,radius,red,green,blue,fuzz_or_ior\n";

std::vector<SphereRecord> read(const std::string& text) {
    const Folder folder;
    return read_sphere_list(folder.write("balls.csv", text));
}

/// Returns the error of reading this text, without the folder's name.
std::string error_of_text(const std::string& text) {
    const Folder folder;
    const std::string path = folder.write("balls.csv", text);
    const std::string message = error_of([&] { read_sphere_list(path); });
    return message.compare(0, path.size(), path) == 0 ? "balls.csv" + message.substr(path.size()) : message;
}

} // namespace

TEST_CASE("each line of a list is a ball whose last column is a metal's fuzz or the index of glass") {
    const auto balls = read(columns + "lambertian,0,-1000,.5,1000,0.5,.25,1,0\n"
                                      "metal,-1.5e1,2,3,0.2,0.1,0.2,0.3,0.45\n"
                                      "dielectric,1,2,3,1,1,1,1,1.5\n");
    REQUIRE(balls.size() == 3);
    CHECK(balls[0].kind == SphereRecord::Kind::matte);
    CHECK(balls[0].center == vec3(0, -1000, 0.5f));
    CHECK(balls[0].radius == 1000);
    CHECK(balls[0].albedo == vec3(0.5f, 0.25f, 1));
    CHECK(balls[1].kind == SphereRecord::Kind::metal);
    CHECK(balls[1].center == vec3(-15, 2, 3));
    CHECK(balls[1].fuzz == 0.45f);
    CHECK(balls[2].kind == SphereRecord::Kind::glass);
    CHECK(balls[2].ior == 1.5f);
}

TEST_CASE("line ends of all systems, blanks, empty lines and a byte order mark are accepted in a list") {
    const std::string row = "metal, 1 ,2,\t3,0.5,1,1,1,0.1";
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        const std::string names = columns.substr(0, columns.size() - 1);
        const auto balls = read("\xef\xbb\xbf" + names + end + end + row + end + "  " + end + row);
        REQUIRE(balls.size() == 2);
        CHECK(balls[1].center == vec3(1, 2, 3));
        CHECK(balls[1].fuzz == 0.1f);
    }
}

TEST_CASE("an error in a list is one line with the file and the line number") {
    const std::string good = "metal,1,2,3,0.5,1,1,1,0.1\n";
    CHECK(error_of_text("") == "balls.csv: contains no spheres");
    CHECK(error_of_text(columns) == "balls.csv: contains no spheres");
    CHECK(error_of_text(good) == "balls.csv:1: the first line must name the columns: "
                                 "material,x,y,z,radius,red,green,blue,fuzz_or_ior");
    CHECK(error_of_text(columns + good + "\nmetal,1,2,3,0.5,1,1,1\n") ==
          "balls.csv:4: has 8 values, not the 9 of material,x,y,z,radius,red,green,blue,fuzz_or_ior");
    CHECK(error_of_text(columns + "gold,1,2,3,0.5,1,1,1,0\n") ==
          "balls.csv:2: material \"gold\" is not one of lambertian, metal, dielectric");
    CHECK(error_of_text(columns + "metal,1,two,3,0.5,1,1,1,0\n") == "balls.csv:2: y \"two\" is not a number");
    CHECK(error_of_text(columns + "metal,1,nan,3,0.5,1,1,1,0\n") == "balls.csv:2: y \"nan\" is not a number");
    CHECK(error_of_text(columns + "metal,1,,3,0.5,1,1,1,0\n") == "balls.csv:2: y \"\" is not a number");
    CHECK(error_of_text(columns + "metal,1,2,1e99,0.5,1,1,1,0\n") ==
          "balls.csv:2: z \"1e99\" is too large a number");
    CHECK(error_of_text(columns + "metal,1,2,3,0,1,1,1,0\n") ==
          "balls.csv:2: radius \"0\" is out of range: 0.000001 to 1000000");
    CHECK(error_of_text(columns + "metal,1,2,3,-1,1,1,1,0\n") ==
          "balls.csv:2: radius \"-1\" is out of range: 0.000001 to 1000000");
    CHECK(error_of_text(columns + "lambertian,1,2,3,1,1,1.5,1,0\n") ==
          "balls.csv:2: green \"1.5\" is out of range: 0 to 1");
    CHECK(error_of_text(columns + "metal,1,2,3,1,1,1,1,2\n") ==
          "balls.csv:2: fuzz_or_ior \"2\" is out of range: a fuzz of 0 to 1");
    CHECK(error_of_text(columns + "dielectric,1,2,3,1,1,1,1,0.5\n") ==
          "balls.csv:2: fuzz_or_ior \"0.5\" is out of range: an index of 1 to 10");
    const Folder folder;
    CHECK(error_of([&] { read_sphere_list(folder / "none.csv"); }).find("no such file") != std::string::npos);
}
