// Facts about a whole run: its output, its files, and its exit code.
#include "common/cli/program.h"
#include "common/util/paths.h"

#include "common/util/error.h"
#include "common/image/image_file.h"
#include "common/util/system.h"
#include "tests/posix.h"

#include <doctest/doctest.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <new>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// A temporary folder with a unique name, deleted with its contents at the end.
class Folder {
  public:
    Folder() : path(fs::temp_directory_path() / ("raysteps_test_" + std::to_string(std::random_device{}()))) {
        fs::create_directories(path);
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string operator/(const std::string& name) const { return rt::text_of(path / rt::path_of(name)); }
    std::size_t files() const {
        return std::size_t(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
    }

  private:
    fs::path path;
};

/// Redirects a stream during its lifetime.
class Captured {
  public:
    explicit Captured(std::ostream& redirected) : stream(redirected), old(redirected.rdbuf(text.rdbuf())) {}
    ~Captured() {
        stream.rdbuf(old);
        stream.clear();
    }
    Captured(const Captured&) = delete;
    Captured& operator=(const Captured&) = delete;
    std::string str() const { return text.str(); }

  private:
    std::ostringstream text;
    std::ostream& stream;
    std::streambuf* old;
};

struct Run {
    int code = -1;
    bool body_called = false;
    std::string out, err;
};

rt::vec3 gradient(rt::PixelSample& sample) {
    ++rt::ray_stats.rays;
    return {float(sample.x) / 8, float(sample.y) / 5, sample.random.get_1d()};
}

Run run(const std::vector<std::string>& words, const std::function<void(const rt::RenderFunction&)>& body) {
    rt::RenderSettings small;
    small.width = 8;
    small.height = 5;
    small.samples = 2;
    small.threads = 1;
    rt::Options options("00_test", "Does it run?", small);
    std::vector<const char*> argv{"00_test"};
    for (const std::string& word : words) argv.push_back(word.c_str());
    Run result;
    const Captured out(std::cout), err(std::cerr);
    result.code =
        rt::run_program(options, int(argv.size()), argv.data(), [&](const rt::RenderFunction& render) {
            result.body_called = true;
            body(render);
        });
    result.out = out.str();
    result.err = err.str();
    return result;
}

Run run(const std::vector<std::string>& words, const rt::SampleFunction& radiance = gradient) {
    return run(words, [&radiance](const rt::RenderFunction& render) { render(radiance); });
}

std::string bytes_of(const std::string& path) {
    std::ifstream stream(rt::path_of(path), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

void put(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

bool contains(const std::string& text, const std::string& fragment) {
    return text.find(fragment) != std::string::npos;
}

/// Checks for rejection before any work: exit code 2, one line on stderr that
/// contains `fragment`, empty stdout.
void check_refused(const Run& result, const std::string& fragment) {
    CAPTURE(result.err);
    CHECK(result.code == 2);
    CHECK_FALSE(result.body_called);
    CHECK(result.out.empty());
    CHECK(result.err.rfind("00_test: ", 0) == 0);
    CHECK(result.err.find('\n') == result.err.size() - 1);
    CAPTURE(fragment);
    CHECK(contains(result.err, fragment));
}

} // namespace

TEST_CASE("a run writes both pictures under the name given by --out and nothing else") {
    const Folder folder;
    const Run result = run({"--out", folder / "a.b/../picture"});
    CHECK(result.code == 2); // the folder a.b does not exist
    const Run good = run({"--out", folder / "picture"});
    CHECK(good.code == 0);
    CHECK(good.err.empty());
    CHECK(folder.files() == 2);
    CHECK(rt::read_image(folder / "picture.png").width == 8);
    const rt::Image light = rt::read_image(folder / "picture.hdr");
    CHECK(light.height == 5);
    CHECK(light(4, 2).x == doctest::Approx(0.5).epsilon(0.01));
    CHECK(light(4, 2).y == doctest::Approx(0.4).epsilon(0.01));
}

TEST_CASE("an extension selects a single file in any folder") {
    const Folder folder;
    fs::create_directory(folder / "a.b");
    CHECK(run({"--out", folder / "one.png"}).code == 0);
    CHECK(run({"--out", folder / "two.hdr"}).code == 0);
    CHECK(run({"--out", folder / "a.b/three"}).code == 0); // the dot belongs to the folder
    CHECK(fs::exists(folder / "one.png"));
    CHECK(fs::exists(folder / "two.hdr"));
    CHECK(fs::exists(folder / "a.b/three.png"));
    CHECK(fs::exists(folder / "a.b/three.hdr"));
    CHECK(folder.files() == 3);
}

TEST_CASE("a run prints its settings, its cost and the names of its files") {
    const Folder folder;
    const Run result = run({"--out", folder / "p", "--seed", "7"});
    std::istringstream lines(result.out);
    std::string line;
    std::getline(lines, line);
    CHECK(line == "8 x 5, 2 samples a pixel, seed 7, 1 thread");
    std::getline(lines, line);
    CHECK(line.rfind("time 0.", 0) == 0);
    CHECK(contains(line, " s, 80 rays, "));
    CHECK(contains(line, " million rays a second"));
    std::getline(lines, line);
    CHECK(line == "wrote " + (folder / "p.png"));
    std::getline(lines, line);
    CHECK(line == "wrote " + (folder / "p.hdr"));
    CHECK_FALSE(std::getline(lines, line));
}

TEST_CASE("a run with a crop reports it and writes only that part") {
    const Folder folder;
    const Run result = run({"--out", folder / "p.hdr", "--crop", "1,2,7,5", "--samples", "1"});
    CHECK(result.out.rfind("crop 1,2 to 7,5 of 8 x 5, 1 sample a pixel, seed 1, 1 thread\n", 0) == 0);
    const rt::Image light = rt::read_image(folder / "p.hdr");
    CHECK(light.width == 6);
    CHECK(light.height == 3);
    CHECK(light(0, 0).y == doctest::Approx(0.4).epsilon(0.01));
}

TEST_CASE("a run that counts box and triangle tests reports their number per ray") {
    const Folder folder;
    const Run result = run({"--out", folder / "p"}, rt::SampleFunction([](rt::PixelSample&) {
                               rt::ray_stats.rays += 2;
                               rt::ray_stats.box_tests += 47;
                               rt::ray_stats.triangle_tests += 9;
                               return rt::vec3(0);
                           }));
    CHECK(contains(result.out, "\nbox tests a ray 23.5, triangle tests a ray 4.5\n"));
    CHECK_FALSE(contains(run({"--out", folder / "q"}).out, "box tests"));
}

TEST_CASE("a quiet run prints the names of its files and nothing else") {
    const Folder folder;
    const Run result = run({"--quiet", "--out", folder / "p"});
    CHECK(result.out == "wrote " + (folder / "p.png") + "\nwrote " + (folder / "p.hdr") + "\n");
    CHECK(result.err.empty());
}

TEST_CASE("bad input ends with one line and code 2 and leaves old files unchanged") {
    const Folder folder;
    put(folder / "p.png", "old picture");
    put(folder / "p.hdr", "old light");
    const std::string out = folder / "p";
    check_refused(run({"--out", out, "--width", "0"}), "--width \"0\" is not a whole number from 1 to 65536");
    check_refused(run({"--out", out, "--wibble"}), "--wibble");
    check_refused(run({"--out", out, "--crop", "0,0,9,1"}), "--crop \"0,0,9,1\"");
    check_refused(run({"--out", out, "--width", "65536", "--height", "65536"}), "65536 x 65536");
    check_refused(run({"--out", out, "--line\nbreak"}), "--line?break");
    CHECK(bytes_of(folder / "p.png") == "old picture");
    CHECK(bytes_of(folder / "p.hdr") == "old light");
    CHECK(folder.files() == 2);
}

TEST_CASE("an output that cannot be written is rejected before the scene is built") {
    const Folder folder;
    fs::create_directory(folder / "taken.png");
    fs::create_directory(folder / "pictures");
    put(folder / "plain", "");
    check_refused(run({"--out", folder / "missing/p.png"}), "missing");
    check_refused(run({"--out", folder / "plain/p.png"}), "plain");
    check_refused(run({"--out", folder / "taken.png"}), "folder");
    check_refused(run({"--out", folder / "taken"}), "taken.png");
    check_refused(run({"--out", folder / "p.jpg"}), "NAME.png, NAME.hdr, or NAME alone for both");
    check_refused(run({"--out", folder / "v1.5"}), "ends in .5");
    check_refused(run({"--out", (folder / "sub") + "/"}), "is a folder");
    check_refused(run({"--out", folder / ""}), "is a folder");
    check_refused(run({"--out", folder / "pictures"}), "pictures is a folder: name a file in it");
    check_refused(run({"--out", folder / "."}), "is a folder");
    CHECK(folder.files() == 3);
}

#if !defined(_WIN32)
TEST_CASE("an output in a folder without permission is rejected before the scene is built") {
    if (geteuid() == 0) {
        MESSAGE("skipped: root can write everywhere");
        return;
    }
    const Folder folder;
    fs::create_directory(folder / "locked");
    fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    check_refused(run({"--out", folder / "locked/p"}), "locked/p");
    fs::permissions(folder / "locked", fs::perms::owner_all);
}
#endif

TEST_CASE("the variance goes to a separate file and needs two samples") {
    const Folder folder;
    const std::string out = folder / "p";
    const Run good =
        run({"--out", out, "--variance", folder / "v.hdr"}, rt::SampleFunction([](rt::PixelSample& sample) {
                return rt::vec3(sample.index == 0 ? 1.0f : 3.0f);
            }));
    CHECK(good.code == 0);
    CHECK(contains(good.out, "wrote " + (folder / "v.hdr") + "\n"));
    const rt::Image variance = rt::read_image(folder / "v.hdr");
    CHECK(variance.width == 8);
    CHECK(variance(3, 3).x == doctest::Approx(1).epsilon(0.01)); // ((1 + 9) / 2 - 2^2) / 1
    CHECK(rt::read_image(folder / "p.hdr")(3, 3).x == doctest::Approx(2).epsilon(0.01));
    check_refused(run({"--out", out, "--variance", folder / "v.hdr", "--samples", "1"}),
                  "--samples 2 or more");
    check_refused(run({"--out", out, "--variance", folder / "v.png"}), "not an .hdr file");
    check_refused(run({"--out", out, "--variance", folder / "v"}), "not an .hdr file");
    check_refused(run({"--out", out, "--variance", folder / "p.hdr"}), "also the picture's file");
    check_refused(run({"--out", out, "--variance", folder / "./p.hdr"}), "also the picture's file");
    check_refused(run({"--out", out, "--variance", folder / "missing/v.hdr"}), "missing");
}

TEST_CASE("samples that are not finite cause a warning even in quiet runs and their pixels are magenta") {
    const Folder folder;
    const Run result =
        run({"--quiet", "--out", folder / "p"}, rt::SampleFunction([](rt::PixelSample& sample) {
                const bool sick = sample.x == 3 && sample.y >= 2 && sample.index == 1;
                return rt::vec3(sick ? std::numeric_limits<float>::quiet_NaN() : 0.25f);
            }));
    CHECK(result.code == 0);
    CHECK(result.err == "00_test: warning: 3 samples are not finite, the first at pixel 3,2 sample 2: their "
                        "pixels are magenta\n");
    CHECK(rt::read_image(folder / "p.png")(3, 2) == rt::vec3(1, 0, 1));
    CHECK(rt::read_image(folder / "p.png")(2, 2).y > 0.2f);
}

TEST_CASE("an error while the scene is built or rendered leaves old files unchanged") {
    const Folder folder;
    put(folder / "p.png", "old picture");
    const std::vector<std::string> words{"--out", folder / "p.png"};
    const auto failing = [&words](auto problem) {
        return run(words, [problem](const rt::RenderFunction&) { throw problem; });
    };
    const auto late = [&words](auto problem) {
        return run(words, rt::SampleFunction([problem](rt::PixelSample&) -> rt::vec3 { throw problem; }));
    };
    CHECK(failing(rt::Error("cow.obj:7: no such corner")).err == "00_test: cow.obj:7: no such corner\n");
    CHECK(failing(rt::Error("x")).code == 2);
    CHECK(contains(failing(std::bad_alloc()).err, "not enough memory"));
    CHECK(failing(std::bad_alloc()).code == 2);
    CHECK(late(std::runtime_error("in a thread")).err == "00_test: in a thread\n");
    CHECK(late(std::runtime_error("in a thread")).code == 2);
    CHECK(bytes_of(folder / "p.png") == "old picture");
    CHECK(folder.files() == 1);
}

TEST_CASE("a body that never renders or renders twice is an error") {
    const Folder folder;
    const Run never = run({"--out", folder / "p"}, [](const rt::RenderFunction&) {});
    CHECK(never.code == 2);
    CHECK(contains(never.err, "never calls render"));
    const Run twice = run({"--out", folder / "p"}, [](const rt::RenderFunction& render) {
        render(gradient);
        render(gradient);
    });
    CHECK(twice.code == 2);
    CHECK(contains(twice.err, "twice"));
    CHECK(folder.files() == 0);
}

TEST_CASE("help is printed on stdout with exit code 0 and writes nothing") {
    const Run result = run({"--help"});
    CHECK(result.code == 0);
    CHECK_FALSE(result.body_called);
    CHECK(result.err.empty());
    CHECK(result.out.rfind("00_test: Does it run?\n", 0) == 0);
}

TEST_CASE("a report that cannot be printed is an error") {
    struct Full : std::streambuf {}; // accepts nothing, like a full disk
    const Folder folder;
    Full full;
    rt::Options options("00_test", "Does it run?", {});
    const std::string out = folder / "p";
    const std::vector<const char*> argv{"00_test", "--width", "2", "--height", "2", "--out", out.c_str()};
    const Captured err(std::cerr);
    std::streambuf* const old = std::cout.rdbuf(&full);
    const int code = rt::run_program(options, int(argv.size()), argv.data(),
                                     [](const rt::RenderFunction& render) { render(gradient); });
    std::cout.rdbuf(old);
    std::cout.clear();
    CHECK(code == 2);
    CHECK(contains(err.str(), "stdout"));
    CHECK(fs::exists(folder / "p.png"));
}

TEST_CASE("a program lists the learner's headers that it is built with and prints nothing without any") {
    const Folder folder;
    for (const std::string own : {"03_mirror/mirror.h, 03_mirror/scene.h", ""}) {
        rt::Options options("00_test", "Does it run?", {});
        const std::string out = folder / "p";
        const std::vector<const char*> argv{"00_test", "--width", "2", "--height", "2", "--out", out.c_str()};
        const Captured said(std::cout);
        const auto body = [](const rt::RenderFunction& render) { render(gradient); };
        CHECK(rt::run_program(options, int(argv.size()), argv.data(), body, own) == 0);
        CHECK(contains(said.str(), "using your " + own + "\n") == !own.empty());
        CHECK(contains(said.str(), "using your") == !own.empty());
    }
}

TEST_CASE("an extension in capitals is the same extension") {
    const Folder folder;
    CHECK(run({"--out", folder / "a.PNG"}).code == 0);
    CHECK(run({"--out", folder / "b.Hdr", "--variance", folder / "v.HDR"}).code == 0);
    CHECK(rt::read_image(folder / "a.PNG").width == 8);
    CHECK(rt::read_image(folder / "b.Hdr").width == 8);
    CHECK(folder.files() == 3);
}

#if !defined(_WIN32)
namespace {

/// Sets an environment variable to another value during its lifetime.
class Variable {
  public:
    Variable(const char* name_, const std::string& value) : name(name_) {
        if (const char* const old = std::getenv(name)) before = old;
        rt::set_environment(name, value);
    }
    ~Variable() { rt::set_environment(name, before.value_or("")); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

  private:
    const char* const name;
    std::optional<std::string> before;
};

/// Runs a program whose folder is deleted while it renders.
Run run_without_folder(const std::vector<std::string>& words, const fs::path& gone) {
    return run(words, [&gone](const rt::RenderFunction& render) {
        render(gradient);
        fs::remove_all(gone);
    });
}

/// Returns the path in the line "wrote PATH" that ends in `ending`.
std::string written(const Run& result, const std::string& ending) {
    std::istringstream lines(result.out);
    for (std::string line; std::getline(lines, line);)
        if (line.rfind("wrote ", 0) == 0 && line.substr(line.size() - 4) == ending) return line.substr(6);
    return "";
}

} // namespace

TEST_CASE("a finished picture is saved in the temporary folder if its own folder is gone") {
    const Folder folder, temporary;
    const Variable place("TMPDIR", temporary / "");
    fs::create_directory(folder / "here");
    const Run result = run_without_folder({"--out", folder / "here/p"}, folder / "here");
    CHECK(result.code == 2);
    CHECK(contains(result.err, "here/p.png: the folder " + folder / "here"));
    for (const std::string ending : {".png", ".hdr"}) {
        const std::string path = written(result, ending);
        CHECK(path.rfind(temporary / "00_test-", 0) == 0);
        CHECK(contains(result.err, "; the new picture is " + path + "\n"));
        CHECK(rt::read_image(path).width == 8);
        CHECK((fs::status(path).permissions() & fs::perms::others_all) == fs::perms::none);
    }
    CHECK(temporary.files() == 2);
}

TEST_CASE("a finished picture is saved in the home folder if there is no temporary folder") {
    const Folder folder, home;
    const Variable place("TMPDIR", folder / "none"), other("HOME", home / "");
    fs::create_directory(folder / "here");
    const Run result = run_without_folder({"--out", folder / "here/p.HDR"}, folder / "here");
    CHECK(result.code == 2);
    CHECK(rt::read_image(written(result, ".hdr")).height == 5);
    CHECK(home.files() == 1);
}

TEST_CASE("a picture that cannot be saved anywhere is reported as lost") {
    const Folder folder;
    const Variable place("TMPDIR", folder / "none"), other("HOME", "relative");
    fs::create_directory(folder / "here");
    const Run result = run_without_folder({"--out", folder / "here/p.png"}, folder / "here");
    CHECK(result.code == 2);
    CHECK(contains(result.err, "is lost\n"));
    CHECK_FALSE(contains(result.out, "wrote"));
}

TEST_CASE("a program stopped by a signal dies of that signal and leaves the old file unchanged") {
    const Folder folder;
    put(folder / "p.png", "old picture");
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        CAPTURE(number);
        const pid_t child = fork();
        if (child == 0) {
            run({"--out", folder / "p.png"}, [number](const rt::RenderFunction&) { std::raise(number); });
            _exit(0);
        }
        int status = 0;
        waitpid(child, &status, 0);
        CHECK(WIFSIGNALED(status));
        CHECK(WTERMSIG(status) == number); // a shell reports 128 + number
    }
    CHECK(bytes_of(folder / "p.png") == "old picture");
    CHECK(folder.files() == 1);
}
#endif

TEST_CASE("a picture's name may be in any alphabet and is printed as it is") {
    const Folder folder;
    for (const std::string name : {"σφαίρα.png", "картина 絵.hdr", "🖼.png"}) {
        const Run result = run({"--out", folder / name});
        CHECK(result.code == 0);
        CHECK(rt::read_image(folder / name).width == 8);
        CHECK(contains(result.out, "/" + name + "\n"));
    }
}

TEST_CASE("file names are printed without terminal control characters") {
    const Folder folder;
    const Run result = run({"--out", folder / "a\x1b[2Jb.png"});
    CHECK(result.code == 0);
    CHECK(result.out.find('\x1b') == std::string::npos);
    CHECK(contains(result.out, "a?[2Jb.png"));
    check_refused(run({"--out", folder / "\x1b[2J/p.png"}), "?[2J does not exist");
}

#if defined(SIGPIPE)
TEST_CASE("a reader that closes the pipe early does not cost the picture") {
    const Folder folder;
    const Run result = run({"--out", folder / "p"}, [](const rt::RenderFunction& render) {
        std::raise(SIGPIPE); // like `| head -1`; its default action would end this program
        render(gradient);
    });
    CHECK(result.code == 0);
    CHECK(fs::exists(folder / "p.png"));
}
#endif

TEST_CASE("the previous handler of Ctrl-C is restored after the run") {
    const Folder folder;
    void (*const mine)(int) = [](int) {};
    void (*const before)(int) = std::signal(SIGINT, mine);
    bool replaced = false;
    run({"--out", folder / "p"}, [&](const rt::RenderFunction& render) {
        replaced = std::signal(SIGINT, SIG_IGN) != mine;
        render(gradient);
    });
    CHECK(replaced);
    const bool put_back = std::signal(SIGINT, before) == mine;
    CHECK(put_back);
}
