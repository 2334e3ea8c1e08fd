// Starts programs as POSIX systems do.
#include "tools/tutor/process.h"

#include "common/util/error.h"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rt {

namespace {

constexpr int could_not_start = 127;

/// In the child, where only plain system calls are allowed.
[[noreturn]] void become(char* const* arguments, const char* output, const RunLimits& limits) {
    const int file = open(output, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const int nothing = open("/dev/null", O_RDONLY);
    if (file < 0 || dup2(nothing, 0) < 0 || dup2(file, 1) < 0 || dup2(file, 2) < 0) _exit(could_not_start);
    const rlimit no_core{0, 0}, cpu{rlim_t(limits.cpu_seconds), rlim_t(limits.cpu_seconds)},
        memory{rlim_t(limits.memory), rlim_t(limits.memory)};
    setrlimit(RLIMIT_CORE, &no_core);
    if (limits.cpu_seconds > 0) setrlimit(RLIMIT_CPU, &cpu);
    if (limits.memory > 0) setrlimit(RLIMIT_AS, &memory);
    alarm(unsigned(limits.seconds));
    execv(arguments[0], arguments);
    _exit(could_not_start);
}

} // namespace

Ended run_process(const std::vector<std::string>& command, const std::filesystem::path& output,
                  const RunLimits& limits) {
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const std::string path = output.string();
    const pid_t child = fork();
    if (child < 0) throw Error("cannot start " + command[0] + ": the system has no room for another process");
    if (child == 0) become(arguments.data(), path.c_str(), limits);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    if (WIFEXITED(status)) {
        if (WEXITSTATUS(status) == could_not_start) throw Error("cannot run " + command[0]);
        return {WEXITSTATUS(status), false};
    }
    const int signal = WTERMSIG(status);
    return {128 + signal, signal == SIGALRM || signal == SIGXCPU || signal == SIGKILL};
}

} // namespace rt
