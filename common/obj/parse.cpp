// tinyobjloader's callbacks, which answer the numbers as they stand in the text: no copy of a face is made
// that nobody asked for, and a chunk need not know what stands before it.
#include "common/obj/parse.h"

#include "common/error.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <istream>
#include <map>
#include <streambuf>
#include <string_view>

namespace rt {
namespace {

/// Lets a stream read a string without a copy of it.
struct TextBuffer : std::streambuf {
    explicit TextBuffer(std::string& text) { setg(text.data(), text.data(), text.data() + text.size()); }
};

/// From a number of the text to an index: 0, which stands for none, becomes -1.
int index_of(ParsedChunk& chunk, Numbered::Kind kind, int number, std::size_t count) {
    if (number >= 0) return number - 1;
    chunk.relative[kind].push_back(chunk.corners.size());
    return int(count) + number;
}

void add_face(ParsedChunk& chunk, const tinyobj::index_t* corners, int size) {
    for (int i = 0; i < size; ++i) {
        const tinyobj::index_t& corner = corners[i];
        chunk.corners.push_back(
            {index_of(chunk, Numbered::position, corner.vertex_index, chunk.positions.size()),
             index_of(chunk, Numbered::uv, corner.texcoord_index, chunk.uvs.size()),
             index_of(chunk, Numbered::normal, corner.normal_index, chunk.normals.size())});
    }
    chunk.face_sizes.push_back(std::uint16_t(size));
}

ParsedChunk& chunk_at(void* data) {
    return *static_cast<ParsedChunk*>(data);
}

std::string first_word(std::string_view line) {
    line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
    return std::string(line.substr(0, line.find_first_of(" \t")));
}

tinyobj::callback_t callbacks() {
    tinyobj::callback_t calls;
    calls.vertex_cb = [](void* data, float x, float y, float z, float) {
        chunk_at(data).positions.emplace_back(x, y, z);
    };
    calls.normal_cb = [](void* data, float x, float y, float z) {
        chunk_at(data).normals.emplace_back(x, y, z);
    };
    calls.texcoord_cb = [](void* data, float u, float v, float) { chunk_at(data).uvs.emplace_back(u, v); };
    calls.index_cb = [](void* data, tinyobj::index_t* corners, int size) {
        add_face(chunk_at(data), corners, size);
    };
    calls.usemtl_cb = [](void* data, const char* name, int) {
        chunk_at(data).material_lines.push_back({chunk_at(data).face_sizes.size(), false, first_word(name)});
    };
    return calls;
}

/// What tinyobjloader calls at each mtllib line. The files are read when the chunks stand in order.
struct LibraryLines : tinyobj::MaterialReader {
    explicit LibraryLines(ParsedChunk& chunk_) : chunk(chunk_) {}
    bool operator()(const std::string& name, std::vector<tinyobj::material_t>*, std::map<std::string, int>*,
                    std::string*, std::string*) override {
        // Of a name that it has met before, tinyobjloader goes on to the nothing behind a blank at the line's
        // end.
        if (!name.empty()) chunk.material_lines.push_back({chunk.face_sizes.size(), true, name});
        return true;
    }
    ParsedChunk& chunk;
};

} // namespace

ParsedChunk parse_chunk(const std::string& path, std::string& text, const ChunkScan& scan) {
    ParsedChunk chunk;
    chunk.positions.reserve(std::size_t(scan.counts[Numbered::position]));
    chunk.uvs.reserve(std::size_t(scan.counts[Numbered::uv]));
    chunk.normals.reserve(std::size_t(scan.counts[Numbered::normal]));
    chunk.corners.reserve(std::size_t(scan.corners));
    chunk.face_sizes.reserve(std::size_t(scan.faces));
    TextBuffer buffer(text);
    std::istream stream(&buffer);
    LibraryLines libraries(chunk);
    std::string warnings, errors;
    if (!tinyobj::LoadObjWithCallback(stream, callbacks(), &chunk, &libraries, &warnings, &errors))
        throw Error(path + ": cannot be read as an OBJ file (" + errors.substr(0, errors.find('\n')) + ")");
    return chunk;
}

} // namespace rt
