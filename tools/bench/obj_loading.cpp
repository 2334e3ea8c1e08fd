// How fast read_obj is, against tinyobjloader alone: both read the same file of a million triangles, in
// interleaved rounds, and then the files with and without normals become a mesh.
#include "05_mesh_bvh/mesh.h"
#include "common/util/report_error.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/model/obj_file.h"

#include <CLI/CLI.hpp>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <random>

namespace rt {
namespace {

namespace fs = std::filesystem;

struct Wish {
    int triangles = 1000000, rounds = 7, threads = 0;
    bool mesh = true;
    std::string file, json;
};

/// A folder of its own under the system's temporary one, removed with all that is in it.
struct Folder {
    const fs::path path =
        fs::temp_directory_path() / ("raysteps_bench_" + std::to_string(std::random_device{}()));
    Folder() { fs::create_directories(path); }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
};

template <typename... Numbers>
void print(std::string& text, const char* format, Numbers... numbers) {
    char line[160];
    const int length = std::snprintf(line, sizeof line, format, numbers...);
    text.append(line, std::size_t(length));
}

/// A rough ball: every vertex with its texture coordinate and, if asked for, its normal.
std::string ball(int triangles, bool normals) {
    const int rows = std::max(1, int(std::sqrt(triangles / 4.0))),
              columns = std::max(1, triangles / (2 * rows));
    std::string text;
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            const double u = double(column) / columns, v = double(row) / rows;
            const double across = 2 * 3.14159265 * u, down = 0.1 + 2.9 * v;
            const double x = std::sin(down) * std::cos(across), y = std::cos(down),
                         z = -std::sin(down) * std::sin(across);
            const double radius = 1 + 0.01 * std::sin(40 * across) * std::sin(30 * down);
            print(text, "v %.6f %.6f %.6f\nvt %.6f %.6f\n", radius * x, radius * y, radius * z, u, v);
            if (normals) print(text, "vn %.6f %.6f %.6f\n", x, y, z);
        }
    const char* const format =
        normals ? "f %1$d/%1$d/%1$d %2$d/%2$d/%2$d %3$d/%3$d/%3$d\n" : "f %1$d/%1$d %2$d/%2$d %3$d/%3$d\n";
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const int a = row * (columns + 1) + column + 1, b = a + columns + 1;
            print(text, format, a, b, a + 1);
            print(text, format, a + 1, b, b + 1);
        }
    return text;
}

struct Seconds {
    double wall = 0, cpu = 0;
};

template <typename Action>
Seconds timed(const Action& action) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();       // of all threads
    [[maybe_unused]] const auto kept = action(); // freed after the clock has stopped
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
            double(std::clock() - cpu) / CLOCKS_PER_SEC};
}

Seconds median(std::vector<Seconds> times) {
    const auto middle = [&](double Seconds::*clock) {
        std::ranges::sort(times, {}, clock);
        return (times[(times.size() - 1) / 2].*clock + times[times.size() / 2].*clock) / 2;
    };
    return {middle(&Seconds::wall), middle(&Seconds::cpu)};
}

struct TinyResult {
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
};

/// The call that its manual shows.
TinyResult read_by_tinyobj(const std::string& path) {
    TinyResult result;
    std::string warnings, errors;
    const std::string folder = fs::path(path).parent_path().string();
    if (!tinyobj::LoadObj(&result.attributes, &result.shapes, &result.materials, &warnings, &errors,
                          path.c_str(), folder.c_str(), true))
        throw Error(path + ": tinyobjloader says " + errors);
    return result;
}

Mesh mesh_of(const ObjModel& file) {
    Mesh mesh;
    append_model(mesh, file, std::vector<int>(file.materials.size(), 0), 40);
    return mesh;
}

struct Comparison {
    std::size_t triangles = 0;
    double megabytes = 0;
    Seconds ours, tinyobj;
};

Comparison compare(const std::string& path, int rounds, int threads) {
    Comparison result{read_obj(path).triangles.size(), double(fs::file_size(path)) / 1e6, {}, {}};
    std::vector<Seconds> ours, tinyobj;
    for (int round = 0; round < rounds; ++round) {
        ours.push_back(timed([&] { return read_obj(path, {.threads = threads}); }));
        tinyobj.push_back(timed([&] { return read_by_tinyobj(path); }));
    }
    result.ours = median(ours);
    result.tinyobj = median(tinyobj);
    return result;
}

void print_comparison(const Comparison& c) {
    std::printf("%zu triangles, %.1f MB\n", c.triangles, c.megabytes);
    const auto line = [&](const char* who, Seconds seconds) {
        std::printf("%-12s %.3f s wall, %.3f s cpu, %.0f MB/s\n", who, seconds.wall, seconds.cpu,
                    c.megabytes / seconds.wall);
    };
    line("read_obj", c.ours);
    line("tinyobjloader", c.tinyobj);
    std::printf("ratio %.2f wall, %.2f cpu\n", c.ours.wall / c.tinyobj.wall, c.ours.cpu / c.tinyobj.cpu);
}

std::string json(const Comparison& c) {
    std::string text;
    print(text, "{\"obj\": {\"triangles\": %zu, \"megabytes\": %.6g, ", c.triangles, c.megabytes);
    print(text, "\"ours_seconds\": %.6g, \"tinyobj_seconds\": %.6g, ", c.ours.wall, c.tinyobj.wall);
    print(text, "\"ratio\": %.6g, ", c.ours.wall / c.tinyobj.wall);
    print(text, "\"ours_megabytes_per_second\": %.6g}}\n", c.megabytes / c.ours.wall);
    return text;
}

/// From the file to the mesh, in two parts.
void print_mesh_times(const char* what, const std::string& path, int rounds, int threads) {
    std::vector<Seconds> reading, appending;
    for (int round = 0; round < rounds; ++round) {
        ObjModel file;
        reading.push_back(timed([&] { return file = read_obj(path, {.threads = threads}), 0; }));
        appending.push_back(timed([&] { return mesh_of(file); }));
    }
    std::printf("mesh, %s: %.3f s to read, %.3f s to append (wall)\n", what, median(reading).wall,
                median(appending).wall);
}

void run(const Wish& wish) {
    const Folder folder;
    std::string path = wish.file;
    if (path.empty()) {
        path = (folder.path / "ball.obj").string();
        write_file(path, ball(wish.triangles, true));
    }
    const Comparison comparison = compare(path, wish.rounds, wish.threads);
    print_comparison(comparison);
    if (!wish.json.empty()) write_file(wish.json, json(comparison));
    if (!wish.mesh) return;
    print_mesh_times(wish.file.empty() ? "with normals" : "as given", path, wish.rounds, wish.threads);
    if (!wish.file.empty()) return;
    write_file(path, ball(wish.triangles, false));
    print_mesh_times("without normals", path, wish.rounds, wish.threads);
}

} // namespace
} // namespace rt

int main(int argc, char** argv) {
    rt::Wish wish;
    CLI::App app("Times read_obj against tinyobjloader alone.");
    app.add_option("--triangles", wish.triangles, "of the file that is made")->check(CLI::Range(2, 20000000));
    app.add_option("--file", wish.file, "a file to read instead");
    app.add_option("--rounds", wish.rounds, "the median of this many counts")->check(CLI::Range(1, 1000));
    app.add_option("--threads", wish.threads, "for read_obj; 0: one for each core")
        ->check(CLI::Range(0, 1024));
    app.add_flag("--mesh,!--no-mesh", wish.mesh, "go on to the mesh, with normals and without");
    app.add_option("--json", wish.json, "write the result to this file");
    CLI11_PARSE(app, argc, argv);
    try {
        rt::run(wish);
    } catch (const rt::Error& error) {
        return rt::report_error("bench_obj_loading", error.what());
    }
}
