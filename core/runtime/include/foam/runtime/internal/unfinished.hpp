// Folders that must be removed when a signal kills the program.
#pragma once

#include <filesystem>

namespace foam {
inline namespace [[gnu::visibility("default")]] runtime {

/// Registers a folder for its lifetime: remove_unfinished_runs() removes it.
class UnfinishedFolder {
public:
    explicit UnfinishedFolder(const std::filesystem::path& folder);
    ~UnfinishedFolder();
    UnfinishedFolder(const UnfinishedFolder&) = delete;
    UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

private:
    int slot_ = -1;
};

} // namespace runtime
} // namespace foam
