// Folders for a moment.
#pragma once

#include <filesystem>
#include <memory>

namespace foam {

class UnfinishedFolder;

/// Made on construction; removed with all that is in it on destruction, and by a crash.
class ScratchFolder {
public:
    /// Where the system keeps temporary files: TMPDIR.
    ScratchFolder();
    /// A hidden one in `folder`, so that what is made there is moved into `folder` in one step.
    explicit ScratchFolder(const std::filesystem::path& folder);
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
    std::unique_ptr<UnfinishedFolder> unfinished_;
};

} // namespace foam
