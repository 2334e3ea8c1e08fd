// Reads and writes records of hashes, and strips comments from sources.
#include "tools/tutor/record.h"

#include "common/util/file_bytes.h"
#include "tools/tutor/util.h"

namespace rt::tutor {

namespace fs = std::filesystem;

Record read_record(const fs::path& path) {
    Record record;
    if (std::error_code ignored; !fs::exists(path, ignored)) return record;
    for (const std::string& line : lines_of(read_file(text_of(path))))
        if (const Words words = words_in(line); !line.starts_with("#") && words.size() == 2)
            record[words[0]] = words[1];
    return record;
}

void write_record(const fs::path& path, const std::string& heading, const Record& record) {
    std::string text = heading;
    for (const auto& [name, key] : record) text += name + " " + key + "\n";
    std::error_code ignored;
    if (!fs::exists(path, ignored) || read_file(text_of(path)) != text) write_file(text_of(path), text);
}

std::string code_only(const std::string& source) {
    std::string code;
    for (std::string line : lines_of(source)) {
        const std::size_t at = line.find("//");
        const bool marks =
            at != std::string::npos && (line.substr(at, 3) == "//>" || line.substr(at, 3) == "//<");
        const bool is_whole_line = at == line.find_first_not_of(' ');
        if (at != std::string::npos && !marks && (is_whole_line || line.find('"', at) == std::string::npos))
            line.resize(at);
        if (marks && line[at + 2] == '>') line.resize(at + 3); // how it is asked proves nothing
        for (const std::string& word : words_in(line)) code += word + " ";
    }
    return code;
}

} // namespace rt::tutor
