// Temporary folders.
#pragma once

#include <filesystem>
#include <memory>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

class UnfinishedFolder;

/// A temporary folder. It is made on construction, and removed with its contents on destruction or by a crash.
class ScratchFolder {
public:
    /// Makes the folder where the system keeps temporary files: TMPDIR.
    ScratchFolder();
    /// Makes a hidden folder in `folder`, so that its contents can move into `folder` in one step.
    explicit ScratchFolder(const std::filesystem::path& folder);
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    std::unique_ptr<UnfinishedFolder> unfinished_;
};

} // namespace runtime
} // namespace foam
