// A file that is written completely or not at all: under a temporary name, then renamed.
#pragma once

#include "common/util/error.h"
#include "common/util/paths.h"

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

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
        std::error_code failure;
        if (closed)
            std::filesystem::rename(path_of(temporary), path_of(path), failure); // replaces an old file
        if (!closed || failure) {
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
