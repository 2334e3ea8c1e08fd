// Measures how fast read_obj is, against tinyobjloader alone: both read the same file of a million triangles,
// in turn. Then the time from files with and without normals to a mesh.
#include "05_mesh_bvh/mesh.h"
#include "common/model/obj_file.h"
#include "common/util/error.h"
#include "tools/bench/program.h"
#include "tools/bench/statistics.h"
#include "tools/bench/threads.h"

#include <tiny_obj_loader.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>

namespace rt::bench {

namespace fs = std::filesystem;

struct ObjOptions {
    int triangles = 1000000, rounds = 7, threads = 0;
    bool mesh = true;
    std::string file, json;
};

void append_line(std::string& text, const char* format, auto... numbers) {
    char line[160];
    text.append(line, std::size_t(std::snprintf(line, sizeof line, format, numbers...)));
}

/// An OBJ of a rough ball: every vertex with its texture coordinate and, if wanted, its normal.
std::string ball(int triangles, bool normals) {
    const int rows = std::max(1, int(std::sqrt(triangles / 4.0))),
              columns = std::max(1, triangles / (2 * rows));
    std::string text;
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column) {
            const double u = double(column) / columns, v = double(row) / rows;
            const double phi = 2 * 3.14159265 * u, theta = 0.1 + 2.9 * v;
            const double x = std::sin(theta) * std::cos(phi), y = std::cos(theta),
                         z = -std::sin(theta) * std::sin(phi);
            const double radius = 1 + 0.01 * std::sin(40 * phi) * std::sin(30 * theta);
            append_line(text, "v %.6f %.6f %.6f\nvt %.6f %.6f\n", radius * x, radius * y, radius * z, u, v);
            if (normals) append_line(text, "vn %.6f %.6f %.6f\n", x, y, z);
        }
    const char* const format =
        normals ? "f %1$d/%1$d/%1$d %2$d/%2$d/%2$d %3$d/%3$d/%3$d\n" : "f %1$d/%1$d %2$d/%2$d %3$d/%3$d\n";
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const int a = row * (columns + 1) + column + 1, b = a + columns + 1;
            append_line(text, format, a, b, a + 1);
            append_line(text, format, a + 1, b, b + 1);
        }
    return text;
}

/// The times of several rounds.
struct Rounds {
    std::vector<double> wall, cpu;

    template <typename Action>
    void time(const Action& action) {
        const auto start = std::chrono::steady_clock::now();
        const double cpu_start = cpu_seconds(CLOCK_PROCESS_CPUTIME_ID);
        [[maybe_unused]] const auto kept = action(); // freed after the clock has stopped
        wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        cpu.push_back(cpu_seconds(CLOCK_PROCESS_CPUTIME_ID) - cpu_start);
    }
};

/// The call that tinyobjloader's manual shows.
std::pair<tinyobj::attrib_t, std::vector<tinyobj::shape_t>> read_by_tinyobj(const std::string& path) {
    std::pair<tinyobj::attrib_t, std::vector<tinyobj::shape_t>> model;
    std::vector<tinyobj::material_t> materials;
    std::string warnings, errors;
    const std::string folder = fs::path(path).parent_path().string();
    if (!tinyobj::LoadObj(&model.first, &model.second, &materials, &warnings, &errors, path.c_str(),
                          folder.c_str()))
        throw Error(path + ": tinyobjloader says " + errors);
    return model;
}

/// Reads a file in turn by read_obj and by tinyobjloader, and makes it a mesh.
Json measure(const std::string& path, const std::string& name, const ObjOptions& options) {
    const ObjModel file = read_obj(path);
    Rounds ours, tinyobj, appending;
    for (int round = 0; round < options.rounds; ++round) {
        ours.time([&] { return read_obj(path, {.threads = options.threads}); });
        tinyobj.time([&] { return read_by_tinyobj(path); });
        if (!options.mesh) continue;
        appending.time([&] {
            Mesh mesh;
            append_model(mesh, file, std::vector<int>(file.materials.size(), 0), 40);
            return mesh;
        });
    }
    const double megabytes = double(fs::file_size(path)) / 1e6, seconds = median(ours.wall);
    const Json row{{"file", name},
                   {"triangles", file.triangles.size()},
                   {"megabytes", megabytes},
                   {"ours_seconds", seconds},
                   {"tinyobj_seconds", median(tinyobj.wall)},
                   {"ratio", seconds / median(tinyobj.wall)},
                   {"cpu_ratio", median(ours.cpu) / median(tinyobj.cpu)},
                   {"ours_megabytes_per_second", megabytes / seconds},
                   {"seconds_to_append", median(appending.wall)}};
    print_row(row);
    return row;
}

void run(const ObjOptions& options) {
    check_json(options.json);
    Json rows = Json::array();
    if (!options.file.empty()) {
        rows.push_back(measure(options.file, fs::path(options.file).filename().string(), options));
    } else {
        fs::create_directories(RT_OUT);
        for (const bool normals : {true, false}) {
            const std::string path = std::string(RT_OUT) + (normals ? "/normals.obj" : "/plain.obj");
            write_file(path, ball(options.triangles, normals));
            rows.push_back(measure(path, normals ? "with normals" : "without normals", options));
        }
    }
    write_json(options.json, {{"obj", rows}});
}

} // namespace rt::bench

int main(int argc, char** argv) {
    rt::bench::ObjOptions options;
    CLI::App app("Times read_obj against tinyobjloader alone.", "bench_obj_loading");
    app.add_option("--triangles", options.triangles, "of the file that is made")
        ->check(CLI::Range(2, 20000000));
    app.add_option("--file", options.file, "a file to read instead");
    app.add_option("--rounds", options.rounds, "the median of this many counts")->check(CLI::Range(1, 1000));
    app.add_option("--threads", options.threads, "for read_obj; 0: one for each core")
        ->check(CLI::Range(0, 1024));
    app.add_flag("--mesh,!--no-mesh", options.mesh, "go on to the mesh");
    rt::bench::add_json_option(app, options.json);
    return rt::bench::run_program(app, argc, argv, [&] { rt::bench::run(options); });
}
