// A file that is written completely or not at all: under a temporary name, then renamed.
#pragma once

#include "common/util/error.h"

#include <cstdio>
#include <string>
#include <string_view>

namespace rt::assets {

class OutputFile {
  public:
    explicit OutputFile(const std::string& name)
        : path(name), temporary(name + ".part"), file(std::fopen(temporary.c_str(), "wb")) {
        if (!file) throw Error("cannot write '" + temporary + "': check the folder and its permissions");
    }

    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    ~OutputFile() {
        if (!file) return;
        std::fclose(file);
        std::remove(temporary.c_str());
    }

    void write(std::string_view bytes) {
        if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size())
            throw Error("cannot write '" + temporary + "': is the disk full?");
    }

    /// Renames the file to its final name. A file that is never finished is removed.
    void finish() {
        const bool closed = std::fclose(file) == 0;
        file = nullptr;
        if (!closed || std::rename(temporary.c_str(), path.c_str()) != 0) {
            std::remove(temporary.c_str());
            throw Error("cannot write '" + path + "': is the disk full, or the name taken by a folder?");
        }
    }

  private:
    std::string path;
    std::string temporary;
    std::FILE* file;
};

} // namespace rt::assets
