// Measures how fast read_obj and tinyobjloader alone read the same OBJ file, in turn, and the way to a mesh.
#include "05_mesh_bvh/mesh.h"
#include "common/util/paths.h"
#include "common/model/obj_file.h"
#include "common/util/error.h"
#include "tools/bench/program.h"

#include <tiny_obj_loader.h>

#include <filesystem>

namespace rt::bench {
namespace {

namespace fs = std::filesystem;

struct Options {
    int triangles = 1000000, rounds = 7, threads = 0;
    bool mesh = true;
    std::string file;
};

void append_line(std::string& text, const char* format, auto... numbers) {
    char line[160];
    text.append(line, std::size_t(std::snprintf(line, sizeof line, format, numbers...)));
}

/// Returns an OBJ of a ball: every vertex with its texture coordinate and, if wanted, its normal.
std::string ball(int triangles, bool normals) {
    const int rows = std::max(1, int(std::sqrt(triangles / 4.0)));
    const int columns = std::max(1, triangles / (2 * rows)), stride = columns + 1;
    std::string text;
    for (int i = 0; i < (rows + 1) * stride; ++i) {
        const double u = double(i % stride) / columns, v = double(i / stride) / rows;
        const double phi = 2 * double(pi) * u, theta = 0.1 + 2.9 * v;
        const dvec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
        append_line(text, "v %.6f %.6f %.6f\nvt %.6f %.6f\n", 2 * n.x, 2 * n.y, 2 * n.z, u, v);
        if (normals) append_line(text, "vn %.6f %.6f %.6f\n", n.x, n.y, n.z);
    }
    const char* const face =
        normals ? "f %1$d/%1$d/%1$d %2$d/%2$d/%2$d %3$d/%3$d/%3$d\n" : "f %1$d/%1$d %2$d/%2$d %3$d/%3$d\n";
    for (int i = 0; i < rows * columns; ++i) {
        const int a = i / columns * stride + i % columns + 1, b = a + stride; // OBJ counts from 1
        append_line(text, face, a, b, a + 1);
        append_line(text, face, a + 1, b, b + 1);
    }
    return text;
}

/// The times of several rounds.
struct Rounds {
    std::vector<double> wall, cpu;

    void time(const auto& action) {
        const Stopwatch watch;
        [[maybe_unused]] const auto kept = action(); // freed after the clock has stopped
        wall.push_back(watch.wall());
        cpu.push_back(watch.cpu());
    }
};

/// Reads a file in turn by read_obj and by tinyobjloader, and makes it a mesh.
Json measure(const std::string& path, const std::string& name, const Options& options) {
    const ObjModel model = read_obj(path);
    Rounds ours, tinyobj, appending;
    for (int round = 0; round < options.rounds; ++round) {
        ours.time([&] { return read_obj(path, {.threads = options.threads}); });
        tinyobj.time([&] {
            tinyobj::ObjReader reader;
            if (!reader.ParseFromFile(path)) throw Error(path + ": tinyobjloader reports " + reader.Error());
            return reader;
        });
        if (!options.mesh) continue;
        appending.time([&] {
            Mesh mesh;
            append_model(mesh, model, std::vector<int>(model.materials.size(), 0), 40);
            return mesh;
        });
    }
    const double megabytes = double(fs::file_size(path)) / 1e6, seconds = median(ours.wall);
    const Json row{{"file", name},
                   {"triangles", model.triangles.size()},
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

Json measure(const Options& options) {
    if (!options.file.empty())
        return Json::array({measure(options.file, text_of(path_of(options.file).filename()), options)});
    Json rows;
    fs::create_directories(RT_OUT);
    for (const bool normals : {true, false}) {
        const std::string path = std::string(RT_OUT) + (normals ? "/normals.obj" : "/plain.obj");
        write_file(path, ball(options.triangles, normals));
        rows.push_back(measure(path, normals ? "with normals" : "without normals", options));
    }
    return rows;
}

} // namespace
} // namespace rt::bench

int main(int argc, char** argv) {
    using namespace rt::bench;
    Options options;
    CLI::App app("Times read_obj against tinyobjloader alone.", "bench_obj_loading");
    add_number(app, "--triangles", options.triangles, 2, 20'000'000, "of the file that is made");
    app.add_option("--file", options.file, "a file to read instead");
    add_number(app, "--rounds", options.rounds, 1, 1000, "how often each is read; the median counts");
    add_number(app, "--threads", options.threads, 0, 1024, "for read_obj; 0: one per core");
    app.add_flag("--mesh,!--no-mesh", options.mesh, "also times the way from the file to a mesh");
    return run_program(app, argc, argv, [&] { return rt::Json{{"obj", measure(options)}}; });
}
