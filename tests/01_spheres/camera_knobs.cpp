// Facts about the knobs of the camera: what is typed, what stays, and what is refused.
#include "tests/check.h"

#include "01_spheres/camera.h"

#include <string>
#include <vector>

using namespace rt;

namespace {
/// The pose that these words of a command line ask for.
Pose typed(std::vector<const char*> words, const Pose& initial, const Pose* other = nullptr) {
    Options options("01_test", "Where does the camera stand?", {});
    const CameraKnobs knobs(options, initial);
    words.insert(words.begin(), "01_test");
    options.parse(int(words.size()), words.data());
    return other ? knobs.pose(*other) : knobs.pose();
}
} // namespace

TEST_CASE("the knobs move the camera, and what is not typed stays") {
    const Pose initial{{1, 2, 3}, {0, 1, 0}, {0, 1, 0.5f}, 30};
    const Pose plain = typed({}, initial);
    CHECK(plain.from == initial.from);
    CHECK(plain.at == initial.at);
    CHECK(plain.up == initial.up);
    CHECK(plain.fov == 30);
    const Pose moved = typed({"--from", "4,5,-6", "--fov", "70"}, initial);
    CHECK(moved.from == vec3(4, 5, -6));
    CHECK(moved.at == initial.at);
    CHECK(moved.up == initial.up);
    CHECK(moved.fov == 70);
    const Pose turned = typed({"--at", "7,8,9", "--up", "1,0,0"}, initial);
    CHECK(turned.from == initial.from);
    CHECK(turned.at == vec3(7, 8, 9));
    CHECK(turned.up == vec3(1, 0, 0));
}

TEST_CASE("a pose that a scene proposes gives way to what is typed") {
    const Pose initial{{1, 2, 3}, {0, 1, 0}, {0, 1, 0}, 30}, scene{{9, 9, 9}, {8, 7, 6}, {1, 0, 0}, 55};
    const Pose pose = typed({"--at", "0,0,1", "--fov", "30"}, initial, &scene);
    CHECK(pose.from == scene.from);
    CHECK(pose.at == vec3(0, 0, 1));
    CHECK(pose.up == scene.up);
    CHECK_MESSAGE(pose.fov == 30, "it was typed, though it is the default");
}

TEST_CASE("what is typed counts from the user's origin, to the last digit") {
    const Pose initial{{1, 2, 3}, {0, 1, 0}, {0, 1, 0}, 30};
    const Pose scene{.from = {1, 2, 3}, .at = {0, 0, 0}, .origin = {500000, 120, 4649776}};
    const Pose pose = typed({"--from", "500003.25,121.5,4649774.125"}, initial, &scene);
    CHECK_MESSAGE(pose.from == vec3(3.25f, 1.5f, -1.875f), "the difference is taken in double");
    CHECK_MESSAGE(pose.at == vec3(0), "what is not typed is the scene's own");
}

TEST_CASE("a camera that cannot stand like that is refused") {
    const Pose initial{{1, 2, 3}, {0, 1, 0}, {0, 1, 0}, 30};
    CHECK_THROWS_AS(typed({"--from", "0,1,0"}, initial), Error); // from = at
    CHECK_THROWS_AS(typed({"--up", "0,0,0"}, initial), Error);   // no up
    CHECK_THROWS_AS(typed({"--up", "2,2,6"}, initial), Error);   // along the line of sight
    CHECK_THROWS_AS(typed({"--from", "0,9,0"}, initial), Error); // straight above
    CHECK_THROWS_AS(typed({"--up", "0,0,0"}, initial, &initial), Error);
    CHECK_NOTHROW(typed({"--up", "0,0.001,0"}, initial)); // short, but no less a direction
    std::string message;
    try {
        typed({"--from", "0,1,0"}, initial);
    } catch (const Error& error) {
        message = error.what();
    }
    CHECK_MESSAGE(message.find("--up") == std::string::npos,
                  "up is not to blame where --from is --at: ", message);
}
