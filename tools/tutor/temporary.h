// Files and folders for a while: under a name that nobody else has, gone in the end.
#pragma once

#include <filesystem>
#include <string>

namespace rt {

/// An empty file. Its name cannot be foreseen, and nothing stood there before: no link that another user has laid.
class TemporaryFile {
  public:
    /// Throws Error if none can be made in `folder`.
    explicit TemporaryFile(const std::filesystem::path& folder = std::filesystem::temp_directory_path());
    ~TemporaryFile();
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    std::filesystem::path path;
};

/// The same for a folder, with all that is in it at the end.
class TemporaryFolder {
  public:
    explicit TemporaryFolder(const std::filesystem::path& folder = std::filesystem::temp_directory_path());
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path path;
};

} // namespace rt
