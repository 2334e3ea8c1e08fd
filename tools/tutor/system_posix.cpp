// Implements processes, locks and terminals for POSIX systems.
#include "tools/tutor/system.h"

#include "common/util/report_error.h"
#include "common/util/error.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <iostream>
#include <poll.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <termios.h>
#include <thread>
#include <unistd.h>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

constexpr int could_not_start = 127;
volatile std::sig_atomic_t stop_signal = 0;
std::function<bool()> is_cancelled;

extern "C" void note_stop(int signal) {
    stop_signal = signal;
}

std::vector<char*> pointers_to(Words& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

void set_limit(int resource, rlim_t value) {
    const rlimit both{value, value};
    setrlimit(decltype(RLIMIT_CPU)(resource), &both);
}

/// Runs in the child after fork(), where only async-signal-safe calls are allowed. `out` replaces stdout
/// unless it is negative.
[[noreturn]] void start(char* const* arguments, const char* log, int out, const ProcessOptions& options) {
    const int nothing = open("/dev/null", O_RDONLY);
    const int file = *log ? open(log, O_WRONLY | O_CREAT | (options.append ? O_APPEND : O_TRUNC), 0644) : -1;
    const bool ready = dup2(nothing, 0) == 0 && (!*log || (dup2(file, 1) == 1 && dup2(file, 2) == 2)) &&
                       (out < 0 || dup2(out, 1) == 1);
    if (!ready) _exit(could_not_start);
    set_limit(RLIMIT_CORE, 0);
    if (options.cpu_seconds > 0) set_limit(RLIMIT_CPU, rlim_t(options.cpu_seconds));
    if (options.memory > 0) set_limit(RLIMIT_AS, rlim_t(options.memory));
    alarm(unsigned(options.seconds));
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_DFL);
    execvp(arguments[0], arguments);
    _exit(could_not_start);
}

/// Passes a stop signal on to the child, except for Ctrl-C, which the terminal sends to both.
void pass_on_stop(pid_t child) {
    if (stop_signal == SIGTERM || stop_signal == SIGHUP) kill(child, stop_signal);
}

void read_output(int pipe, pid_t child, const ProcessOptions& options) {
    char bytes[4096];
    for (ssize_t count; (count = read(pipe, bytes, sizeof bytes)) != 0;) {
        if (count < 0 && errno != EINTR) break;
        if (count < 0) pass_on_stop(child);
        const std::string_view text(bytes, std::size_t(std::max<ssize_t>(count, 0)));
        *options.output += text;
        if (options.echo) std::cout << text << std::flush;
    }
    close(pipe);
}

/// Waits for the child; stops it if the question of cancel_if is answered with yes.
void wait_for(pid_t child, int& status, rusage& used) {
    while (is_cancelled) {
        const pid_t ended = wait4(child, &status, WNOHANG, &used);
        if (ended == child) return;
        if (is_cancelled()) {
            kill(child, SIGTERM);
            while (wait4(child, &status, 0, &used) < 0 && errno == EINTR) pass_on_stop(child);
            throw Cancelled();
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    while (wait4(child, &status, 0, &used) < 0 && errno == EINTR) pass_on_stop(child);
}

std::string crash_text(int signal) {
    switch (signal) {
    case SIGSEGV: return "crashed: invalid memory access (an index out of range, or endless recursion?)";
    case SIGABRT: return "aborted: an assertion in the program failed";
    case SIGFPE: return "crashed: integer division by zero";
    case SIGTRAP:
    case SIGILL: return "crashed: invalid instruction (a function without a return statement?)";
    case SIGBUS: return "crashed: invalid memory access";
    default: return "";
    }
}

} // namespace

ProcessResult run_process(const Words& command, const ProcessOptions& options) {
    Words words = command;
    const std::vector<char*> arguments = pointers_to(words);
    const std::string log = text_of(options.log);
    int ends[2] = {-1, -1};
    if (options.output && pipe(ends) != 0) throw Error("cannot start " + command[0] + ": no pipe");
    for (const int end : ends) fcntl(end, F_SETFD, FD_CLOEXEC);
    std::cout.flush();
    const pid_t child = fork();
    if (child < 0) throw Error("cannot start " + command[0] + ": the system cannot create another process");
    if (child == 0) start(arguments.data(), log.c_str(), ends[1], options);
    close(ends[1]);
    if (options.output) read_output(ends[0], child, options);
    int status = 0;
    rusage used{};
    wait_for(child, status, used);
    if (stop_signal != 0) throw Stop{128 + stop_signal};
    const auto seconds = [](const timeval& time) {
        return double(time.tv_sec) + 1e-6 * double(time.tv_usec);
    };
    const double cpu = seconds(used.ru_utime) + seconds(used.ru_stime);
    if (WIFEXITED(status)) {
        if (WEXITSTATUS(status) == could_not_start) throw Error("cannot run " + command[0]);
        return {WEXITSTATUS(status), false, cpu, ""};
    }
    const int signal = WTERMSIG(status);
    const bool timed_out = signal == SIGALRM || signal == SIGXCPU || signal == SIGKILL;
    return {128 + signal, timed_out, cpu, crash_text(signal)};
}

void replace_process(const Words& command) {
    std::cout.flush();
    for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_DFL);
    Words words = command;
    execvp(words[0].c_str(), pointers_to(words).data());
    throw Error("cannot run " + command[0] + ": " + std::strerror(errno));
}

void handle_signals() {
    struct sigaction action {
    }, before{};
    action.sa_handler = note_stop; // without SA_RESTART, so that a signal interrupts waiting
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
        sigaction(signal, nullptr, &before);
        if (before.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr); // nohup sets HUP to ignored
    }
}

void cancel_if(std::function<bool()> question) {
    is_cancelled = std::move(question);
}

bool open_page(const fs::path& page) {
    const std::string script = "for opener in wslview xdg-open open; do\n"
                               "    command -v $opener >/dev/null || continue\n"
                               "    $opener \"$1\" >/dev/null 2>&1 &\n"
                               "    exit 0\n"
                               "done\n"
                               "exit 1";
    return run_process({"sh", "-c", script, "sh", text_of(fs::absolute(page))}).code == 0;
}

BuildLock::BuildLock(const fs::path& build) {
    const fs::path place = fs::absolute(build / "").lexically_normal().parent_path().parent_path();
    folder = open(place.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder < 0) return;
    for (int tries = 0; flock(int(folder), LOCK_EX | LOCK_NB) != 0; ++tries) {
        if (stop_signal != 0) throw Stop{128 + stop_signal};
        if (errno != EWOULDBLOCK && errno != EINTR) return;
        if (tries == 20)
            print_error_line("another ./learn is building in this folder; waiting until it is done ...");
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
}

BuildLock::~BuildLock() {
    if (folder >= 0) close(int(folder));
}

namespace {

/// The terminal's settings before and during the lifetime of Keys. Globals, because signal handlers use them.
termios terminal_before, terminal_now;

void restore_terminal() {
    tcsetattr(0, TCSANOW, &terminal_before);
}

/// Restores the terminal, then lets the signal end the program.
extern "C" void end_with_signal(int signal) {
    restore_terminal();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

/// Restore the terminal on Ctrl-Z, and set it again after `fg`; after `bg` the shell keeps it.
extern "C" void suspend(int) {
    restore_terminal();
    std::raise(SIGSTOP);
}
extern "C" void resume(int) {
    const int error = errno;
    if (tcgetpgrp(0) == getpgrp()) tcsetattr(0, TCSANOW, &terminal_now);
    errno = error;
}

/// Installs a handler, unless the parent process has set the signal to ignored, as nohup does.
void install_handler(int signal, void (*handler)(int)) {
    if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
}

} // namespace

Keys::Keys() {
    if (isatty(0) != 1 || tcgetattr(0, &terminal_before) != 0) return;
    terminal_now = terminal_before;
    terminal_now.c_lflag &= ~tcflag_t(ICANON | ECHO);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) install_handler(signal, end_with_signal);
    install_handler(SIGTSTP, suspend);
    install_handler(SIGCONT, resume);
    changed = tcsetattr(0, TCSANOW, &terminal_now) == 0;
}

Keys::~Keys() {
    if (!changed) return;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP, SIGCONT})
        std::signal(signal, SIG_DFL);
    restore_terminal();
}

std::optional<char> Keys::next(int milliseconds) const {
    if (stop_signal != 0) throw Stop{128 + stop_signal};
    pollfd input{0, POLLIN, 0};
    if (poll(&input, 1, milliseconds) <= 0) return std::nullopt;
    char key = 0;
    const auto count = read(0, &key, 1);
    if (count < 0 && errno == EINTR) return std::nullopt;
    return count == 1 ? key : 'q';
}

} // namespace rt::tutor
