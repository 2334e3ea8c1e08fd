// Facts about written files: links, permissions and names are kept, and an error states the true reason.
#include "common/util/file_bytes.h"

#include "tests/malformed/folder.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>
#include <thread>

using namespace rt;
using namespace rt::malformed;

TEST_CASE("a file is read with the bytes that were written") {
    const Folder folder;
    std::string bytes;
    for (int i = 0; i < 100000; ++i) bytes += char(i * 7);
    write_file(folder / "a", bytes);
    CHECK(read_file(folder / "a") == bytes);
    write_file(folder / "a", "");
    CHECK(read_file(folder / "a") == "");
    CHECK(folder.files() == 1);
}

TEST_CASE("random digits never repeat") {
    CHECK(random_digits().size() == 12);
    CHECK(random_digits() != random_digits());
}

#if !defined(_WIN32)
TEST_CASE("a file keeps the permissions of the one that it replaces") {
    const Folder folder;
    for (const unsigned mode : {0600u, 0640u, 0666u, 0755u}) {
        CAPTURE(mode);
        const std::string path = folder.write("a.png", "old");
        fs::permissions(path, fs::perms(mode));
        write_file(path, "new");
        CHECK(bytes_of(path) == "new");
        CHECK(unsigned(fs::status(path).permissions()) == mode);
    }
}

TEST_CASE("a link to a file that does not exist stays a link, and its file is created") {
    const Folder folder;
    fs::create_directories(folder.path / "there");
    fs::create_symlink("there/new.png", folder.path / "a");
    fs::create_symlink(folder.path / "a", folder.path / "b");
    check_file_writable(folder / "b");
    CHECK_FALSE(fs::exists(folder.path / "there/new.png"));
    write_file(folder / "b", "new");
    CHECK(fs::is_symlink(folder.path / "a"));
    CHECK(fs::is_symlink(folder.path / "b"));
    CHECK(bytes_of(folder / "there/new.png") == "new");
    CHECK(folder.files() == 3);
}

TEST_CASE("links that lead nowhere are rejected before any work") {
    const Folder folder;
    fs::create_symlink("b", folder.path / "a");
    fs::create_symlink("a", folder.path / "b");
    fs::create_symlink("none/a.png", folder.path / "c");
    CHECK_ERROR(error_of([&] { check_file_writable(folder / "a"); }), "form a loop");
    CHECK_ERROR(error_of([&] { write_file(folder / "a", ""); }), "form a loop");
    CHECK_ERROR(error_of([&] { check_file_writable(folder / "c"); }), "none does not exist");
}

TEST_CASE("a file with two names is replaced only under the name that is written") {
    const Folder folder;
    folder.write("a", "old");
    fs::create_hard_link(folder.path / "a", folder.path / "b");
    write_file(folder / "a", "new");
    CHECK(bytes_of(folder / "a") == "new");
    CHECK(bytes_of(folder / "b") == "old");
}

TEST_CASE("a name of 255 bytes is written; a longer one is rejected before any work, with the reason") {
    const Folder folder;
    const std::string longest(255, 'n');
    check_file_writable(folder / longest);
    write_file(folder / longest, "new");
    CHECK(bytes_of(folder / longest) == "new");
    CHECK(folder.files() == 1);
    CHECK_ERROR(error_of([&] { check_file_writable(folder / (longest + "n")); }), "File name too long");
}

TEST_CASE("if two programs write the same file, each writes it completely") {
    const Folder folder;
    const std::string path = folder / "a", zeros(300000, '0'), ones(200000, '1');
    const auto write_often = [&path](const std::string& bytes) {
        for (int i = 0; i < 20; ++i) write_file(path, bytes);
    };
    write_file(path, zeros);
    int broken = 0;
    std::thread other([&] { write_often(ones); });
    for (int i = 0; i < 20; ++i) {
        write_file(path, zeros);
        const std::string now = bytes_of(path);
        broken += now != zeros && now != ones;
    }
    other.join();
    CHECK(broken == 0);
    CHECK(folder.files() == 1);
}
#endif
