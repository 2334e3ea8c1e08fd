// Writes meshes to a Wavefront OBJ file in pieces, so that ten million triangles need little memory.
#pragma once

#include "assets/mesh.h"
#include "assets/output_file.h"

#include "common/util/paths.h"

#include <cmath>
#include <filesystem>
#include <string>

namespace rt::assets {

/// Appends a space and `value` with at most `digits` decimals and no trailing zeros. The value is scaled and
/// rounded to a whole number first, so that every compiler prints the same text and 0 never has a sign.
inline void append_number(std::string& text, double value, int digits) {
    const long scale = std::lround(std::pow(10.0, digits));
    const long scaled = std::lround(value * double(scale));
    const std::string fraction = std::to_string(std::abs(scaled) % scale + scale).substr(1);
    text += scaled < 0 ? " -" : " ";
    text += std::to_string(std::abs(scaled) / scale);
    const std::size_t kept = fraction.find_last_not_of('0') + 1; // npos + 1 = 0: all zeros
    if (kept > 0) text.append(".").append(fraction, 0, kept);
}

class ObjWriter {
  public:
    /// `model.obj` refers to its only material in `model.mtl` beside it.
    explicit ObjWriter(const std::string& path) : file(path) {
        const std::string name = text_of(path_of(path).stem());
        file.write("# " + name + ", made by make_assets\nmtllib " + name + ".mtl\nusemtl " + name + "\n");
    }

    void add(const Mesh& mesh) {
        std::string text;
        const auto line = [&](const char* keyword, const auto& values, int digits) {
            text += keyword;
            for (int i = 0; i < values.length(); ++i) append_number(text, values[i], digits);
            text += '\n';
        };
        for (const dvec3& position : mesh.positions) line("v", position, 6);
        for (const dvec2& uv : mesh.uvs) line("vt", uv, 5);
        for (const dvec3& normal : mesh.normals) line("vn", normal, 4);
        for (const Triangle& triangle : mesh.triangles) append_face(text, triangle);
        file.write(text);
        first_vertex += long(mesh.positions.size());
        first_uv += long(mesh.uvs.size());
    }

    void finish() { file.finish(); }

  private:
    void append_face(std::string& text, const Triangle& triangle) const {
        text += 'f';
        for (int corner = 0; corner < 3; ++corner) {
            const std::string vertex = std::to_string(first_vertex + triangle.vertex[corner]);
            const std::string uv = std::to_string(first_uv + triangle.uv[corner]);
            text.append(" ").append(vertex).append("/").append(uv).append("/").append(vertex);
        }
        text += '\n';
    }

    OutputFile file;
    long first_vertex = 1; // OBJ counts from 1
    long first_uv = 1;
};

/// Writes a file with one material: white with the texture `texture`, or plain pale clay if that is empty.
inline void write_mtl(const std::string& path, const std::string& texture) {
    const std::string name = text_of(path_of(path).stem());
    OutputFile file(path);
    file.write("# " + name + ", made by make_assets\nnewmtl " + name + "\n");
    file.write(texture.empty() ? "Kd 0.8 0.78 0.74\n" : "Kd 1 1 1\nmap_Kd " + texture + "\n");
    file.finish();
}

} // namespace rt::assets
