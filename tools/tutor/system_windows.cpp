// Implements processes, locks and terminals for Windows.
#include "tools/tutor/system.h"

#include "common/util/report_error.h"

#define WIN32_LEAN_AND_MEAN
#ifndef NOMINMAX
#define NOMINMAX
#endif
#include <windows.h>

#include <shellapi.h>

#include <atomic>
#include <conio.h>
#include <cstdlib>
#include <future>
#include <iostream>
#include <mutex>

namespace rt::tutor {

namespace fs = std::filesystem;

namespace {

std::atomic<bool> is_stopped = false;
std::function<bool()> is_cancelled;

/// Exit codes: the first of those that a crash gives, STATUS_QUOTA_EXCEEDED, and that of abort().
constexpr DWORD first_crash = 0xc0000000, quota_exceeded = 0xc0000044, abort_code = 3;

BOOL WINAPI note_stop(DWORD) {
    is_stopped = true;
    return TRUE;
}

/// A handle that is closed at the end.
class Handle {
  public:
    Handle(HANDLE handle_ = nullptr) : handle(handle_ == INVALID_HANDLE_VALUE ? nullptr : handle_) {}
    ~Handle() { close(); }
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;

    void close() {
        if (handle) CloseHandle(handle);
        handle = nullptr;
    }

    HANDLE handle;
};

/// Quotes one word, so that the program's runtime takes the command line apart into the same words again:
/// quotes get a backslash, and so do the backslashes before a quote.
std::string quoted(const std::string& word) {
    if (!word.empty() && word.find_first_of(" \t\n\v\"") == word.npos) return word;
    std::string text = "\"";
    std::size_t backslashes = 0;
    for (const char c : word) {
        if (c == '"') text.append(backslashes + 1, '\\');
        backslashes = c == '\\' ? backslashes + 1 : 0;
        text += c;
    }
    return text.append(backslashes, '\\') + "\"";
}

/// Opens a file for a child; /dev/null becomes NUL.
HANDLE opened(const fs::path& path, DWORD access, DWORD how) {
    const wchar_t* const name = path == "/dev/null" ? L"NUL" : path.c_str();
    return CreateFileW(name, access, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr, how, FILE_ATTRIBUTE_NORMAL,
                       nullptr);
}

/// A job holds a program and all that it starts to their limits, and ends them when the job is closed.
HANDLE job_with(const ProcessOptions& options) {
    const HANDLE job = CreateJobObjectW(nullptr, nullptr);
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION info{};
    info.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
    if (options.memory > 0) {
        info.BasicLimitInformation.LimitFlags |= JOB_OBJECT_LIMIT_PROCESS_MEMORY;
        info.ProcessMemoryLimit = SIZE_T(options.memory);
    }
    SetInformationJobObject(job, JobObjectExtendedLimitInformation, &info, sizeof info);
    return job;
}

/// The streams of a child.
struct Streams {
    HANDLE in = GetStdHandle(STD_INPUT_HANDLE), out = GetStdHandle(STD_OUTPUT_HANDLE),
           err = GetStdHandle(STD_ERROR_HANDLE);

    void inherit(bool yes) const {
        for (const HANDLE handle : {in, out, err})
            SetHandleInformation(handle, HANDLE_FLAG_INHERIT, yes ? HANDLE_FLAG_INHERIT : 0);
    }
};

/// Starts a program in the job. Returns its process. Throws Error.
HANDLE start(const Words& command, const Streams& streams, HANDLE job) {
    static std::mutex mutex; // so that no other child inherits these streams
    const std::lock_guard lock(mutex);
    std::string line;
    for (const std::string& word : command) line += (line.empty() ? "" : " ") + quoted(word);
    std::wstring words = path_of(line).native(); // a mere conversion from UTF-8
    STARTUPINFOW info{};
    info.cb = sizeof info;
    info.dwFlags = STARTF_USESTDHANDLES;
    info.hStdInput = streams.in;
    info.hStdOutput = streams.out;
    info.hStdError = streams.err;
    PROCESS_INFORMATION child{};
    SetErrorMode(SEM_FAILCRITICALERRORS |
                 SEM_NOGPFAULTERRORBOX); // children crash without a window that waits
    streams.inherit(true);
    const BOOL started = CreateProcessW(nullptr, words.data(), nullptr, nullptr, TRUE, CREATE_SUSPENDED,
                                        nullptr, nullptr, &info, &child);
    streams.inherit(false);
    if (!started) throw Error("cannot run " + command[0]);
    AssignProcessToJobObject(job, child.hProcess);
    ResumeThread(child.hThread);
    CloseHandle(child.hThread);
    return child.hProcess;
}

void read_output(HANDLE pipe, const ProcessOptions& options) {
    char bytes[4096];
    for (DWORD count = 0; ReadFile(pipe, bytes, sizeof bytes, &count, nullptr) && count > 0;) {
        const std::string_view text(bytes, count);
        *options.output += text;
        if (options.echo) std::cout << text << std::flush;
    }
}

double processor_seconds(HANDLE process) {
    FILETIME begin, end, kernel{}, user{};
    GetProcessTimes(process, &begin, &end, &kernel, &user);
    const auto seconds = [](const FILETIME& time) {
        return 1e-7 * (double(time.dwHighDateTime) * 4294967296.0 + double(time.dwLowDateTime));
    };
    return seconds(kernel) + seconds(user);
}

/// Waits for the process; stops it if its time is up, or if the question of cancel_if is answered with yes. Returns
/// whether its time was up.
bool wait_for(HANDLE process, HANDLE job, const ProcessOptions& options) {
    const ULONGLONG begin = GetTickCount64();
    while (WaitForSingleObject(process, is_cancelled ? 5 : 50) == WAIT_TIMEOUT) {
        const double seconds = 1e-3 * double(GetTickCount64() - begin);
        const bool is_late = (options.seconds > 0 && seconds >= options.seconds) ||
                             (options.cpu_seconds > 0 && processor_seconds(process) >= options.cpu_seconds);
        const bool is_unwanted = is_cancelled && is_cancelled();
        if (!is_late && !is_unwanted) continue;
        TerminateJobObject(job, 1);
        TerminateProcess(process, 1); // if it could not be put into the job
        WaitForSingleObject(process, INFINITE);
        if (is_unwanted) throw Cancelled();
        return true;
    }
    return false;
}

std::string crash_text(DWORD code) {
    switch (code) {
    case 0xc0000005: // access violation
    case 0xc00000fd: // stack overflow
        return "crashed: invalid memory access (an index out of range, or endless recursion?)";
    case 0xc0000409: // __fastfail
    case abort_code: return "aborted: an assertion in the program failed";
    case 0xc0000094: return "crashed: integer division by zero";
    case 0xc000001d: return "crashed: invalid instruction (a function without a return statement?)";
    case 0xc0000006:
    case 0xc0000374: return "crashed: invalid memory access";
    default: return code >= first_crash && code != quota_exceeded ? "crashed" : "";
    }
}

} // namespace

ProcessResult run_process(const Words& command, const ProcessOptions& options) {
    std::cout.flush();
    const Handle nothing(opened("/dev/null", GENERIC_READ, OPEN_EXISTING)), job(job_with(options));
    const Handle log(options.log.empty() ? nullptr
                     : options.append    ? opened(options.log, FILE_APPEND_DATA, OPEN_ALWAYS)
                                         : opened(options.log, GENERIC_WRITE, CREATE_ALWAYS));
    if (!log.handle && !options.log.empty()) throw Error("cannot write " + text_of(options.log));
    Handle reading, writing;
    if (options.output && !CreatePipe(&reading.handle, &writing.handle, nullptr, 0))
        throw Error("cannot start " + command[0] + ": no pipe");
    Streams streams;
    streams.in = nothing.handle;
    if (log.handle) streams.out = streams.err = log.handle;
    if (options.output) streams.out = writing.handle;
    const Handle process(start(command, streams, job.handle));
    writing.close();
    const std::future<void> reader =
        options.output ? std::async(std::launch::async, [&] { read_output(reading.handle, options); })
                       : std::future<void>();
    const bool is_late = wait_for(process.handle, job.handle, options);
    if (reader.valid()) reader.wait();
    if (is_stopped) throw Stop{130};
    DWORD code = 0;
    GetExitCodeProcess(process.handle, &code);
    const bool timed_out = is_late || code == quota_exceeded || code == ERROR_NOT_ENOUGH_QUOTA;
    const int result = timed_out || code >= first_crash ? 128 : int(code); // negative otherwise
    return {result, timed_out, processor_seconds(process.handle), timed_out ? "" : crash_text(code)};
}

// Windows replaces no process: this one waits for the other and ends with its code.
void replace_process(const Words& command) {
    std::cout.flush();
    const Handle job(job_with({})), process(start(command, {}, job.handle));
    WaitForSingleObject(process.handle, INFINITE);
    DWORD code = 0;
    GetExitCodeProcess(process.handle, &code);
    std::exit(int(code));
}

void handle_signals() {
    SetConsoleCtrlHandler(note_stop, TRUE);
}

void cancel_if(std::function<bool()> question) {
    is_cancelled = std::move(question);
}

bool open_page(const fs::path& page) {
    const auto code =
        ShellExecuteW(nullptr, L"open", fs::absolute(page).c_str(), nullptr, nullptr, SW_SHOWNORMAL);
    return reinterpret_cast<std::intptr_t>(code) > 32;
}

BuildLock::BuildLock(const fs::path& build) {
    const fs::path place = fs::absolute(build / "").lexically_normal().parent_path().parent_path() / "lock";
    const HANDLE file = opened(place, GENERIC_WRITE, OPEN_ALWAYS);
    if (file == INVALID_HANDLE_VALUE) return;
    folder = reinterpret_cast<std::intptr_t>(file);
    OVERLAPPED where{};
    for (int tries = 0;
         !LockFileEx(file, LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &where); ++tries) {
        if (is_stopped) throw Stop{130};
        if (tries == 20)
            print_error_line("another ./learn is building in this folder; waiting until it is done ...");
        Sleep(50);
    }
}

BuildLock::~BuildLock() {
    if (folder != -1) CloseHandle(reinterpret_cast<HANDLE>(folder));
}

Keys::Keys() {} // _getch reads keys immediately, whatever the mode of the console

Keys::~Keys() {}

std::optional<char> Keys::next(int milliseconds) const {
    const HANDLE input = GetStdHandle(STD_INPUT_HANDLE);
    for (int waited = 0;; waited += 20) {
        if (is_stopped) throw Stop{130};
        DWORD count = 0;
        if (is_terminal(0)) {
            if (_kbhit()) return char(_getch());
        } else if (!PeekNamedPipe(input, nullptr, 0, nullptr, &count, nullptr) || count > 0) {
            char key = 0;
            return ReadFile(input, &key, 1, &count, nullptr) && count == 1 ? key : 'q';
        }
        if (waited >= milliseconds) return std::nullopt;
        Sleep(20);
    }
}

} // namespace rt::tutor
