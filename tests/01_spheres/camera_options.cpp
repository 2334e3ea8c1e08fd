// Facts about the camera's options: what the user sets, what keeps its default, and what is rejected.
#include "tests/check.h"

#include "01_spheres/program/options.h"

#include <string>
#include <vector>

using namespace rt;

namespace {
/// Returns the camera pose that these command-line words select.
LookAt typed(std::vector<const char*> words, const LookAt& initial, const LookAt* other = nullptr) {
    Options options("01_test", "Where does the camera stand?", {});
    const CameraOptions camera_options(options, initial);
    words.insert(words.begin(), "01_test");
    options.parse(int(words.size()), words.data());
    return other ? camera_options.look_at_or(*other) : camera_options.look_at();
}
} // namespace

TEST_CASE("options move the camera and unset options keep their defaults") {
    const LookAt initial{{1, 2, 3}, {0, 1, 0}, {0, 1, 0.5f}, 30};
    const LookAt plain = typed({}, initial);
    CHECK(plain.from == initial.from);
    CHECK(plain.at == initial.at);
    CHECK(plain.up == initial.up);
    CHECK(plain.fov == 30);
    const LookAt moved = typed({"--from", "4,5,-6", "--fov", "70"}, initial);
    CHECK(moved.from == vec3(4, 5, -6));
    CHECK(moved.at == initial.at);
    CHECK(moved.up == initial.up);
    CHECK(moved.fov == 70);
    const LookAt turned = typed({"--at", "7,8,9", "--up", "1,0,0"}, initial);
    CHECK(turned.from == initial.from);
    CHECK(turned.at == vec3(7, 8, 9));
    CHECK(turned.up == vec3(1, 0, 0));
}

TEST_CASE("options on the command line override the pose that a scene proposes") {
    const LookAt initial{{1, 2, 3}, {0, 1, 0}, {0, 1, 0}, 30}, scene{{9, 9, 9}, {8, 7, 6}, {1, 0, 0}, 55};
    const LookAt look_at = typed({"--at", "0,0,1", "--fov", "30"}, initial, &scene);
    CHECK(look_at.from == scene.from);
    CHECK(look_at.at == vec3(0, 0, 1));
    CHECK(look_at.up == scene.up);
    CHECK_MESSAGE(look_at.fov == 30,
                  "the user gave this value explicitly, even though it equals the default");
}

TEST_CASE("coordinates on the command line are relative to the scene's origin and lose no digits") {
    const LookAt initial{{1, 2, 3}, {0, 1, 0}, {0, 1, 0}, 30};
    const LookAt scene{.from = {1, 2, 3}, .at = {0, 0, 0}, .origin = {500000, 120, 4649776}};
    const LookAt look_at = typed({"--from", "500003.25,121.5,4649774.125"}, initial, &scene);
    CHECK_MESSAGE(look_at.from == vec3(3.25f, 1.5f, -1.875f), "the difference must be computed in double");
    CHECK_MESSAGE(look_at.at == vec3(0), "unset options use the scene's own values");
}

TEST_CASE("an impossible camera pose is rejected") {
    const LookAt initial{{1, 2, 3}, {0, 1, 0}, {0, 1, 0}, 30};
    CHECK_THROWS_AS(typed({"--from", "0,1,0"}, initial), Error); // from = at
    CHECK_THROWS_AS(typed({"--up", "0,0,0"}, initial), Error);   // up has no direction
    CHECK_THROWS_AS(typed({"--up", "2,2,6"}, initial), Error);   // along the line of sight
    CHECK_THROWS_AS(typed({"--from", "0,9,0"}, initial), Error); // straight above
    CHECK_THROWS_AS(typed({"--up", "0,0,0"}, initial, &initial), Error);
    CHECK_NOTHROW(typed({"--up", "0,0.001,0"}, initial)); // short, but still a direction
    std::string message;
    try {
        typed({"--from", "0,1,0"}, initial);
    } catch (const Error& error) {
        message = error.what();
    }
    CHECK_MESSAGE(message.find("--up") == std::string::npos,
                  "if --from equals --at, the message must not blame --up: ", message);
}
