// Reads an OBJ file in chunks: one thread reads the next chunk while others parse theirs.
// The whole text is never in memory at the same time.
#include "common/model/obj/chunks.h"

#include "common/util/cores.h"
#include "common/util/error.h"
#include "common/util/file_bytes.h"
#include "common/util/text.h"

#include <algorithm>
#include <future>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace rt {
namespace {

/// Returns where `text` can be split: after the last '\n' at or after `from` that no '\' joins to the next
/// line, or 0 if there is none. Looks only at the text after `from` and at one line before it.
std::size_t last_cut(const std::string& text, std::size_t from) {
    for (std::size_t end = text.size(); end > from; --end) {
        if (text[end - 1] != '\n') continue;
        const std::size_t last = text.find_last_not_of(" \t\r", end == 1 ? 0 : end - 2);
        if (last == std::string::npos || text[last] != '\\') return end;
    }
    return 0;
}

/// Rejects UTF-16, and binary files whose first megabyte is one line that contains zeros,
/// before the rest is read.
void check_beginning(const std::string& path) {
    InputFile file(path);
    std::string text(std::size_t(std::min<std::uintmax_t>(file.bytes_left(), 1 << 20)), ' ');
    file.read(text.data(), text.size());
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
        throw Error(at_line(path, 1, "UTF-16; is this an OBJ file? Save it as UTF-8"));
    const bool one_line = text.find_first_of("\r\n") == std::string::npos;
    if (one_line && text.find('\0') != std::string::npos)
        throw Error(at_line(path, 1, "not text; is this an OBJ file?"));
}

class Chunks {
  public:
    Chunks(const std::string& path_, const ObjReadOptions& reading)
        : path(path_), file(path), chunk_bytes(reading.chunk_bytes) {
        if (file.bytes_left() == 0) throw Error(path + ": is empty");
        check_beginning(path);
        const std::uintmax_t most = file.bytes_left() / chunk_bytes + 1;
        const int wished = reading.threads > 0 ? reading.threads : usable_cores();
        threads = int(std::min<std::uintmax_t>(std::uintmax_t(wished), most));
    }
    std::deque<ParsedChunk> read();

  private:
    void work();
    ParsedChunk* next(std::string& text, bool& begins_file);
    void fill(std::string& text);

    const std::string path;
    InputFile file;
    const std::size_t chunk_bytes;
    int threads = 1;
    std::mutex mutex; ///< guards `file`, `rest`, `chunks` and `stopped`
    std::string rest; ///< text read, but after the last split
    std::deque<ParsedChunk> chunks;
    bool stopped = false;
};

std::deque<ParsedChunk> Chunks::read() {
    std::vector<std::future<void>> others;
    try {
        while (int(others.size()) + 1 < threads)
            others.push_back(std::async(std::launch::async, [this] { work(); }));
    } catch (const std::system_error&) { // the system gives no more threads: those that run are enough
    }
    work();
    for (std::future<void>& other : others) other.get();
    return std::move(chunks);
}

void Chunks::work() {
    std::string text;
    bool begins_file = false;
    while (ParsedChunk* const chunk = next(text, begins_file)) {
        unify_line_ends(text);
        *chunk = parse_chunk(text, begins_file);
        if (!chunk->fault) continue;
        const std::lock_guard lock(mutex); // earlier chunks are being parsed, later ones are not needed
        stopped = true;
    }
}

/// Reads the next chunk into `text` and returns the place for its result, or null at the end of the file.
ParsedChunk* Chunks::next(std::string& text, bool& begins_file) {
    const std::lock_guard lock(mutex);
    if (stopped) return nullptr;
    fill(text);
    if (text.empty()) return nullptr;
    begins_file = chunks.empty();
    if (begins_file) blank_byte_order_mark(text);
    return &chunks.emplace_back();
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

std::deque<ParsedChunk> read_chunks(const std::string& path, const ObjReadOptions& reading) {
    return Chunks(path, reading).read();
}

} // namespace rt
