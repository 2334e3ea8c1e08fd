// One thread reads the next chunk of the file while others scan and parse theirs: the text is never in memory
// as a whole, and still in the cache when it is looked at again.
#include "common/obj/chunks.h"

#include "common/cores.h"
#include "common/error.h"
#include "common/file_bytes.h"

#include <algorithm>
#include <future>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace rt {
namespace {

/// The last place in `text`, but not before `from`, where it can be cut in two: behind a '\n' that no '\' can
/// join to the next line. 0 if there is none.
std::size_t last_cut(const std::string& text, std::size_t from) {
    std::size_t end = text.rfind('\n');
    while (end != std::string::npos && end >= from) {
        const std::size_t last = text.find_last_not_of(" \t\r", end - 1);
        if (end == 0 || last == std::string::npos || text[last] != '\\') return end + 1;
        end = text.rfind('\n', last);
    }
    return 0;
}

class Chunks {
  public:
    Chunks(const std::string& path_, const ObjReading& reading)
        : path(path_), file(path), chunk_bytes(reading.chunk_bytes) {
        if (file.bytes_left() == 0) throw Error(path + ": is empty");
        const std::uintmax_t most = file.bytes_left() / chunk_bytes + 1;
        const int wished = reading.threads > 0 ? reading.threads : usable_cores();
        threads = int(std::min<std::uintmax_t>(std::uintmax_t(wished), most));
    }
    std::deque<Chunk> read();

  private:
    void work();
    Chunk* next(std::string& text);
    void fill(std::string& text);

    const std::string path;
    InputFile file;
    const std::size_t chunk_bytes;
    int threads = 1;
    std::mutex mutex; ///< guards `file`, `rest`, `chunks` and `stopped`
    std::string rest; ///< read, but behind the last cut
    std::deque<Chunk> chunks;
    bool stopped = false;
};

std::deque<Chunk> Chunks::read() {
    std::vector<std::future<void>> others;
    try {
        while (int(others.size()) + 1 < threads)
            others.push_back(std::async(std::launch::async, [this] { work(); }));
    } catch (const std::system_error&) { // no more threads to be had: those that run are enough
    }
    work();
    for (std::future<void>& other : others) other.get();
    return std::move(chunks);
}

void Chunks::work() {
    std::string text;
    while (Chunk* const chunk = next(text)) {
        unify_line_ends(text);
        chunk->scan = scan_chunk(text, chunk->begins_file);
        if (!chunk->scan.fault) {
            chunk->parsed = parse_chunk(path, text, chunk->scan);
            continue;
        }
        const std::lock_guard lock(mutex); // chunks before this one are under way, those behind it not needed
        stopped = true;
    }
}

/// The place for the next chunk; null if there is none.
Chunk* Chunks::next(std::string& text) {
    const std::lock_guard lock(mutex);
    if (stopped) return nullptr;
    fill(text);
    if (text.empty()) return nullptr;
    Chunk& chunk = chunks.emplace_back();
    chunk.begins_file = chunks.size() == 1;
    if (chunk.begins_file) blank_byte_order_mark(text);
    return &chunk;
}

void Chunks::fill(std::string& text) {
    text.swap(rest);
    rest.clear();
    while (file.bytes_left() > 0) {
        const std::size_t known = text.size();
        const std::size_t count = std::size_t(std::min<std::uintmax_t>(chunk_bytes, file.bytes_left()));
        text.resize(known + count);
        file.read(text.data() + known, count);
        const std::size_t cut = last_cut(text, known);
        if (cut == 0 || file.bytes_left() == 0) continue;
        rest.assign(text, cut);
        text.resize(cut);
        return;
    }
}

} // namespace

std::deque<Chunk> read_chunks(const std::string& path, const ObjReading& reading) {
    return Chunks(path, reading).read();
}

} // namespace rt
