// Runs a step's program: checks before rendering, reports the cost, and never leaves a half-written file.

#include "common/cli/program.h"

#include "common/util/huge_page_vector.h"
#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/image/image_file.h"
#include "common/util/parallel.h"
#include "common/util/system.h"
#include "common/util/paths.h"
#include "common/render/progress.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace rt {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// ---- stopping ----

std::atomic<const char*> stop_message = ""; ///< what Ctrl-C prints on stderr, including the newline

// Signal handler. It may interrupt any code, so it calls only functions that POSIX lists as
// async-signal-safe. The program then dies of the signal, as it would without a handler, so that a shell
// sees which signal it was.
extern "C" void stop(int number) {
    discard_unfinished_file();
    print_in_handler(stop_message.load());
    std::signal(number, SIG_DFL);
    std::raise(number); // on POSIX it is delivered when this function returns
}

/// While an instance exists, SIGINT, SIGTERM and SIGHUP end the program with a message. The handlers are
/// installed even where the parent ignores SIGINT (as a shell does for `program &`), so that a render
/// can always be stopped.
class StopHandler {
  public:
    explicit StopHandler(const std::string& name)
        : start(is_terminal(2) ? "\n" : ""), before(start + name + ": stopped: nothing was written\n"),
          during(start + name + ": stopped while writing: each file is either complete or as it was\n") {
        stop_message = before.c_str();
        for (std::size_t i = 0; i < signals.size(); ++i) old[i] = std::signal(signals[i], stop);
    }
    ~StopHandler() {
        for (std::size_t i = 0; i < signals.size(); ++i)
            std::signal(signals[i], old[i] == SIG_ERR ? SIG_DFL : old[i]);
        stop_message = "";
    }
    StopHandler(const StopHandler&) = delete;
    StopHandler& operator=(const StopHandler&) = delete;

    void writing_begins() { stop_message = during.c_str(); }

  private:
#if defined(SIGHUP)
    static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};
#else
    static constexpr std::array signals{SIGINT, SIGTERM};
#endif
    std::array<void (*)(int), signals.size()> old{};
    const std::string start; ///< on a terminal, the message starts below the progress bar
    const std::string before, during;
};

// ---- the files to write ----

struct Outputs {
    std::vector<std::string> pictures;
    std::string variance; ///< empty if not requested
};

/// Returns the file name's extension in lower case, with its dot.
std::string ending(const std::string& path) {
    std::string letters = text_of(path_of(path).extension());
    for (char& c : letters)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return letters;
}

std::vector<std::string> picture_files(const std::string& out, const std::string& program) {
    std::error_code ignored;
    const fs::path last = path_of(out).filename();
    if (last.empty() || last == "." || last == ".." || fs::is_directory(path_of(out), ignored))
        throw Error("--out " + out + " is a folder: name a file in it, as in " +
                    text_of(path_of(out) / program));
    if (ending(out) == ".png" || ending(out) == ".hdr") return {out};
    if (!ending(out).empty())
        throw Error("--out " + out + " ends in " + text_of(path_of(out).extension()) +
                    ": a picture is NAME.png, NAME.hdr, or NAME alone for both");
    return {out + ".png", out + ".hdr"};
}

bool same_file(const std::string& a, const std::string& b) {
    std::error_code ignored;
    return absolute_path(a) == absolute_path(b) || fs::equivalent(path_of(a), path_of(b), ignored);
}

/// Returns the files to write, after checking that all of them can be written. Throws Error otherwise.
Outputs checked_outputs(const Options& options) {
    const RenderSettings& settings = options.settings();
    const Outputs outputs{picture_files(settings.out, options.name()), settings.variance};
    for (const std::string& path : outputs.pictures) check_writable(path);
    if (outputs.variance.empty()) return outputs;
    if (ending(outputs.variance) != ".hdr")
        throw Error("--variance " + outputs.variance +
                    " is not an .hdr file: give it a name like variance.hdr");
    if (settings.samples < 2)
        throw Error("--variance needs --samples 2 or more: one sample per pixel has no variance");
    for (const std::string& path : outputs.pictures)
        if (same_file(path, outputs.variance))
            throw Error("--variance " + outputs.variance +
                        " is also the picture's file: give it another name");
    check_writable(outputs.variance);
    return outputs;
}

// ---- messages ----

template <typename... Values>
std::string format(const char* pattern, Values... values) {
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(), pattern, values...);
    return text.data();
}

std::string counted(int number, const std::string& what) {
    return std::to_string(number) + " " + what + (number == 1 ? "" : "s");
}

std::string summary(const RenderSettings& settings) {
    const Crop& c = settings.crop;
    const bool whole = c.x1 - c.x0 == settings.width && c.y1 - c.y0 == settings.height;
    return (whole ? "" : format("crop %d,%d to %d,%d of ", c.x0, c.y0, c.x1, c.y1)) +
           format("%d x %d, ", settings.width, settings.height) + counted(settings.samples, "sample") +
           " a pixel, seed " + std::to_string(settings.seed) + ", " +
           counted(thread_count(settings), "thread") + "\n";
}

std::string cost(const RayStats& ray_stats, double seconds) {
    const double rays = double(ray_stats.rays);
    std::string text = format("time %.2f s, ", seconds) + std::to_string(ray_stats.rays) +
                       format(" rays, %.2f million rays a second\n", rays / std::max(seconds, 1e-9) * 1e-6);
    if (ray_stats.rays > 0 && ray_stats.box_tests + ray_stats.triangle_tests > 0)
        text += format("box tests a ray %.1f, triangle tests a ray %.1f\n",
                       double(ray_stats.box_tests) / rays, double(ray_stats.triangle_tests) / rays);
    return text;
}

void warn_of_invalid_samples(const std::string& program, const Film& film) {
    if (film.invalid_samples == 0) return;
    print_error_line(program + ": warning: " + std::to_string(film.invalid_samples) +
                     (film.invalid_samples == 1 ? " sample is" : " samples are") +
                     " not finite, the first at pixel " + std::to_string(film.first_invalid.x) + "," +
                     std::to_string(film.first_invalid.y) + " sample " +
                     std::to_string(film.first_invalid.sample + 1) + ": their pixels are magenta");
}

// ---- the run ----

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Prints a line immediately, unless --quiet is given.
void print(const RenderSettings& settings, const std::string& line) {
    if (!settings.quiet) std::cout << line << std::flush;
}

/// Renders with a progress bar and returns the film; `seconds` is set to the time taken.
Film timed_render(const RenderSettings& settings, const SampleFunction& radiance, double& seconds) {
    const Clock::time_point start = Clock::now();
    Progress bar(settings.quiet);
    Film film = render(settings, radiance, [&bar](float share) { bar.show(share); });
    seconds = seconds_since(start);
    return film;
}

/// Returns an error message for the user.
std::string explained(const std::exception& problem) {
    const bool no_memory = dynamic_cast<const std::bad_alloc*>(&problem);
    return no_memory ? "there is not enough memory: render a smaller image or scene" : problem.what();
}

/// Writes an image under a new name to the system's temporary folder or, failing that, the home folder.
/// Returns its path, or "" if both fail.
std::string saved_elsewhere(const std::string& program, const std::string& path, const Image& image) {
    std::error_code ignored;
    const char* const home = std::getenv("HOME");
    for (const fs::path& folder : {fs::temp_directory_path(ignored), path_of(home ? home : "")}) {
        const std::string place = text_of(folder / (program + "-" + random_digits() + ending(path)));
        try {
            if (!folder.is_absolute()) continue;
            write_image(place, image);
            fs::permissions(path_of(place), fs::perms::owner_read | fs::perms::owner_write,
                            ignored); // other users can read that folder
            return place;
        } catch (const std::exception&) { // try the next folder
        }
    }
    return "";
}

/// Writes the files and prints their paths. Returns the exit code: 2 if a file could not
/// be written to its place.
int write_outputs(const std::string& program, const Outputs& outputs, const Film& film) {
    std::string wrote;
    int code = 0;
    const auto write = [&](const std::string& path, const Image& image) {
        std::string place = absolute_path(path);
        try {
            write_image(path, image);
        } catch (const std::exception& problem) {
            place = saved_elsewhere(program, path, image);
            const std::string fate = place.empty()
                                         ? "; the new picture could not be saved elsewhere either and is lost"
                                         : "; the new picture is " + place;
            code = report_error(program, explained(problem) + fate);
        }
        if (!place.empty()) wrote += "wrote " + printable(place) + "\n";
    };
    for (const std::string& path : outputs.pictures) write(path, film.mean);
    if (!outputs.variance.empty()) write(outputs.variance, film.variance);
    std::cout << wrote << std::flush;
    return code;
}

/// Renders and writes the files of a parsed command line. Returns the exit code.
int run(const Options& options, const std::function<void(const RenderFunction&)>& body,
        const std::string& overridden_headers, StopHandler& handler) {
    const RenderSettings& settings = options.settings();
    const Outputs outputs = checked_outputs(options);
    print(settings, summary(settings));
    if (!overridden_headers.empty()) print(settings, "using your " + printable(overridden_headers) + "\n");
    // Reserves the memory that writing needs, so that a lack of it shows before the render, not after.
    HugePageVector<char> spare;
    spare.reserve(memory_to_write(settings.crop.x1 - settings.crop.x0, settings.crop.y1 - settings.crop.y0));
    std::optional<Film> film;
    double render_seconds = 0;
    const Clock::time_point start = Clock::now();
    body([&](const SampleFunction& radiance) {
        if (film) throw std::logic_error("main.cpp calls render() twice");
        if (seconds_since(start) > 0.1) print(settings, format("scene %.2f s\n", seconds_since(start)));
        film = timed_render(settings, radiance, render_seconds);
    });
    if (!film) throw std::logic_error("main.cpp never calls render()");
    warn_of_invalid_samples(options.name(), *film);
    print(settings, cost(film->ray_stats, render_seconds));
    handler.writing_begins();
    spare = HugePageVector<char>();
    return write_outputs(options.name(), outputs, *film);
}

} // namespace

int run_program(Options& options, int argc, const char* const* argv,
                const std::function<void(const RenderFunction& render)>& body,
                const std::string& overridden_headers) {
    prepare_streams();
    StopHandler handler(options.name());
    try {
        int code = 0;
        if (options.parse(argc, argv)) {
            set_thread_count(options.settings().threads);
            code = run(options, body, overridden_headers, handler);
        }
        if (!std::cout.flush())
            throw Error("cannot write to stdout (is the disk full, or was the pipe closed?); everything else "
                        "succeeded");
        return code;
    } catch (const std::exception& problem) {
        return report_error(options.name(), explained(problem));
    }
}

} // namespace rt
