// Lets the system choose the names: mkstemp and mkdtemp make what they name, or fail.
#include "tools/tutor/temporary.h"

#include "common/util/error.h"

#include <cstdlib>
#include <unistd.h>

namespace rt {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& folder) {
    throw Error(folder.string() + ": no temporary file can be made in this folder; is it writable?");
}

} // namespace

TemporaryFile::TemporaryFile(const fs::path& folder) {
    std::string name = (folder / "raysteps.XXXXXX").string();
    const int file = mkstemp(name.data());
    if (file < 0) refuse(folder);
    close(file);
    path = name;
}

TemporaryFile::~TemporaryFile() {
    std::error_code ignored;
    fs::remove(path, ignored);
}

TemporaryFolder::TemporaryFolder(const fs::path& folder) {
    std::string name = (folder / "raysteps.XXXXXX").string();
    if (!mkdtemp(name.data())) refuse(folder);
    path = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
}

} // namespace rt
