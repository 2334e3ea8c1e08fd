// flock on the open folder: no file to make or to leave behind.
#include "tools/tutor/build_lock.h"

#include "common/util/report_error.h"

#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <sys/file.h>
#include <thread>
#include <unistd.h>

namespace rt {

namespace fs = std::filesystem;

BuildLock::BuildLock(const fs::path& build) {
    const fs::path place = fs::absolute(build / "").lexically_normal().parent_path().parent_path();
    folder = open(place.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    for (int tries = 0; flock(folder, LOCK_EX | LOCK_NB) != 0; ++tries) {
        if (errno != EWOULDBLOCK && errno != EINTR) return;
        if (tries == 20) print_error_line("another ./learn is building in this folder; waiting for it ...");
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

BuildLock::~BuildLock() {
    if (folder >= 0) close(folder);
}

void await_program(const fs::path& program) {
    if (access(program.c_str(), X_OK) != 0) const BuildLock lock(program.parent_path().parent_path());
}

} // namespace rt
