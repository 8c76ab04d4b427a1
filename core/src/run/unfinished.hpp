// Folders that must not stay behind when the program is killed by a signal.
#pragma once

#include <filesystem>

namespace foam {

/// For its life, remove_unfinished_runs() removes the folder.
class UnfinishedFolder {
public:
    explicit UnfinishedFolder(const std::filesystem::path& folder);
    ~UnfinishedFolder();
    UnfinishedFolder(const UnfinishedFolder&) = delete;
    UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

private:
    int slot_ = -1;
};

} // namespace foam
